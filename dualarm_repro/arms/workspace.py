"""Workspace of one arm by Monte Carlo: the cloud of flange positions, its extents and voxels."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..arguments import Cloud, Count, Positive, checked
from ..errors import InputError
from .arm import Arm

_MOST_CUBES = 1e18  # that an index of 64 bits can number


class Extents(NamedTuple):
    """Smallest and largest coordinates of a cloud in the base frame [m]."""

    lower: np.ndarray  # (3,)
    upper: np.ndarray  # (3,)
    radius: tuple[float, float]  # distance from the z axis
    distance: tuple[float, float]  # distance from the origin


class VoxelVolume(NamedTuple):
    """Volume of the cubes of edge ``cell`` [m] that hold a point of the cloud [m^3]."""

    cell: float
    voxels: int
    volume: float


@checked
def sample_workspace(arm: Arm, n: Count, rng: np.random.Generator) -> np.ndarray:
    """Flange positions p(q) for ``n`` configurations uniform within the limits, (n, 3) [m].

    Uniform joint angles, not uniform positions: the cloud is dense where many configurations lead.
    """
    return arm.positions(arm.random_configurations(n, rng))


@checked
def extents(points: Cloud) -> Extents:
    """Extents of a cloud (n, 3) [m]."""
    radius = np.hypot(points[:, 0], points[:, 1])
    distance = np.hypot(radius, points[:, 2])
    return Extents(
        points.min(axis=0),
        points.max(axis=0),
        (float(radius.min()), float(radius.max())),
        (float(distance.min()), float(distance.max())),
    )


@checked
def voxel_volume(points: Cloud, cells: Sequence[Positive]) -> list[VoxelVolume]:
    """V = h^3 * (number of cubes of edge h that hold a point), for several h [m].

    The number depends on h as much as on the workspace: small cubes stay empty for want of points,
    large ones stick out of the boundary. Use the rotation body of :mod:`.occupancy` for a volume.
    """
    table = []
    for h in cells:
        if not (np.ptp(points, axis=0) / h + 1.0).prod() < _MOST_CUBES:
            expected = f"an edge length [m] with at most {_MOST_CUBES:g} cubes"
            raise InputError("voxel_volume", "cells", h, expected)
        index = np.floor(points / h).astype(np.int64)
        index -= index.min(axis=0)
        size = index.max(axis=0) + 1
        occupied = np.unique(np.ravel_multi_index(index.T, size)).size
        table.append(VoxelVolume(float(h), occupied, occupied * float(h) ** 3))
    return table
