"""Equations (9)-(12) of `xue`: the traditional potentials and forces, print against what is run."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from .....differences import central_differences
from .....ledger import Assumed, Bounded, Is, Residual, Result, Role
from .....ledger.captions import captions
from .....planning.checks.field_agreement import gradient_error
from .....planning.descent.problem import PlanningProblem
from .....planning.field.control_points import end_effector
from .....tracking import memo
from ...document import gains
from .agreement import GRADIENT, VALUE, agreement, checks, choices, sample_problem, samples, worst
from .printed_field import attraction, repulsion, repulsive_force, slope, value

caption = captions(__file__)
#: Configurations at which forces are compared, each with central differences of distances.
_FORCES = 40
#: Largest relative difference of a force by central differences.
_BY_DIFFERENCES = 1e-6


@checks("xue.eq09", rules=[VALUE, GRADIENT])
def traditional_attraction(assumed: Assumed) -> Result:
    """(9) at the flange against the attraction that is descended."""
    made = sample_problem()
    q, part = samples(made), made.attraction.parts[0]
    printed = np.array([attraction(x, made.goal_point) for x in end_effector(made.placed, q)])
    return agreement("(9)", printed, part, q)


@checks(
    "xue.eq10",
    rules=[
        VALUE,
        GRADIENT,
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
        made = sample_problem(window_distance=reading, control_points="end_effector")
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
        GRADIENT,
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
    return Result(
        obtained={**forms, "explained": explained, "gradient": error}, caption=caption("eq11")
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
        if left.shape != right.shape or not _apart(right, left) <= _BY_DIFFERENCES:
            return False
    return True


def _apart(found: np.ndarray, reference: np.ndarray) -> float:
    """Largest difference, relative to what is larger than one; NaN counts."""
    return float(abs(found - reference).max() / max(1.0, float(abs(reference).max())))


@checks(
    "xue.eq12",
    rules=[
        Residual("sides", "the force as printed against -grad of (10), at most", high=1e-6),
        Residual("force", "and against the joint forces of the field run", high=1e-6),
        GRADIENT,
    ],
)
def repulsive_force_run(assumed: Assumed) -> Result:
    """(12) as printed against the gradient of (10) as printed, and against the field run."""
    made = sample_problem(control_points="end_effector")
    q = samples(made)
    error, sides, force = gradient_error(made.repulsion, q), _force_sides(), _force_run(made, q)
    return Result({"sides": sides, "force": force, "gradient": error}, caption("eq12"))


def _force_sides() -> float:
    """Largest relative difference of -dU/dd and the printed force for dd/dX = 1."""
    found = []
    for d in np.linspace(0.05, 1.5 * gains()["d_0"], 26):
        given = {
            "U_rep": lambda at: _printed_energy(at.item()),
            "grad": lambda potential, d=d: slope(potential, np.array([d])),
        }
        left = np.asarray(value("eq12", 1, given), dtype=float)
        found.append(_apart(left, repulsive_force(float(d), np.ones(1))))
    return float(np.max(found))


def _force_run(made: PlanningProblem, q: np.ndarray) -> float:
    """Largest relative difference of the printed forces in the joints to those of the field."""

    def distances(at: np.ndarray) -> np.ndarray:
        return made.repulsion.distances(at[np.newaxis])[0, 0]

    found = []
    for row in q[:_FORCES]:
        by_bar = zip(distances(row), central_differences(distances, row).T, strict=True)
        force = np.sum([repulsive_force(float(d), slopes) for d, slopes in by_bar], axis=0)
        found.append(_apart(force, -made.repulsion.gradient(row)))
    return float(np.max(found))
