"""Potentials over the joints of an arm, each with its value and its gradient by q.

They add up: a planner descends the sum. The value of many configurations at once serves searches.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Generic, Protocol, TypeVar

import numpy as np

from ...arguments import JointRows, Joints, Number, Vector3, checked
from ...errors import ConfigurationError, InputError
from ...scene.bodies import PlacedArm
from ...scene.posing import cores_in
from ..settings import Combination
from .control_points import ControlPoints, end_effector, ends_of, frames_of
from .obstacles import Obstacles


class Potential(Protocol):
    """U(q) at a step of the plan, to which moving obstacles have moved."""

    def value(self, q: np.ndarray, step: Number = 0) -> float | np.ndarray:
        """U for (nq,) -> float or for (N, nq) -> (N,)."""

    def gradient(self, q: np.ndarray, step: Number = 0) -> np.ndarray:
        """dU/dq (nq,) for one configuration (nq,)."""


@checked
@dataclass(frozen=True, eq=False)
class PositionAttraction:
    """U = k/2 |X(q) - X_t|^2, dU/dq = k J^T (X - X_t), with the flange X and its Jacobian J.

    O. Khatib, Real-time obstacle avoidance for manipulators and mobile robots, IJRR 5(1), 1986.

    Attributes
    ----------
    target : ndarray (3,)
        X_t in the world [m].
    gain : float
        k
    """

    placed: PlacedArm
    target: Vector3
    gain: float

    @checked
    def value(self, q: JointRows, step: Number = 0) -> float | np.ndarray:
        """U; ``step`` is of no consequence."""
        return 0.5 * self.gain * np.sum((end_effector(self.placed, q) - self.target) ** 2, axis=-1)

    @checked
    def gradient(self, q: Joints, step: Number = 0) -> np.ndarray:
        """dU/dq (nq,)."""
        J = self.placed.placement.rotation @ self.placed.arm.jacobian(q)[:3]
        return self.gain * J.T @ (end_effector(self.placed, q) - self.target)


@checked
@dataclass(frozen=True, eq=False)
class JointAttraction:
    """U = k/2 |q - q_t|^2, dU/dq = k (q - q_t).

    Beside a position term the gain carries the unit m^2/rad^2: its number depends on the unit of
    length.

    Attributes
    ----------
    target : ndarray (nq,)
        q_t [rad].
    gain : float
        k
    """

    target: Joints
    gain: float

    @checked
    def value(self, q: JointRows, step: Number = 0) -> float | np.ndarray:
        """U; ``step`` is of no consequence."""
        _require_joints("JointAttraction", q, len(self.target))
        return 0.5 * self.gain * np.sum((q - self.target) ** 2, axis=-1)

    @checked
    def gradient(self, q: Joints, step: Number = 0) -> np.ndarray:
        """dU/dq (nq,)."""
        _require_joints("JointAttraction", q, len(self.target))
        return self.gain * (q - self.target)


@checked
@dataclass(frozen=True, eq=False)
class PointRepulsion:
    """U = sum_i w_i sum_m u(d_im), u = k/2 (1/d - 1/d_0)^2 for d < d_0 and 0 beyond; Khatib 1986.

    d_im is the signed distance of control point i to shape m. Below the contact distance d_c, and
    so inside an obstacle, u goes on along its tangent, u(d_c) + u'(d_c) (d - d_c): finite, and its
    gradient points out.

    With ``Combination.SUM`` every shape repels. With ``Combination.NEAREST`` of each obstacle only
    the shape nearest to the control point does: U then has creases where the nearest shape
    changes, on which a descent can halt although no gradient vanishes.

    Attributes
    ----------
    gain : float
        k
    influence, contact : float
        d_0 and d_c [m].
    """

    placed: PlacedArm
    points: ControlPoints
    obstacles: Obstacles
    gain: float
    influence: float
    contact: float
    combination: Combination

    @checked
    def value(self, q: JointRows, step: Number = 0) -> float | np.ndarray:
        """U."""
        return self.terms(q, step).sum(axis=-1)

    @checked
    def terms(self, q: JointRows, step: Number = 0) -> np.ndarray:
        """Share of each control point in U, (K,) or (N, K)."""
        return self._shares(q, step).sum(axis=-1)

    @checked
    def acting(self, q: Joints, step: Number = 0) -> tuple[str, ...]:
        """Names of the shapes that repel at one configuration."""
        acting = np.flatnonzero(self._shares(q, step).any(axis=0))
        return tuple(self.obstacles.names[m] for m in acting)

    @checked
    def gradient(self, q: Joints, step: Number = 0) -> np.ndarray:
        """dU/dq = sum w_i u'(d_im) n_im^T J_i, with the point of the control point nearest to m."""
        _require_joints("PointRepulsion", q, self.placed.arm.nq)
        frames = frames_of(self.placed, q[np.newaxis])
        ends = cores_in(frames, self.points.joint, self.points.local)
        found = self.obstacles.distances(ends, self.points.radius, step)
        distance, point, outward = (part[0] for part in found)
        axes, origins = frames[0, 1:, :, 2], frames[0, 1:, :, 3]
        velocity = np.cross(axes, point[:, :, np.newaxis] - origins)
        carried = np.arange(1, len(q) + 1) <= self.points.joint[:, np.newaxis]
        slope = self.points.weight[:, np.newaxis] * self._slope(distance) * self._chosen(distance)
        return np.einsum("km,kmr,kmjr,kj->j", slope, outward, velocity, carried)

    @checked
    def distances(self, q: JointRows, step: Number = 0) -> np.ndarray:
        """d_im, (K, M) or (N, K, M) [m]."""
        _require_joints("PointRepulsion", q, self.placed.arm.nq)
        ends = ends_of(self.placed, self.points, np.atleast_2d(q))
        distance = self.obstacles.distances(ends, self.points.radius, step)[0]
        return distance[0] if q.ndim == 1 else distance

    def _shares(self, q: np.ndarray, step: int) -> np.ndarray:
        distance = self.distances(q, step)
        return self.points.weight[:, np.newaxis] * self._energy(distance) * self._chosen(distance)

    def _energy(self, d: np.ndarray) -> np.ndarray:
        near = np.clip(d, self.contact, self.influence)
        energy = 0.5 * self.gain * (1.0 / near - 1.0 / self.influence) ** 2
        return energy + self._slope(d) * np.minimum(d - self.contact, 0.0)

    def _slope(self, d: np.ndarray) -> np.ndarray:
        near = np.clip(d, self.contact, self.influence)
        return -self.gain * (1.0 / near - 1.0 / self.influence) / near**2

    def _chosen(self, distance: np.ndarray) -> np.ndarray:
        """Mask of the shapes that count: all, or of each obstacle the nearest."""
        if self.combination is Combination.SUM:
            return np.ones(distance.shape, dtype=bool)
        chosen = np.zeros(distance.shape, dtype=bool)
        for group in set(self.obstacles.group.tolist()):
            shapes = np.flatnonzero(self.obstacles.group == group)
            nearest = shapes[distance[..., shapes].argmin(axis=-1)]
            np.put_along_axis(chosen, nearest[..., np.newaxis], True, axis=-1)
        return chosen


Parts = TypeVar("Parts", bound=Sequence[Potential], covariant=True)


@checked
@dataclass(frozen=True, eq=False)
class Sum(Generic[Parts]):
    """U = sum of the parts.

    Raises
    ------
    InputError
        A part without value and gradient.
    """

    parts: Parts

    def __post_init__(self) -> None:
        expected = "several potentials, each with a value and a gradient"
        if not isinstance(self.parts, Sequence):
            raise InputError("Sum", "parts", self.parts, expected)
        for place, part in enumerate(self.parts):
            if not (hasattr(part, "value") and hasattr(part, "gradient")):
                raise InputError("Sum", f"parts[{place}]", part, expected)

    @checked
    def value(self, q: JointRows, step: Number = 0) -> float | np.ndarray:
        """U."""
        return sum(part.value(q, step) for part in self.parts)

    @checked
    def gradient(self, q: Joints, step: Number = 0) -> np.ndarray:
        """dU/dq (nq,)."""
        return sum((part.gradient(q, step) for part in self.parts), np.zeros_like(q))


def _require_joints(source: str, q: np.ndarray, count: int) -> None:
    if q.ndim > 2 or q.shape[-1:] != (count,):
        raise ConfigurationError(source, "shape of q", q.shape, f"({count},), or rows of {count}")
