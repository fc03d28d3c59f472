"""Values of the printed formulas (9)-(16): parsed from the ledger, never retyped.

Where the ledger is wrong by a sign or a digit, so are these values; where a formula cannot be
evaluated with the quantities it should hold, they are NaN and agree with nothing.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Any

import numpy as np

from .....differences import central_differences
from .....errors import DataFileError
from .....ledger import REGISTRY
from .....ledger.formula import Formula, parse
from .....planning.descent.problem import PlanningProblem
from .....planning.field.control_points import end_effector
from .....tracking import memo
from ...document import gains

#: Gradient of a printed potential by central differences in steps of 1e-5 m or rad.
slope = partial(central_differences, step=1e-5)


def value(item: str, side: int, given: Mapping[str, Any]) -> Any:
    """Value of one side of what an equation prints; NaN where it cannot be evaluated."""
    try:
        return _parsed(REGISTRY.printed(f"xue.{item}")["formula"]).value(side, given)
    except (DataFileError, IndexError, TypeError, ValueError):
        return np.nan


@memo()
def _parsed(text: str) -> Formula:
    return parse(text)


def attraction(x: np.ndarray, goal: np.ndarray, gain: float | None = None) -> float:
    """Right side of (9) at the position ``x`` (3,), with k_a or another gain."""
    gain = gains()["k_a"] if gain is None else gain
    return _number(value("eq09", 1, {"k_a": gain, "X": x, "X_g": goal}))


def repulsion(item: str, distances: np.ndarray, *, nearest: bool) -> np.ndarray:
    """Right side of (10) or (14) for signed distances (N, K, M) to M shapes, (N, K).

    The potentials of the shapes are added, or only that of the nearest shape counts.
    """
    if nearest:
        distances = distances.min(axis=2, keepdims=True)
    name = {"eq10": "d", "eq14": "d_i"}[item]
    found = [_number(value(item, 1, {**gains(), name: float(d)})) for d in distances.ravel()]
    return np.reshape(found, distances.shape).sum(axis=2)


def repulsive_force(d: float, dd: np.ndarray) -> np.ndarray:
    """Last side of (12), for a distance d with the gradient ``dd`` (n,)."""
    given = {**gains(), "d": d, "dd": dd, "dX": 1.0}
    return np.broadcast_to(np.asarray(value("eq12", 2, given), dtype=float), dd.shape)


def new_attraction(
    x: np.ndarray,
    goal: np.ndarray,
    theta: np.ndarray,
    theta_goal: np.ndarray,
    gain: float | None = None,
) -> float:
    """Right side of (13) at a position (3,) and at angles (6,), with k_a or another gain."""
    gain = gains()["k_a"] if gain is None else gain
    given = {"k_a": gain, "X": x, "X_g": goal, "theta_i": theta, "theta_gi": theta_goal}
    return _number(value("eq13", 1, given))


def new_attractions(made: PlanningProblem, q: np.ndarray) -> np.ndarray:
    """(13) of a problem at configurations (N, 6)."""
    flange = end_effector(made.placed, q)
    pairs = zip(flange, q, strict=True)
    return np.array([new_attraction(x, made.goal_point, row, made.goal) for x, row in pairs])


def summed(per_point: np.ndarray) -> np.ndarray:
    """Right side of (15) for the potentials of the points (N, K)."""
    return np.array([_number(value("eq15", 1, {"U_rep_i": row})) for row in per_point])


def summands() -> float:
    """How many terms (15) sums: its value where every term is one."""
    return _number(value("eq15", 1, {"U_rep_i": np.ones(100)}))


def total(attractive: np.ndarray, repulsive: np.ndarray) -> np.ndarray:
    """Right side of (16), (N,)."""
    given = {"U_aat_star": attractive, "U_rep_star": repulsive}
    return np.broadcast_to(np.asarray(value("eq16", 1, given), dtype=float), attractive.shape)


def difference(printed: np.ndarray, run: float | np.ndarray) -> float:
    """Largest difference; NaN counts, so that what cannot be evaluated agrees with nothing."""
    return float(abs(printed - run).max())


def _number(found: Any) -> float:
    return float(found) if np.ndim(found) == 0 else np.nan
