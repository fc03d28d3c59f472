"""Stored study of `qiu`: is there an equilibrium with the flange near the printed trap at all?

Unknown are the wrist of the posture, the wrist and the radius of the goal, the place of the flange
in the neighbourhood of the printed point, and the ratio of the gains; per branch of the posture and
of the goal, set of control points, rule of the sources and form of the attraction, the nearest
balance of both forces is sought from several starts. Forces that are opposed balance at one ratio;
forces that are not balance at none.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from scipy.stats import qmc

from ....errors import InputError
from ....ledger import REGISTRY, Study
from ....ledger.assumptions import alternatives
from ....planning.search.equilibrium import Equilibrium, equilibrium_at, nearest_equilibria
from ....planning.search.search_problem import SearchProblem, search_problem
from ....planning.tasks.elbow_branches import BRANCHES, branch_posture
from ....scene.bodies import PlacedArm
from ..document import PRINTED, SEED, full_step, repelling
from ..reading import CONTROL_POINTS, Goal, Traditional
from .fit import combinations

STARTS = 3
_PLACE = tuple(f"{end}{j}" for end in ("q", "goal") for j in range(1, 7))
#: Columns of what a descent found: few steps amplify round-off to several degrees.
_ROUGH = ("angle_deg", "ratio", "curvature", *_PLACE)
_BEND = np.deg2rad(120.0)  # of joint 5 of the arm


def _cells() -> list[dict[str, Any]]:
    return combinations(
        branch=BRANCHES,
        goal_branch=BRANCHES,
        control_points=list(CONTROL_POINTS),
        repulsion_sources=alternatives("qiu.repulsion_sources", 0),
        attraction_form=alternatives("qiu.attraction_form", 0),
    )


def _bounds() -> tuple[np.ndarray, np.ndarray]:
    """Of q4, q5 and those of the goal [rad], its radius [m], and the offset of the flange [m], in
    the cube inside the ball of one printed step around the printed point."""
    radius = REGISTRY.declared("qiu.goal_radius", "range").range or (np.nan, np.nan)
    wrist, near = np.array([np.pi, _BEND, np.pi, _BEND]), np.full(3, full_step() / np.sqrt(3.0))
    return np.array([*-wrist, radius[0], *-near]), np.array([*wrist, radius[1], *near])


def _problem(cell: Mapping[str, Any]) -> tuple[PlacedArm, SearchProblem]:
    reading = Traditional.nominal(**{key: cell[key] for key in cell if key != "branch"})
    arm, start = reading.arm(), PRINTED.start
    return arm, search_problem(arm, start, start, repelling(), reading.settings())


def _balance(found: Equilibrium) -> dict[str, float]:
    return {
        "angle_deg": float(np.rad2deg(found.angle)),
        "ratio": found.ratio,
        "curvature": found.curvature,
    }


def _certificate(cell: Mapping[str, Any], row: Mapping[str, Any]) -> dict[str, float]:
    """The balance at the posture and goal of a row, without the descent that found them."""
    if not row["starts"]:
        return {}
    q, goal = (np.array([row[f"{end}{j}"] for j in range(1, 7)]) for end in ("q", "goal"))
    return _balance(equilibrium_at(_problem(cell)[1], q, goal))


def _cell(cell: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    arm, made = _problem(cell)

    def place(x: np.ndarray) -> tuple[np.ndarray, np.ndarray] | None:
        q = branch_posture(arm, PRINTED.trap + x[5:], cell["branch"], (*x[:2], 0.0))
        goal = Goal("pulled_back", float(x[4]), cell["goal_branch"], (*x[2:4], 0.0))
        try:
            return None if q is None else (q, goal.posture())
        except InputError:
            return None

    low, high = _bounds()
    starts = qmc.scale(qmc.Sobol(len(low), rng=rng).random(16), low, high)
    placed = [x for x in starts if place(x) is not None][:STARTS]
    found = nearest_equilibria(made, place, placed, (low, high))
    row: dict[str, Any] = {"starts": len(found), "angle_deg": np.nan, "ratio": np.nan}
    row |= {"curvature": np.nan}
    if found:
        nearest = min(found, key=lambda one: one.angle)
        row |= _balance(nearest)
        row |= {f"q{j}": float(angle) for j, angle in enumerate(nearest.q, 1)}
        row |= {f"goal{j}": float(angle) for j, angle in enumerate(nearest.goal, 1)}
    return row


EQUILIBRIA = REGISTRY.keeps(
    Study(
        name="qiu_equilibria",
        title="Nearest balance of forces with the flange around the printed trap, for any ratio",
        cells=_cells,
        compute=_cell,
        seed=SEED + 40,
        settings={"starts": STARTS},
        measured=_ROUGH,
        certificate=_certificate,
    )
)
