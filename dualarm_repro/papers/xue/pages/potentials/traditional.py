"""Equations (9)-(12) of `xue`: the traditional potentials and forces, print against what is run."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from .....differences import central_differences
from .....ledger import Assumed, Bounded, Is, Residual, Result, Role
from .....planning.checks.field_agreement import gradient_error
from .....planning.descent.problem import PlanningProblem
from .....planning.field.control_points import end_effector
from .....tracking import memo
from ...document import gains
from .agreement import (
    GRADIENT,
    VALUE,
    agreement,
    checks,
    choices,
    difference,
    sample_problem,
    samples,
    worst,
)
from .printed_field import attraction, repulsion, repulsive_force, slope, value

#: Configurations at which forces are compared, each with central differences of distances.
_FORCES = 40
#: Largest relative difference of a force by central differences.
_BY_DIFFERENCES = 1e-6


@checks("xue.eq09", rules=[VALUE(), GRADIENT()])
def traditional_attraction(assumed: Assumed) -> Result:
    """(9) at the flange against the attraction that is descended."""
    made = sample_problem()
    q, part = samples(made), made.attraction.parts[0]
    printed = np.array([attraction(x, made.goal_point) for x in end_effector(made.placed, q)])
    return agreement("(9)", printed, part, q)


@checks(
    "xue.eq10",
    rules=[
        VALUE(),
        GRADIENT(),
        Bounded(
            "at_range",
            "potential, and slope from within, of print at d_0 and just beyond it",
            high=1e-4,
        ),
    ],
)
def traditional_repulsion(assumed: Assumed) -> Result:
    """(10) summed over the bars, and for the nearest one."""
    found = {}
    for reading in choices("window_distance"):
        made = sample_problem(reading, control_points="end_effector")
        q = samples(made)
        distances = made.repulsion.distances(q)
        printed = repulsion("eq10", distances, nearest=reading == "nearest_bar").sum(axis=1)
        found[reading] = agreement("(10)", printed, made.repulsion, q)
    result = worst(found, "(10)")
    result.obtained["at_range"] = _at_range()
    return result


def _at_range() -> float:
    """The largest of |U| at and beyond d_0 and |dU/dd| from within, where (10) passes to zero."""
    edge, step = gains()["d_0"], 1e-6
    within, at, beyond = (_printed_energy(d) for d in (edge - step, edge, edge + step))
    return float(np.max(np.abs([at, beyond, (at - within) / step])))


def _printed_energy(d: float) -> float:
    """(10) as printed at one distance."""
    return float(repulsion("eq10", np.full((1, 1, 1), d), nearest=False)[0, 0])


@checks(
    "xue.eq11",
    rules=[
        Is(
            "vector_form",
            "without the modulus the last side is -grad of (9) as printed",
            value=True,
        ),
        GRADIENT(),
        Is(
            "explained",
            "it is the modulus alone that makes the last side differ",
            value=True,
            role=Role.CONTRADICTS,
        ),
        Is("printed_form", "both printed sides are equal", value=False, role=Role.CONTRADICTS),
    ],
)
def attractive_force(assumed: Assumed) -> Result:
    """The two sides of (11) as printed, the last also without its modulus."""
    forms = attractive_force_forms()
    made = sample_problem()
    error = gradient_error(made.attraction.parts[0], samples(made))
    explained = forms["vector_form"] and not forms["printed_form"]
    if explained:
        finding = (
            "print has its modulus, one number that gives neither the direction nor, along a "
            "line, the sign"
        )
    else:
        finding = "print agrees" if forms["printed_form"] else "print is something else"
    return Result(
        obtained={**forms, "explained": explained, "gradient": error},
        caption=(
            "The negative gradient of (9), taken as printed, is the vector -k_a (X - X_g); "
            f"{finding}. The joint gradient k_a J^T (X - X_g) agrees with central differences to "
            f"{error:.0e}."
        ),
    )


@memo()
def _places() -> tuple[np.ndarray, np.ndarray]:
    """Positions of the flange (N, 3) and its goal, at which forces are compared."""
    made = sample_problem()
    return end_effector(made.placed, samples(made)[:_FORCES]), made.goal_point


def attractive_force_forms() -> dict[str, bool]:
    """Whether the last side of (11) is the gradient side: as printed, and without its modulus."""
    return {"vector_form": _sides_agree(lambda x: x), "printed_form": _sides_agree(None)}


def _sides_agree(norm: Callable[[Any], Any] | None) -> bool:
    points, goal = _places()
    for x in points:
        given: dict[str, Any] = {
            "k_a": gains()["k_a"],
            "X": x,
            "X_g": goal,
            "U_att": lambda at: attraction(at, goal),
            "grad": lambda potential, x=x: slope(potential, x),
        }
        left = np.asarray(value("eq11", 1, given))
        right = np.asarray(value("eq11", 2, given if norm is None else {**given, "norm": norm}))
        if left.shape != right.shape or not _close(left, right):
            return False
    return True


def _close(left: np.ndarray, right: np.ndarray) -> bool:
    scale = max(1.0, float(np.max(np.abs(left))))
    return bool(np.max(np.abs(left - right)) <= _BY_DIFFERENCES * scale)


@checks(
    "xue.eq12",
    rules=[
        Residual("sides", "the force as printed against -grad of (10), at most", high=1e-6),
        Residual("force", "and against the joint forces of the field run", high=1e-6),
        GRADIENT(),
    ],
)
def repulsive_force_run(assumed: Assumed) -> Result:
    """(12) as printed against the gradient of (10) as printed, and against the field run."""
    made = sample_problem(control_points="end_effector")
    q = samples(made)
    error, sides, force = gradient_error(made.repulsion, q), _force_sides(), _force_run(made, q)
    return Result(
        obtained={"sides": sides, "force": force, "gradient": error},
        caption=(
            "The last side of (12) differs from the slope of (10), both as printed, by at most "
            f"{sides:.0e} of it. Taken with the slope of the distance by the joints, and added "
            f"over the bars, it differs from the joint forces that are run by {force:.0e}; these "
            f"agree with central differences to {error:.0e}."
        ),
    )


def _force_sides() -> float:
    """Largest relative difference of -dU/dd and the printed force for dd/dX = 1."""
    largest = 0.0
    for d in np.linspace(0.05, 1.5 * gains()["d_0"], 26):
        given = {
            "U_rep": lambda at: _printed_energy(at.item()),
            "grad": lambda potential, d=d: slope(potential, np.array([d])),
        }
        left = np.asarray(value("eq12", 1, given), dtype=float)
        right = repulsive_force(float(d), np.ones(1))
        largest = np.maximum(largest, difference(left, right) / max(1.0, float(abs(right).max())))
    return float(largest)


def _force_run(made: PlanningProblem, q: np.ndarray) -> float:
    """Largest relative difference of the printed forces in the joints to those of the field."""
    largest = 0.0
    for row in q[:_FORCES]:
        slopes = central_differences(
            lambda at: made.repulsion.distances(at[np.newaxis])[0, 0], row
        )  # (joints, bars)
        distances = made.repulsion.distances(row[np.newaxis])[0, 0]
        force = sum(repulsive_force(float(d), slopes[:, bar]) for bar, d in enumerate(distances))
        run = -made.repulsion.gradient(row)
        largest = np.maximum(largest, difference(force, run) / max(1.0, float(abs(run).max())))
    return float(largest)
