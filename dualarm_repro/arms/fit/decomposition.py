"""Several capsules around one shape: it is cut by planes as long as that saves volume."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..capsules import to_segment
from .capsule_kernels import covered, cut, refined, smallest

#: Most capsules around a shape, and the share of the volume of the first one that each further one
#: has to save.
MOST, SAVING = 10, 0.015
_PLACES = ((0.15,), (0.3,), (0.5,), (0.7,), (0.85,), (1 / 3, 2 / 3), (0.25, 0.5, 0.75))
_POINTS = 500  # of the surface, by which the cuts are chosen
_PROBES = 4000  # of space, by which volumes are compared
_MANY = 20_000  # points to look at for the farthest
_FEWEST = 8  # points on each side of a cut
_LAP = 0.03  # share of the height by which the parts of a trial cut overlap


class Piece(NamedTuple):
    """A capsule (start, end, radius) and the part of the surface (T, 3, 3) that it contains."""

    start: np.ndarray
    end: np.ndarray
    radius: float
    triangles: np.ndarray


class Cut(NamedTuple):
    """Parallel planes normal . p = offset, the parts of the points between them, and the probes
    saved for each further capsule."""

    saved: float
    normal: np.ndarray
    offsets: tuple[float, ...]
    parts: tuple[np.ndarray, ...]


_NO_CUT = Cut(0.0, np.zeros(3), (), ())


def decompose(triangles: np.ndarray, most: int = MOST, saving: float = SAVING) -> list[Piece]:
    """Capsules whose union contains the triangles (T, 3, 3) and what they enclose.

    The shape is cut by planes across its main axes, each time where the union of the new capsules
    is the smallest, until a cut saves less than ``saving`` of the volume of the first capsule for
    each capsule more or there are ``most``. Each capsule contains its part of the cut surface,
    therefore the convex hull of that part, and these hulls cover the solid.
    """
    points = surface_points(triangles, _POINTS)
    probes = _probes(points)
    leaves = [(triangles, _best_cut(points, probes, most - 1))]
    enough = max(1.0, saving * _count(probes, [_fit(points)]))
    while True:
        room = most - len(leaves)
        open_ = [k for k, (_, one) in enumerate(leaves) if 0 < len(one.offsets) <= room]
        if not open_:
            break
        k = max(open_, key=lambda k: leaves[k][1].saved)
        part, planes = leaves[k]
        if planes.saved < enough:
            break
        pieces = _cut_apart(part, planes)
        room -= len(pieces) - 1
        leaves[k : k + 1] = [
            (piece, _best_cut(own, probes, room))
            for piece, own in zip(pieces, planes.parts, strict=True)
            if len(piece)
        ]
    return [Piece(*around(part.reshape(-1, 3)), part) for part, _ in leaves]


def _cut_apart(triangles: np.ndarray, planes: Cut) -> list[np.ndarray]:
    """The parts of a surface between parallel planes, in their order."""
    found, rest = [], triangles
    for offset in planes.offsets:
        below, rest = cut(rest, planes.normal, offset)
        found.append(below)
    return [*found, rest]


def around(points: np.ndarray) -> tuple[np.ndarray, np.ndarray, float]:
    """A small capsule around points (N, 3): start, end and radius."""
    core = extreme(points)
    capsule = np.empty(7)
    refined(core, main_axes(points), 24, capsule)
    start, end = capsule[:3].copy(), capsule[3:6].copy()
    return start, end, float(to_segment(points, start, end).max())


def main_axes(points: np.ndarray) -> np.ndarray:
    """Directions of least, middle and largest spread of points (3, 3), as rows."""
    if len(points) < 2:
        return np.eye(3)
    return np.ascontiguousarray(np.linalg.eigh(np.cov(points.T))[1].T)


def extreme(points: np.ndarray) -> np.ndarray:
    """Of points (N, 3), of very many of a share, those that reach farthest in 200 directions."""
    points = points[:: 1 + len(points) // _MANY]
    k = np.arange(200) + 0.5
    z, turn = 1.0 - k / 100.0, np.pi * (1.0 + 5.0**0.5) * k
    across = np.sqrt(1.0 - z * z)
    directions = np.column_stack([across * np.cos(turn), across * np.sin(turn), z])
    return points[np.unique((directions @ points.T).argmax(axis=1))]


def surface_points(triangles: np.ndarray, count: int) -> np.ndarray:
    """``count`` points spread over triangles (T, 3, 3) by area, and their extreme vertices."""
    edge_1, edge_2 = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    area = 0.5 * np.linalg.norm(np.cross(edge_1, edge_2), axis=1)
    corners = extreme(triangles.reshape(-1, 3))
    if not area.sum() > 0.0:
        return corners
    rng = np.random.default_rng(0)
    reached = np.cumsum(area)
    chosen = np.searchsorted(reached, rng.random(count) * reached[-1]).clip(max=len(area) - 1)
    s, t = rng.random((2, count, 1))
    s, t = np.where(s + t > 1.0, 1.0 - s, s), np.where(s + t > 1.0, 1.0 - t, t)
    return np.vstack([corners, triangles[chosen, 0] + s * edge_1[chosen] + t * edge_2[chosen]])


def _probes(points: np.ndarray) -> np.ndarray:
    """Points spread over the box of a shape and somewhat beyond, evenly (P, 3)."""
    low, high = points.min(axis=0), points.max(axis=0)
    phi = 1.2207440846057596  # root of phi^4 = phi + 1
    fraction = np.outer(np.arange(1, _PROBES + 1), phi ** -np.arange(1.0, 4.0)) % 1.0
    margin = 0.15 * (high - low).max()
    return low - margin + fraction * (high - low + 2.0 * margin)


def _fit(points: np.ndarray) -> np.ndarray:
    capsule = np.empty(7)
    smallest(points, main_axes(points), capsule)
    return capsule


def _count(probes: np.ndarray, capsules: list[np.ndarray]) -> int:
    """How many probes lie in some of the capsules."""
    inside = np.zeros(len(probes), dtype=np.bool_)
    for capsule in capsules:
        covered(probes, capsule, inside)
    return int(inside.sum())


def _best_cut(points: np.ndarray, probes: np.ndarray, most: int) -> Cut:
    """Across one of the main axes of the points: at one of five places, or into three or four equal
    parts, by at most ``most`` planes."""
    best, before = _NO_CUT, _count(probes, [_fit(points)])
    for normal in main_axes(points):
        height = points @ normal
        low, high = height.min(), height.max()
        lap = _LAP * (high - low)
        for places in _PLACES:
            if len(places) > most:
                continue
            offsets = tuple(float(low + place * (high - low)) for place in places)
            # Points near a plane belong to both sides, as the edge of the cut surface will.
            bounds = zip((-np.inf, *offsets), (*offsets, np.inf), strict=True)
            parts = tuple(points[(height >= a - lap) & (height <= b + lap)] for a, b in bounds)
            if min(map(len, parts)) >= _FEWEST:
                saved = (before - _count(probes, [_fit(part) for part in parts])) / len(offsets)
                if saved > best.saved:
                    best = Cut(saved, normal, offsets, parts)
    return best
