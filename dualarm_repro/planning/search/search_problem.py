"""A search from both ends: one arm, start, goal, obstacles and settings, checked once."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ...errors import InputError
from ...scene.bodies import PlacedArm
from ..descent.problem import checked_ends
from ..field.control_points import ControlPoints, control_points
from ..field.hull_obstacle import NO_HULL, HullTrack
from ..field.obstacles import Obstacles
from .bidirectional_settings import BidirectionalSettings


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
    ends = checked_ends(placed, start, goal, settings.enforce_limits)
    points = control_points(placed.arm, settings.control_points)
    counted = {"radii": settings.radii, "step.weights": settings.step.weights}
    for field, values in counted.items():
        if values is not None and len(values) != len(points.joint):
            expected = f"{len(points.joint)} numbers, one for each of {', '.join(points.names)}"
            raise InputError("BidirectionalSettings", field, values, expected)
    if settings.radii is not None:
        points = points._replace(radius=np.array(settings.radii))
    if obstacles.moving(0):
        raise InputError("search_problem", "obstacles", obstacles.names, "obstacles that stand")
    if (points.local[:, 0] != points.local[:, 1]).any():
        named = settings.control_points
        raise InputError("search_problem", "control_points", named, "points, not links")
    hulls = (NO_HULL, NO_HULL) if hulls is None else hulls
    return SearchProblem(placed, *ends, obstacles, settings, points, hulls)
