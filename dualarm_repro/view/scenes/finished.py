"""What every scene gets at the end: feet, floor, trails of the flanges, a camera that sees all."""

from __future__ import annotations

from copy import copy
from itertools import product

import numpy as np

from ...scene import PlacedArm
from .arm_parts import FOOT, foot
from .camera import Camera, framed
from .contents import WORLD, Contents, Mark, Part
from .floor import Floor
from .surfaces import surface

#: Thickness of the plate under an arm and height of its collar, as shares of its radius.
_PLATE, _COLLAR = 0.12, 0.5
_NEAR = 0.02  # of the extent: places this close count as one
_FRAMES = 24


def finished(
    contents: Contents, arms: list[tuple[PlacedArm, np.ndarray]]
) -> tuple[Contents, Camera, Floor | None]:
    """A scene with its surroundings; what was put into it stays as it is."""
    made = copy(contents)
    made.parts, made.marks = list(contents.parts), list(contents.marks)
    points = extent(made)
    if not len(points):
        points = np.array([[0.0, 0.0, 0.0], [1.0, 1.0, 1.0]])
    size = float(np.linalg.norm(np.ptp(points, axis=0)))
    _add_trails(made, size)
    height = _floor(made, arms, points)
    if made.grid:
        for placed, _ in arms:
            _add_foot(made, placed, height)
    points = np.concatenate([points, extent(made)])
    floor = Floor.under(points, height) if made.grid else None
    return made, framed(made.direction, points), floor


def extent(contents: Contents) -> np.ndarray:
    """Corners (N, 3) of the boxes around all parts, wherever they move."""
    found = []
    for part in contents.parts:
        if part.kind in ("points", "line"):
            local = np.asarray(part.vertices)
            local = local[:: max(1, len(local) // 200)]
        else:
            vertices = surface(part).vertices
            bounds = np.array([vertices.min(axis=0), vertices.max(axis=0)])
            local = np.array([bounds[list(c), range(3)] for c in product((0, 1), repeat=3)])
        poses = contents.poses(part.node)
        for pose in poses[:: max(1, len(poses) // _FRAMES)]:
            found.append(local @ pose[:3, :3].T + pose[:3, 3])
    return np.concatenate(found) if found else np.empty((0, 3))


def _add_trails(made: Contents, size: float) -> None:
    """The way of each flange unless it is drawn already, and where it starts and ends."""
    drawn = [np.asarray(part.vertices) for part in made.parts if part.kind == "line"]
    for name, tips in made.tips.items():
        color = next((p.color for p in made.parts if p.node.startswith(f"{name}/")), FOOT)
        ends = tips[[0, -1]]
        if not any(_passes(line, ends, _NEAR * size) for line in drawn):
            line = tips[:: max(1, len(tips) // 150)]
            made.parts.append(Part(WORLD, "line", (1.0,), color, vertices=line))
        if np.linalg.norm(ends[1] - ends[0]) < _NEAR * size:
            continue
        for text, place, tone in zip(("start", "goal"), ends, ("#FFFFFF", "#20262C"), strict=True):
            pose = np.eye(4)
            pose[:3, 3] = place
            radius = 0.008 * size
            made.parts.append(Part(WORLD, "tapered", (radius, radius, 0.0), tone, pose))
            if not any(_named(mark, place, 2.0 * _NEAR * size) for mark in made.marks):
                made.marks.append(Mark(text, WORLD, place))


def _passes(line: np.ndarray, places: np.ndarray, near: float) -> bool:
    gaps = np.linalg.norm(line[:, np.newaxis] - places, axis=2).min(axis=0)
    return bool((gaps < near).all())


def _named(mark: Mark, place: np.ndarray, near: float) -> bool:
    return mark.node == WORLD and bool(np.linalg.norm(mark.point - place) < near)


def _floor(made: Contents, arms: list[tuple[PlacedArm, np.ndarray]], points: np.ndarray) -> float:
    if made.floor is not None:
        return made.floor
    feet = [
        placed.placement.translation[2] + f[0] for placed, _ in arms if (f := _foot(made, placed))
    ]
    return float(min([*feet, points[:, 2].min()]))


def _add_foot(made: Contents, placed: PlacedArm, height: float) -> None:
    """A plate on the floor, and from it a column up to the arm."""
    found = _foot(made, placed)
    if found is None:
        return
    low, radius = found
    meshes = _has_meshes(made, placed)
    gap = max(placed.placement.translation[2] + low - height, 0.0)
    plate, top = _PLATE * radius, low + (0.0 if meshes else _COLLAR * radius)
    bottom = low - gap
    made.columns |= gap > radius
    for size, middle in (
        ((1.3 * radius, plate), bottom - 0.5 * plate),
        ((0.8 * radius, top - bottom), 0.5 * (top + bottom)),
    ):
        if size[1] <= 0.0:
            continue
        pose = np.eye(4)
        pose[2, 3] = middle
        made.parts.append(Part(f"{placed.name}/0", "rod", size, FOOT, pose))


def _foot(made: Contents, placed: PlacedArm) -> tuple[float, float] | None:
    """Where an upright arm begins above its base (a mesh: at the base), and its radius there."""
    found = foot(placed.arm) if placed.placement.rotation[2, 2] > 0.99 else None
    return (0.0, found[1]) if found and _has_meshes(made, placed) else found


def _has_meshes(made: Contents, placed: PlacedArm) -> bool:
    nodes = f"{placed.name}/"
    return any(part.kind == "mesh" and part.node.startswith(nodes) for part in made.parts)
