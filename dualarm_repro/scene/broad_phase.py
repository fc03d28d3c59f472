"""Broad phase: which of many standing obstacles a motion can come near to at all.

Over a piece of path no point of a link is farther than w / 2 from where it is at one of the two
ends, w being the travel bound of :mod:`.certificate`. The axis-aligned box around the link at both
ends, grown by its radius and w / 2, therefore holds the link throughout. An obstacle whose box
stays farther than some distance from all of these cannot be the nearest one if a smaller distance
is known.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np

from ..kernel import kernel
from .certificate import reach
from .clearance import distances
from .hull import ConvexHull
from .placement import arm_frames
from .posing import cores_in, links_of
from .scene import Scene
from .shapes import Box, Capsule, HalfSpace, Shape, Sphere

#: Standing shapes from which on the sweep is worth its time.
MANY = 100
#: Configurations at which a first distance is measured against everything.
_LOOKS = 12


def near_scene(scene: Scene, path: np.ndarray, index: np.ndarray) -> Scene:
    """The scene without the standing obstacles that cannot be nearest on a path (M, nq).

    Its smallest distance along the path, linear between the samples at ``index`` (M,), is that of
    the scene, since what is left out is farther than a distance that was measured.
    """
    shapes = {name: _shapes(solid) for name, solid in scene.obstacles.items()}
    if sum(map(len, shapes.values())) < MANY:
        return scene
    low, high = swept_boxes(scene, path)
    looks = np.unique(np.linspace(0, len(path) - 1, _LOOKS).round().astype(int))
    for _ in range(2):
        found = distances(scene, path[looks], index[looks])
        scene = _within(scene, low, high, float(found.min(initial=np.inf)))
        looks = np.arange(len(path))
    return scene


def standing_near(scene: Scene, low: np.ndarray, high: np.ndarray, margin: float) -> list[str]:
    """Names of the obstacles whose boxes are within ``margin`` of boxes (N, 3), (N, 3)."""
    kept = []
    for name, solid in scene.obstacles.items():
        bounds = np.array([bounds_of(shape) for shape in _shapes(solid)])
        if _any_near(bounds[:, 0], bounds[:, 1], low, high, margin):
            kept.append(name)
    return kept


def with_obstacles(scene: Scene, names: Iterable[str]) -> Scene:
    """The scene with some of its standing obstacles, and the exemptions that still have a body."""
    kept = {name: scene.obstacles[name] for name in names}
    exempt = _still_named(scene, set(scene.obstacles) - set(kept))
    return replace(scene, obstacles=kept, exempt=exempt)


def with_arms(scene: Scene, names: Iterable[str]) -> Scene:
    """The scene with some of its controlled arms, and the exemptions that still have a body."""
    kept = [placed for placed in scene.arms if placed.name in set(names)]
    dropped = set(scene.columns) - {placed.name for placed in kept}
    return replace(scene, arms=kept, exempt=_still_named(scene, dropped))


def bounds_of(shape: Shape) -> tuple[np.ndarray, np.ndarray]:
    """Lower and upper corner (3,) of the axis-aligned box around a shape."""
    match shape:
        case Sphere() | Capsule():
            return shape.core.min(axis=0) - shape.radius, shape.core.max(axis=0) + shape.radius
        case Box():
            half = np.abs(shape.rotation) @ shape.half
            return shape.center - half, shape.center + half
        case ConvexHull():
            return shape.vertices.min(axis=0), shape.vertices.max(axis=0)
        case HalfSpace():
            return np.full(3, -np.inf), np.full(3, np.inf)


def swept_boxes(scene: Scene, path: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Corners (N, 3), (N, 3) of boxes that hold every link over every piece of a path."""
    lows, highs = [], []
    ends = np.array([path, path]) if len(path) == 1 else np.array([path[:-1], path[1:]])
    frames = [arm_frames(scene, rows) for rows in ends]
    for k, placed in enumerate(scene.arms):
        links, columns = links_of(placed.arm), scene.columns[placed.name]
        slide = np.abs(path[:, columns]).max(axis=0)
        travel = np.abs(ends[1] - ends[0])[:, columns] @ reach(placed.arm, slide).T
        grown = (links.radius + 0.5 * travel)[..., np.newaxis]
        cores = np.concatenate([cores_in(one[k], links.joint, links.local) for one in frames], 2)
        lows.append((cores.min(axis=2) - grown).reshape(-1, 3))
        highs.append((cores.max(axis=2) + grown).reshape(-1, 3))
    return np.concatenate(lows), np.concatenate(highs)


def _within(scene: Scene, low: np.ndarray, high: np.ndarray, margin: float) -> Scene:
    return with_obstacles(scene, standing_near(scene, low, high, max(margin, 0.0)))


def _still_named(scene: Scene, dropped: set[str]) -> list[tuple[str, str]]:
    return [pair for pair in scene.exempt if not any(n.split("/")[0] in dropped for n in pair)]


def _shapes(solid: Shape | Sequence[Shape]) -> Sequence[Shape]:
    return solid if isinstance(solid, Sequence) else (solid,)


@kernel
def _any_near(low_a, high_a, low_b, high_b, margin):
    for a in range(len(low_a)):
        for b in range(len(low_b)):
            square = 0.0
            for k in range(3):
                gap = max(low_a[a, k] - high_b[b, k], low_b[b, k] - high_a[a, k], 0.0)
                square += gap * gap
            if square <= margin * margin:
                return True
    return False
