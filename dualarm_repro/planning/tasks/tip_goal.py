"""A goal given as a point: the posture that takes the flange there, or says how far it is out of
reach."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import ArrayLike

from ...errors import InputError
from ...scene.bodies import PlacedArm
from ...scene.quantities import vector3
from ..field.control_points import end_effector

REACHED = 1e-6
_EQUALLY_GOOD = 1e-4
_SEEDS = 8
_EVALUATIONS = 60


@dataclass(frozen=True)
class TipPosture:
    """Configuration (nq,) [rad], its flange in the world (3,) [m], distance to the point [m]."""

    q: np.ndarray
    tip: np.ndarray
    residual: float


def nearest_posture(placed: PlacedArm, point: ArrayLike, near: ArrayLike) -> TipPosture:
    """argmin |X(q) - point| within the joint limits, by least squares from ``near`` and further
    seeds.

    Of equally good postures the one with the least joint distance to ``near`` is taken. Where the
    point is out of reach the arm is stretched and its posture may be singular: the distance is
    then well determined, single joints may not be.
    """
    arm, target = placed.arm, vector3(f"arm {placed.name}", "goal", point)
    near = arm.configurations(near)
    turn = placed.placement.rotation
    rng = np.random.default_rng(0)
    inside = 1e-9 * np.subtract(*arm.usual_range[::-1])
    seeds = np.vstack([near, arm.random_configurations(_SEEDS, rng)])
    found = []
    for seed in np.clip(seeds, arm.lower + inside, arm.upper - inside):
        solution = scipy.optimize.least_squares(
            lambda q: end_effector(placed, q) - target,
            seed,
            jac=lambda q: turn @ arm.jacobian(q)[:3],
            bounds=(arm.lower, arm.upper),
            xtol=1e-14,
            ftol=1e-14,
            gtol=1e-14,
            max_nfev=_EVALUATIONS,
            method="dogbox",  # leaves joints alone that do not move the flange
        )
        found.append((float(np.linalg.norm(solution.fun)), solution.x))
    least = min(residual for residual, _ in found)
    good = [(r, q) for r, q in found if r <= least + _EQUALLY_GOOD]
    residual, q = min(good, key=lambda pair: float(arm.distance(near, pair[1])))
    return TipPosture(q, end_effector(placed, q), residual)


def tip_posture(
    placed: PlacedArm, point: ArrayLike, near: ArrayLike, *, best_effort: bool = False
) -> TipPosture:
    """The posture of :func:`nearest_posture` if it gets there.

    Parameters
    ----------
    best_effort : bool
        Return the nearest reachable posture with its residual instead of an error.

    Raises
    ------
    InputError
        The point is out of reach; arm, point and shortfall are named.
    """
    posture = nearest_posture(placed, point, near)
    if posture.residual > REACHED and not best_effort:
        expected = (
            f"a point within reach of {placed.arm.name}: this one is out of reach by "
            f"{posture.residual:.4f} m"
        )
        raise InputError(f"arm {placed.name}", "goal", np.asarray(point).tolist(), expected)
    return posture
