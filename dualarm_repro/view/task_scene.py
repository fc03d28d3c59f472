"""The 3-D scene of a task or a motion: every arm and every body that is judged."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import cycle

import numpy as np

from ..planning.field.control_points import end_effector
from ..scene import HalfSpace, MovingArm, Scene, Shape, clearance
from .scene3d import Scene3D
from .scenes.contents import Mark
from .scenes.nearest import Nearest, nearest_of
from .scenes.solid_parts import half_space_part, solid_part
from .style import PALETTE

_OBSTACLE, _MOVING = "#9A9A9A", "#B4703C"
_GOAL_OPACITY = 0.35


def drawn_scene(
    scene: Scene,
    title: str,
    rows: Mapping[str, np.ndarray],
    index: np.ndarray,
    goals: Mapping[str, np.ndarray] | None = None,
) -> Scene3D:
    """All arms along their rows (N, nq) at an index (N,), among all bodies of a scene.

    Parameters
    ----------
    goals : mapping of arm to (nq,), optional
        Postures drawn faintly beside the others.
    """
    tips = {one.name: end_effector(one, rows[one.name]) for one in scene.arms}
    seen = np.concatenate([*tips.values(), [one.placement.translation for one in scene.arms]])
    reach = float(np.ptp(seen, axis=0).max()) + 1.0
    made = Scene3D(title, camera=(1.1 * reach, -0.9 * reach, 0.9 * reach))
    made.contents.floor = scene.floor
    for name, shape in standing(scene):
        if isinstance(shape, HalfSpace):
            part = half_space_part(name, shape, _OBSTACLE, seen.mean(axis=0), 2.0 * reach)
            made.contents.parts.append(part)
        else:
            made.contents.parts.append(solid_part(name, shape, _OBSTACLE))
    for placed, color in zip(scene.arms, cycle(PALETTE)):
        made.add_arm(placed.name, placed.arm, rows[placed.name][0], placed.placement, color)
        if goals is not None and placed.name in goals:
            ghost = f"{placed.name} at its goal"
            made.add_arm(
                ghost, placed.arm, goals[placed.name], placed.placement, color, _GOAL_OPACITY
            )
        if len(index) > 1:
            made.add_path(f"{placed.name} track", tips[placed.name], color)
    made.animate({one.name: (one.arm, rows[one.name]) for one in scene.arms})
    motion = made.contents.motion
    frames = index[motion.frames] if motion else index[:1]
    _add_moving(made, scene, frames)
    if len(scene.pairs):
        shown = motion.frames if motion else np.zeros(1, dtype=int)
        made.contents.nearest = _nearest(scene, {n: q[shown] for n, q in rows.items()}, frames)
    return made


def standing(scene: Scene) -> list[tuple[str, Shape]]:
    """Each standing shape by the name of its body in ``Scene.bodies``."""
    found: list[tuple[str, Shape]] = []
    for name, solid in scene.obstacles.items():
        found += [(name, shape) for shape in (solid if isinstance(solid, Sequence) else (solid,))]
    return found


def _add_moving(made: Scene3D, scene: Scene, frames: np.ndarray) -> None:
    for name, mover in scene.moving.items():
        if isinstance(mover, MovingArm):
            rows = mover.path.at(frames)
            made.add_arm(name, mover.arm, rows[0], mover.placement, _MOVING)
            continue
        poses = np.tile(np.eye(4), (len(frames), 1, 1))
        poses[:, :3] = mover.path.at(frames)
        made.move(name, poses)
        made.contents.parts.append(solid_part(name, mover.shape, _MOVING, name))
        made.contents.marks.append(Mark(name.replace("_", " "), name, np.zeros(3)))


def _nearest(scene: Scene, rows: Mapping[str, np.ndarray], frames: np.ndarray) -> Nearest:
    """The pairs that the scene watches, so that it shows what the summary says.

    One key frame after the other: an array of many is laid out otherwise, and the first plan would
    wait for the same distances to be compiled once more.
    """
    q = scene.stack(**rows)
    found = [clearance(scene, row, time) for row, time in zip(q, frames, strict=True)]
    distance, point_a, point_b = (
        np.array([getattr(one, what) for one in found])
        for what in ("distance", "point_a", "point_b")
    )
    return nearest_of(distance, point_a, point_b, scene.pairs.bodies)
