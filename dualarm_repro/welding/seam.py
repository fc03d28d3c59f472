"""The seam of two pipes that meet at a right angle, with the surface normals along it."""

from __future__ import annotations

from dataclasses import dataclass
from numbers import Integral

import numpy as np

from ..arguments import checked
from ..errors import InputError

MOST_POINTS = 100_000  # of a seam


@dataclass(frozen=True, eq=False)
class Seam:
    """A closed seam in the frame of the workpiece.

    Attributes
    ----------
    theta : ndarray (N,)
        Angle around the branch [rad], equally spaced over one turn.
    points : ndarray (N, 3)
        [m]
    normal_main, normal_branch : ndarray (N, 3)
        Outward unit normals of the main pipe and of the branch.
    """

    theta: np.ndarray
    points: np.ndarray
    normal_main: np.ndarray
    normal_branch: np.ndarray

    @property
    def bisector(self) -> np.ndarray:
        """Unit bisector of both normals (N, 3): the direction that sees into the fillet."""
        total = self.normal_main + self.normal_branch
        return total / np.linalg.norm(total, axis=1, keepdims=True)

    @property
    def tangent(self) -> np.ndarray:
        """Unit tangent (N, 3), n_branch x n_main up to its length."""
        along = np.cross(self.normal_main, self.normal_branch)
        return along / np.linalg.norm(along, axis=1, keepdims=True)


@checked
def saddle_seam(radius_main: float, radius_branch: float, count: int) -> Seam:
    """p(theta) = (R_b cos, R_b sin, sqrt(R_a^2 - R_b^2 sin^2)): main pipe along x, branch along z.

    The curve on which two cylinders meet that cross at a right angle; the upper of its two parts.

    Parameters
    ----------
    radius_main, radius_branch : float
        R_a > R_b > 0 [m].
    count : int
        Number of points, at least 3.

    Raises
    ------
    InputError
        A radius that is not positive and finite, R_b >= R_a, or fewer than three points.
    """
    for name, radius in (("radius_main", radius_main), ("radius_branch", radius_branch)):
        if not (np.isfinite(radius) and radius > 0):
            raise InputError("seam", name, radius, "a positive length [m]")
    if radius_branch >= radius_main:
        expected = f"less than the radius of the main pipe, {radius_main:g} m"
        raise InputError("seam", "radius_branch", radius_branch, expected)
    if not isinstance(count, Integral) or not 3 <= count <= MOST_POINTS:
        expected = f"at least 3 seam points, at most {MOST_POINTS}"
        raise InputError("seam", "count", count, expected)
    theta = 2.0 * np.pi * np.arange(count) / count
    cosine, sine, zero = np.cos(theta), np.sin(theta), np.zeros(count)
    y = radius_branch * sine
    z = np.sqrt(radius_main**2 - y**2)
    return Seam(
        theta=theta,
        points=np.column_stack([radius_branch * cosine, y, z]),
        normal_main=np.column_stack([zero, y, z]) / radius_main,
        normal_branch=np.column_stack([cosine, sine, zero]),
    )
