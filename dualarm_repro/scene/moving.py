"""Moving obstacles: a shape or a whole arm that follows a given trajectory over a common index.

The index is any number that all trajectories of a scene share: a time, or the step of a planner.
Between two samples a trajectory is linear, before the first and after the last it is held.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Annotated

import numpy as np
import pinocchio as pin
import scipy
from numpy.typing import ArrayLike

from ..arguments import LATER, Shape, checked
from ..arms.arm import Arm
from ..errors import InputError
from .hull import ConvexHull
from .quantities import array_of, finite_pose
from .shapes import Box, Capsule, Sphere

_SHORTEST = 1e-100  # between two indices, so that one over it is a number
#: Times (N,).
Times = Annotated[np.ndarray, Shape("N")]


class _Track:
    """Samples over an increasing index."""

    def __init__(self, source: str, count: int, index: ArrayLike | None) -> None:
        if count == 0:
            raise InputError(source, "samples", count, "at least one")
        expected = f"{count} finite numbers in increasing order"
        index = np.arange(count) if index is None else index
        self.index = array_of(source, "index", index, (count,), expected)
        if not (np.diff(self.index) > _SHORTEST).all():
            raise InputError(source, "index", index, expected)

    def _locate(self, time: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Sample before each time and the fraction of the way to the next, held outside."""
        position = np.interp(time, self.index, np.arange(len(self.index)))
        before = position.astype(int)
        return before, position - before

    def _cumulative(self, time: np.ndarray, steps: np.ndarray) -> np.ndarray:
        """Sum of the steps (M-1, n) walked until each time, (N, n)."""
        total = np.vstack([np.zeros(steps.shape[1]), np.cumsum(steps, axis=0)])
        return np.column_stack([np.interp(time, self.index, column) for column in total.T])


@checked
class JointPath(_Track):
    """Joint vectors q_k at index t_k, q(t) linear in between.

    Parameters
    ----------
    configurations : (M, nq)
        [rad]
    index : (M,), optional
        Increasing; 0 ... M-1 if not given.
    """

    def __init__(self, configurations: ArrayLike, index: ArrayLike | None = None) -> None:
        expected = "finite joint vectors (M, nq)"
        self.configurations = array_of(
            "JointPath", "configurations", configurations, (None, None), expected
        )
        super().__init__("JointPath", len(self.configurations), index)

    @checked
    def at(self, time: Times) -> np.ndarray:
        """q(t) for times (N,), (N, nq)."""
        k, fraction = self._locate(time)
        after = np.minimum(k + 1, len(self.configurations) - 1)
        start = self.configurations[k]
        return start + fraction[:, None] * (self.configurations[after] - start)

    @checked
    def travel(self, time: Times) -> np.ndarray:
        """Angle each joint has covered until t, back and forth added, (N, nq)."""
        return self._cumulative(time, np.abs(np.diff(self.configurations, axis=0)))


@checked
class PosePath(_Track):
    """Poses T_k at index t_k; translation linear and rotation about a fixed axis in between.

    Parameters
    ----------
    poses : sequence of M pinocchio.SE3
    index : (M,), optional
        Increasing; 0 ... M-1 if not given.
    """

    def __init__(self, poses: Sequence[pin.SE3], index: ArrayLike | None = None) -> None:
        if not isinstance(poses, Sequence) or not all(isinstance(one, pin.SE3) for one in poses):
            raise InputError("PosePath", "poses", poses, "a sequence of pinocchio.SE3")
        super().__init__("PosePath", len(poses), index)
        self.translation = array_of(
            "PosePath", "poses", [pose.translation for pose in poses], (None, 3), "finite poses"
        )
        self.rotation = array_of(
            "PosePath", "poses", [pose.rotation for pose in poses], (None, 3, 3), "finite poses"
        )
        relative = self.rotation[:-1].transpose(0, 2, 1) @ self.rotation[1:]
        self._turn = np.vstack(
            [scipy.spatial.transform.Rotation.from_matrix(relative).as_rotvec(), np.zeros((1, 3))]
        )
        self._step = np.vstack([np.diff(self.translation, axis=0), np.zeros((1, 3))])

    @checked
    def at(self, time: Times) -> np.ndarray:
        """T(t) for times (N,), upper parts (N, 3, 4)."""
        k, fraction = self._locate(time)
        turned = scipy.spatial.transform.Rotation.from_rotvec(
            fraction[:, None] * self._turn[k]
        ).as_matrix()
        translation = self.translation[k] + fraction[:, None] * self._step[k]
        return np.concatenate([self.rotation[k] @ turned, translation[:, :, None]], axis=2)

    @checked
    def travel(self, time: Times) -> np.ndarray:
        """Distance covered [m] and angle turned [rad] until t, (N, 2)."""
        steps = [np.linalg.norm(part[:-1], axis=1) for part in (self._step, self._turn)]
        return self._cumulative(time, np.column_stack(steps))


@checked
@dataclass(frozen=True, eq=False)
class MovingShape:
    """A shape, given in its own frame, whose frame follows a path."""

    shape: Annotated[Sphere | Capsule | Box | ConvexHull, LATER]
    path: PosePath

    def __post_init__(self) -> None:
        if not isinstance(self.shape, Sphere | Capsule | Box | ConvexHull):
            expected = "Sphere, Capsule, Box or ConvexHull"
            raise InputError("MovingShape", "shape", self.shape, expected)
        if not isinstance(self.path, PosePath):
            raise InputError("MovingShape", "path", self.path, "a PosePath")


@checked
@dataclass(frozen=True, eq=False)
class MovingArm:
    """An arm on a base at ``placement`` that replays a joint path."""

    arm: Arm
    path: JointPath
    placement: Annotated[pin.SE3, LATER] = field(default_factory=pin.SE3.Identity)

    def __post_init__(self) -> None:
        if not isinstance(self.arm, Arm):
            raise InputError("MovingArm", "arm", self.arm, "an Arm, as load_arm gives it")
        if not isinstance(self.path, JointPath):
            raise InputError("MovingArm", "path", self.path, "a JointPath")
        finite_pose("MovingArm", "placement", self.placement)
        self.arm.configurations(self.path.configurations)
