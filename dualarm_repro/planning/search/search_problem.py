"""A search from both ends: one arm, start, goal, obstacles and settings, checked once."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ...arms import Arm
from ...errors import InputError
from ...kernel import kernel
from ...scene.bodies import PlacedArm
from ...tracking import kept_with_owner
from ..descent.problem import checked_ends
from ..field.control_points import ControlPoints, control_points
from ..field.hull_obstacle import NO_HULL, HullTrack
from ..field.obstacles import Obstacles
from ..settings import PointSet
from .bidirectional_settings import BidirectionalSettings

_FLOAT = np.dtype(float)


@dataclass(frozen=True, eq=False)
class SearchProblem:
    """What the search is given; build it with :func:`search_problem`."""

    placed: PlacedArm
    start: np.ndarray
    goal: np.ndarray
    obstacles: Obstacles
    settings: BidirectionalSettings
    points: ControlPoints
    hulls: tuple[HullTrack, HullTrack]

    @cached_property
    def weights(self) -> np.ndarray:
        """tau (K,), scaled to sum one."""
        count = len(self.points.joint)
        weights = np.array(self.settings.step.weights or (1.0,) * count)
        return weights / weights.sum()

    @cached_property
    def limits(self) -> tuple[np.ndarray, np.ndarray]:
        """Limits a step may not leave; infinite unless they are enforced."""
        return self.placed.arm.limits(self.settings.enforce_limits)


def search_problem(
    placed: PlacedArm,
    start: ArrayLike,
    goal: ArrayLike,
    obstacles: Obstacles,
    settings: BidirectionalSettings,
    hulls: tuple[HullTrack, HullTrack] | None = None,
) -> SearchProblem:
    """Check the parts of a search and put them together.

    Raises
    ------
    ConfigurationError
        Start or goal of the wrong shape, with NaN or infinity, or outside limits that are enforced.
    InputError
        Control points the arm lacks, radii or weights that do not match them, an obstacle that
        moves by itself, or links instead of points.
    """
    arm = placed.arm
    ends = _plain_ends(arm, start, goal, settings.enforce_limits)
    if ends is None:
        ends = checked_ends(placed, start, goal, settings.enforce_limits)
    points, are_points = _points_of(arm, settings.control_points)
    radii, weights = settings.radii, settings.step.weights
    for field, values in (("radii", radii), ("step.weights", weights)):
        if values is not None and len(values) != len(points.joint):
            expected = f"{len(points.joint)} numbers, one for each of {', '.join(points.names)}"
            raise InputError("BidirectionalSettings", field, values, expected)
    names, joint, local, radius, weight = points
    radius = radius.copy() if radii is None else np.array(radii)
    points = ControlPoints(names, joint.copy(), local.copy(), radius, weight.copy())
    if len(obstacles.cores) > 1:
        raise InputError("search_problem", "obstacles", obstacles.names, "obstacles that stand")
    if not are_points:
        named = settings.control_points
        raise InputError("search_problem", "control_points", named, "points, not links")
    hulls = (NO_HULL, NO_HULL) if hulls is None else hulls
    return SearchProblem(placed, *ends, obstacles, settings, points, hulls)


def _points_of(arm: Arm, choice: PointSet | tuple[int, ...]) -> tuple[ControlPoints, bool]:
    """Control points of an arm, and whether they are points and not links; made once for an arm."""
    kept = _kept_points(arm)
    if choice not in kept:
        points = control_points(arm, choice)
        kept[choice] = points, bool((points.local[:, 0] == points.local[:, 1]).all())
    return kept[choice]


@kept_with_owner
def _kept_points(_: Arm) -> dict[PointSet | tuple[int, ...], tuple[ControlPoints, bool]]:
    return {}


def _plain_ends(
    arm: Arm, start: ArrayLike, goal: ArrayLike, within_limits: bool
) -> tuple[np.ndarray, np.ndarray] | None:
    """Copies of ends that are plain arrays without a fault; None: look closer, and name it."""
    if type(start) is not np.ndarray or type(goal) is not np.ndarray:
        return None
    ends = start.copy(), goal.copy()
    for end in ends:
        if end.dtype != _FLOAT or end.shape != (arm.nq,):
            return None
    return ends if _faultless(*ends, *arm.limits(within_limits)) else None


@kernel
def _faultless(start, goal, lower, upper):
    """Whether two ends are finite and within limits."""
    for j in range(len(lower)):
        for q in (start[j], goal[j]):
            if not (np.isfinite(q) and lower[j] <= q <= upper[j]):
                return False
    return True
