"""What the distance of a point to an arm costs: to the hull of its circles, or to its capsules."""

from __future__ import annotations

from collections.abc import Callable
from time import perf_counter
from typing import Any

import numpy as np

from ...instrument import Instrument
from ...scene import PlacedArm
from ...scene.points import point_capsule
from ...scene.posing import links_of
from ..field.hull_obstacle import HullTrack, hull_track, point_hull
from .hull_cover import link_cores

_AWAY = 0.5  # of a point from the middle of the hull [m]


def query_operations(
    placed: PlacedArm, track: HullTrack, q: np.ndarray, rng: np.random.Generator
) -> tuple[float, float]:
    """Mean operations of the distance of a point to the hull, and to all capsules of the arm.

    One point for each of the configurations (N, nq), to which the first rows of ``track`` belong,
    half a metre from the middle of the hull; see ``dualarm_repro.instrument`` for what counts.
    """
    radii, hulls, capsules = links_of(placed.arm).radius, [], []
    cost = Instrument().cost
    for k, cores in enumerate(link_cores(placed, q)):
        planes, triangles = distinct_faces(track, k)
        direction = rng.normal(size=3)
        point = tuple(triangles.mean(axis=(0, 1)) + _AWAY * direction / np.linalg.norm(direction))
        hulls.append(cost(point_hull, point, planes, triangles).operations)
        links = [(tuple(a), tuple(b - a), float(r)) for (a, b), r in zip(cores, radii, strict=True)]
        capsules.append(sum(cost(point_capsule, point, *link).operations for link in links))
    return float(np.mean(hulls)), float(np.mean(capsules))


def query_times(
    placed: PlacedArm, track: HullTrack, point: tuple[float, float, float], count: int
) -> dict[str, float]:
    """Microseconds of one query of the first hull and of the capsules, and of building the hull,
    from plain Python; means of ``count`` calls, of the dearer ones fewer."""
    links = links_of(placed.arm)
    planes, triangles = distinct_faces(track, 0)
    axes = [tuple(row[1] - row[0]) for row in links.local]

    def capsules() -> list[Any]:
        return [
            point_capsule(point, tuple(row[0]), axis, radius)
            for row, axis, radius in zip(links.local, axes, links.radius, strict=True)
        ]

    return {
        "hull_query_us": _clocked(lambda: point_hull(point, planes, triangles), count),
        "capsules_query_us": _clocked(capsules, count // 10),
        "hull_build_us": _clocked(lambda: hull_track(triangles.reshape(1, -1, 3)), count // 100),
    }


def distinct_faces(track: HullTrack, row: int) -> tuple[np.ndarray, np.ndarray]:
    """Planes (F, 4) and triangles (F, 3, 3) of one hull, without the repeated last face that fills
    its row."""
    corners = track.triangles[row].reshape(-1, 9)
    faces = np.sort(np.unique(corners, axis=0, return_index=True)[1])
    return track.planes[row][faces], track.triangles[row][faces]


def _clocked(function: Callable[[], Any], count: int) -> float:
    function()
    began = perf_counter()
    for _ in range(count):
        function()
    return 1e6 * (perf_counter() - began) / count
