"""A scene as the planners can take it: parked arms as obstacles, hulls as boxes around them.

What is simplified here is never what a plan is judged by; see :mod:`.checks.truth`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

import numpy as np
import pinocchio as pin

from ..scene import (
    Box,
    Capsule,
    ConvexHull,
    HalfSpace,
    JointPath,
    MovingArm,
    MovingShape,
    PlacedArm,
    Scene,
    Shape,
    distances,
    links_of,
    signed_distance,
)
from ..scene.broad_phase import MANY, standing_near, with_obstacles
from ..scene.pairs import names_of


def planner_scene(
    scene: Scene, starts: Mapping[str, np.ndarray], parked: Mapping[str, np.ndarray]
) -> Scene:
    """What a planner of the arms in ``starts`` is told of a scene.

    Arms that are parked stand at their posture, a convex hull is the box around it, obstacles
    that no arm can come near to are left out, and so are capsules that touch an obstacle they are
    exempt from, by which a planner would refuse the start.
    """
    arms = [_unmounted(scene, one, starts.get(one.name)) for one in scene.arms]
    left = {f"{one.name}/{name}": one.name for one in arms for name in links_of(one.arm).names}
    links = {body.name: body.owner for body in scene.bodies.all if body.joint is not None}
    gone = _names(links) - _names(left)
    simple = replace(
        scene,
        arms=arms,
        obstacles={name: _boxed(solid) for name, solid in scene.obstacles.items()},
        moving={name: _moving_box(mover) for name, mover in scene.moving.items()},
        exempt=[pair for pair in scene.exempt if not gone & set(pair)],
    )
    known = with_parked(simple, parked)
    if len(known.obstacles) < MANY:
        return known
    spans = [(one.placement.translation, 1.5 * one.arm.stretched) for one in known.arms]
    low, high = (np.array([at + side * span for at, span in spans]) for side in (-1.0, 1.0))
    return with_obstacles(known, standing_near(known, low, high, 0.0))


def with_parked(scene: Scene, parked: Mapping[str, np.ndarray]) -> Scene:
    """The scene with some of its arms as obstacles that stand at a posture (nq,) [rad]."""
    for name, q in parked.items():
        scene = scene.replaying(name, JointPath([q]))
    return scene


def enclosing_box(hull: ConvexHull) -> Box:
    """Box around a hull along its principal directions."""
    middle = hull.vertices.mean(axis=0)
    _, _, axes = np.linalg.svd(hull.vertices - middle, full_matrices=False)
    rotation = axes.T * np.sign(np.linalg.det(axes))
    local = (hull.vertices - middle) @ rotation
    low, high = local.min(axis=0), local.max(axis=0)
    return Box(middle + rotation @ (0.5 * (low + high)), high - low, rotation)


def _names(links: Mapping[str, str]) -> set[str]:
    """Everything that links of owners answer to."""
    return {known for name, owner in links.items() for known in names_of(name, owner)}


def _boxed(solid: Shape | Sequence[Shape]) -> Shape | Sequence[Shape]:
    boxed = [enclosing_box(s) if isinstance(s, ConvexHull) else s for s in _several(solid)]
    return boxed if isinstance(solid, Sequence) else boxed[0]


def _moving_box(mover: MovingShape | MovingArm) -> MovingShape | MovingArm:
    if isinstance(mover, MovingShape) and isinstance(mover.shape, ConvexHull):
        return MovingShape(enclosing_box(mover.shape), mover.path)
    return mover


def _unmounted(scene: Scene, placed: PlacedArm, start: np.ndarray | None) -> PlacedArm:
    """The arm without capsules that touch, at its start, an obstacle that they may touch."""
    if start is None:
        return placed
    alone = replace(scene, arms=[placed], moving={}, exempt=())
    standing = {body.owner for body in alone.bodies.all} - {placed.name}
    touching = distances(alone, start) <= 0.0
    watched = {frozenset(names) for names in scene.pairs.names}
    mounts = {
        a.name
        for (a, b), touches in zip(alone.pairs.bodies, touching.tolist(), strict=True)
        if touches and b.owner in standing and frozenset((a.name, b.name)) not in watched
    }
    mounts |= {name for name, base in _bases(placed) if _touches(base, alone)}
    if not mounts:
        return placed
    shapes = placed.arm.geometry.geometryObjects
    kept = [one for one in shapes if f"{placed.name}/{one.name}" not in mounts]

    def geometry() -> pin.GeometryModel:
        made = pin.GeometryModel()
        for one in kept:
            made.addGeometryObject(one)
        return made

    return replace(placed, arm=placed.arm.reshaped(geometry))


def _bases(placed: PlacedArm) -> Iterator[tuple[str, Capsule]]:
    """The capsules that never move, which no pair watches against what never moves either."""
    links = links_of(placed.arm)
    for name, joint, core, radius in zip(*links, strict=True):
        if joint == 0:
            start, end = (placed.placement.act(point) for point in core)
            yield f"{placed.name}/{name}", Capsule(start, end, radius)


def _touches(base: Capsule, scene: Scene) -> bool:
    solids = [s for solid in scene.obstacles.values() for s in _several(solid)]
    if scene.floor is not None:
        solids.append(HalfSpace((0.0, 0.0, 1.0), scene.floor))
    return any(signed_distance(base, solid).distance <= 0.0 for solid in solids)


def _several(solid: Shape | Sequence[Shape]) -> Sequence[Shape]:
    return solid if isinstance(solid, Sequence) else (solid,)
