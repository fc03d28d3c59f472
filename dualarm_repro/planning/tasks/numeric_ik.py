"""Inverse kinematics of any arm by damped least squares from many seeds, within its limits.

min over q of |X(q) - p|^2 + L^2 |e(q)|^2 by a trust-region Gauss-Newton method (the damped least
squares of C. W. Wampler, IEEE Transactions on Systems, Man, and Cybernetics 16(1), 1986), with
e = log(R_g^T R(q)) for a full pose, and e = R_g k - R(q) k if the pose may turn about its axis k.
L is the length of the stretched arm.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import pinocchio as pin
import scipy
from numpy.typing import ArrayLike

from ...scene.bodies import PlacedArm
from ..field.control_points import end_effector
from .tip_goal import REACHED

_SEEDS = 32
_EVALUATIONS = 80
#: Distinct solutions after which no further seed is tried.
_ENOUGH = 6
_SAME = 1e-3


class PoseGoal(NamedTuple):
    """Position (3,) [m] and rotation (3, 3) of the flange in the world; ``free`` is the axis of the
    flange, 0 ... 2, about which it may turn."""

    position: np.ndarray
    rotation: np.ndarray
    free: int | None = None


@dataclass(frozen=True)
class PosePosture:
    """Configuration (nq,) [rad], and by how much it misses position [m] and orientation [rad]."""

    q: np.ndarray
    missed: float
    turned: float

    @property
    def reached(self) -> bool:
        """Whether both are met."""
        return self.missed <= REACHED and self.turned <= REACHED


def pose_errors(placed: PlacedArm, goal: PoseGoal, q: np.ndarray) -> tuple[float, float]:
    """Distance from the position [m] and angle from the orientation, or from its axis [rad]."""
    missed = float(np.linalg.norm(end_effector(placed, q) - goal.position))
    turn = placed.placement.rotation @ placed.arm.fk(q)[:3, :3]
    if goal.free is None:
        return missed, float(np.linalg.norm(pin.log3(goal.rotation.T @ turn)))
    axis, wanted = turn[:, goal.free], goal.rotation[:, goal.free]
    return missed, float(np.arctan2(np.linalg.norm(np.cross(axis, wanted)), axis @ wanted))


def pose_posture(
    placed: PlacedArm,
    goal: PoseGoal,
    near: ArrayLike,
    clear: Callable[[np.ndarray], bool] = lambda q: True,
) -> PosePosture:
    """The posture of a pose nearest to ``near``, of those that are ``clear`` if there is one.

    Out of reach it is the posture that misses least; see :attr:`PosePosture.reached`.
    """
    arm, near = placed.arm, placed.arm.configurations(near)
    rng = np.random.default_rng(0)
    seeds = np.vstack([near, arm.random_configurations(_SEEDS, rng)])
    inside = 1e-9 * np.subtract(*arm.usual_range[::-1])
    best: PosePosture | None = None
    found: list[PosePosture] = []
    for seed in np.clip(seeds, arm.lower + inside, arm.upper - inside):
        one = _descended(placed, goal, seed)
        if best is None or one.missed + one.turned < best.missed + best.turned:
            best = one
        away = (np.abs(arm.difference(one.q, other.q)).max() for other in found)
        if one.reached and all(far > _SAME for far in away):
            found.append(one)
        if len(found) >= _ENOUGH and any(clear(other.q) for other in found):
            break
    if best is None or not found:
        return best or PosePosture(near, np.inf, np.inf)
    found.sort(key=lambda one: float(arm.distance(near, one.q)))
    return next((one for one in found if clear(one.q)), found[0])


def _descended(placed: PlacedArm, goal: PoseGoal, seed: np.ndarray) -> PosePosture:
    arm, base = placed.arm, placed.placement.rotation
    length = arm.stretched or 1.0

    def residual(q: np.ndarray) -> np.ndarray:
        turn = base @ arm.fk(q)[:3, :3]
        if goal.free is None:
            error = pin.log3(goal.rotation.T @ turn)
        else:
            error = goal.rotation[:, goal.free] - turn[:, goal.free]
        return np.concatenate([end_effector(placed, q) - goal.position, length * error])

    def jacobian(q: np.ndarray) -> np.ndarray:
        turn, columns = base @ arm.fk(q)[:3, :3], arm.jacobian(q)
        moved, spin = base @ columns[:3], base @ columns[3:]
        if goal.free is None:
            error = pin.Jlog3(goal.rotation.T @ turn) @ turn.T @ spin
        else:
            error = pin.skew(turn[:, goal.free]) @ spin
        return np.vstack([moved, length * error])

    solved = scipy.optimize.least_squares(
        residual,
        seed,
        jac=jacobian,
        bounds=(arm.lower, arm.upper),
        xtol=1e-15,
        ftol=1e-15,
        gtol=1e-15,
        max_nfev=_EVALUATIONS,
        method="dogbox",  # leaves joints alone that do not move the flange
    )
    return PosePosture(solved.x, *pose_errors(placed, goal, solved.x))
