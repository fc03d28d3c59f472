"""A scene in flat arrays, as the kernels that certify edges read it.

Everything that the joints do not move stands: obstacles, bases, and arms that are parked. A joint
is one row, its constant transform and what it carries; capsules are sorted by their joints.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from ..errors import InputError
from .bodies import Body, Sort
from .certificate import reach
from .clearance import distances
from .hull import ConvexHull
from .moving import MovingArm
from .pairs import SORTS
from .placement import place
from .polytope import Polytope
from .posing import links_of
from .scene import Scene

#: A pair that keeps its margin by less than this [m] need not be found free.
FINEST = 2e-5
_NO_SOLID = Polytope(
    np.empty((0, 3)),
    np.empty((0, 4)),
    np.empty((0, 3), dtype=np.int32),
    np.empty((0, 2), dtype=np.int32),
    np.empty((0, 2, 3)),
)


class Hulls(NamedTuple):
    """Convex hulls one after the other: all ``solids``, where the vertices, triangles and edges of
    each begin (H + 1, 3), and the spheres ``around`` (H, 4)."""

    solids: Polytope
    first: np.ndarray
    around: np.ndarray


class EdgeModel(NamedTuple):
    """Constants of a scene for :mod:`.edge_kernels`.

    Joints: transforms ``rotation`` (n, 3, 3) and ``translation`` (n, 3) from the joint before,
    whether the joint ``begins`` an arm (n,) and whether it ``slides`` (n,), and ``until`` (n,)
    which capsule it or a joint before carries. Capsules: ``middle`` and half ``core`` (C, 3) in the
    frame of the joint, ``radius`` and ``extent`` (C,) [m], ``lever`` (C, n): greatest way per way
    of a joint, and ``moved`` (C, 2): the first joint of its arm and the last that moves it, plus
    one. ``pairs`` (P, 4): two capsules and the joints from which on each is moved
    relative to the other; pairs of a capsule with what stands (K, 2), by sort. Bodies that no joint
    moves relative to each other are ``between_standing`` apart [m].
    """

    rotation: np.ndarray
    translation: np.ndarray
    begins: np.ndarray
    slides: np.ndarray
    until: np.ndarray
    middle: np.ndarray
    core: np.ndarray
    radius: np.ndarray
    extent: np.ndarray
    lever: np.ndarray
    moved: np.ndarray
    pairs: np.ndarray
    standing_pairs: np.ndarray
    box_pairs: np.ndarray
    plane_pairs: np.ndarray
    hull_pairs: np.ndarray
    standing: np.ndarray
    standing_radius: np.ndarray
    standing_extent: np.ndarray
    planes: np.ndarray
    boxes: np.ndarray
    half: np.ndarray
    hulls: Hulls
    between_standing: float
    finest: float


@lru_cache(maxsize=64)
def edge_model(scene: Scene, left_out: frozenset[int] = frozenset()) -> EdgeModel:
    """The arrays of a scene in which nothing moves by itself.

    Parameters
    ----------
    left_out : set of int
        Numbers of watched pairs that are not looked at.

    Raises
    ------
    InputError
        Naming a body that moves.
    """
    for name, mover in scene.moving.items():
        if not isinstance(mover, MovingArm) or len(mover.path.index) > 1:
            raise InputError("edge_model", "moving", name, "a scene in which only the arms move")
    rows = {b: _first(scene, b.owner) + b.joint - 1 for b in scene.bodies.all if b.joint}
    carried = sorted(rows, key=rows.__getitem__)
    row = np.array([rows[body] for body in carried], dtype=np.int64)
    core, radius, lever = _capsules(scene, carried)
    half = 0.5 * (core[:, 1] - core[:, 0])
    placed, bodies = place(scene, np.zeros((1, scene.nq)), np.zeros(1)), scene.bodies
    long = 0.5 * (placed.cores[0, :, 1] - placed.cores[0, :, 0])
    rotation, translation, begins, slides = _joints(scene)
    watched = [pair for k, pair in enumerate(scene.pairs.bodies) if k not in left_out]
    number = {body: k for k, body in enumerate(carried)}
    both, standing, boxes, planes, hulls = _pairs(scene, watched, number)
    return EdgeModel(
        rotation,
        translation,
        begins,
        slides,
        np.searchsorted(row, np.arange(scene.nq), "right"),
        core.mean(axis=1),
        half,
        radius,
        np.linalg.norm(half, axis=1),
        lever,
        _moved(scene, carried, lever),
        both,
        standing,
        boxes,
        planes,
        hulls,
        np.hstack([placed.cores[0].mean(axis=1), long]),
        bodies.radius,
        np.linalg.norm(long, axis=1),
        bodies.planes,
        np.ascontiguousarray(placed.boxes[0]),
        bodies.half,
        _hulls(bodies.hulls),
        _between_standing(scene, left_out),
        FINEST,
    )


def _first(scene: Scene, owner: str) -> int:
    return int(scene.columns[owner].start)


def _joints(scene: Scene) -> tuple[np.ndarray, ...]:
    """Rotation, translation, begins and slides of :class:`EdgeModel`."""
    rotation, translation = np.empty((scene.nq, 3, 3)), np.empty((scene.nq, 3))
    begins, slides = np.zeros(scene.nq, dtype=np.bool_), np.zeros(scene.nq, dtype=np.bool_)
    for placed in scene.arms:
        columns, chain = scene.columns[placed.name], placed.arm.motion
        base = placed.placement
        rotation[columns], translation[columns] = chain.rotation[:-1], chain.translation[:-1]
        first = columns.start
        translation[first] = base.act(chain.translation[0])
        rotation[first] = base.rotation @ chain.rotation[0]
        begins[first], slides[columns] = True, placed.arm.slides
    return rotation, translation, begins, slides


def _capsules(scene: Scene, carried: Sequence[Body]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Cores (C, 2, 3) in the frames of their joints, radii and levers (C, n)."""
    widest = np.abs(scene.limits).max(axis=0)
    links = {placed.name: links_of(placed.arm) for placed in scene.arms}
    levers = {
        placed.name: reach(placed.arm, widest[scene.columns[placed.name]]) for placed in scene.arms
    }
    core, radius = np.empty((len(carried), 2, 3)), np.empty(len(carried))
    lever = np.zeros((len(carried), scene.nq))
    for k, body in enumerate(carried):
        core[k] = links[body.owner].local[body.link]
        radius[k] = links[body.owner].radius[body.link]
        lever[k, scene.columns[body.owner]] = levers[body.owner][body.link]
    return core, radius, lever


def _moved(scene: Scene, carried: Sequence[Body], lever: np.ndarray) -> np.ndarray:
    first = np.array([_first(scene, body.owner) for body in carried], dtype=np.int64)
    after = [
        row.nonzero()[0][-1] + 1 if row.any() else k for k, row in zip(first, lever, strict=True)
    ]
    return np.stack([first, np.array(after, dtype=np.int64)], axis=1)


def _pairs(
    scene: Scene, watched: Sequence[tuple[Body, Body]], number: Mapping[Body, int]
) -> tuple[np.ndarray, ...]:
    """Rows of ``pairs`` and of the pairs with what stands, by sort."""
    both: list[tuple[int, ...]] = []
    standing: dict[Sort, list[tuple[int, ...]]] = {sort: [] for sort in SORTS}
    for a, b in watched:
        if a in number and b in number:
            first, second = _first(scene, a.owner), _first(scene, b.owner)
            if a.owner == b.owner:
                low, high = sorted((a, b), key=lambda body: body.joint or 0)
                both.append((number[low], number[high], scene.nq, first + (low.joint or 0)))
            else:
                both.append((number[a], number[b], first, second))
        elif a in number:
            standing[b.sort].append((number[a], b.row))
        elif b in number:
            standing[a.sort].append((number[b], a.row))
    tables = (np.array(rows, dtype=np.int64).reshape(-1, 2) for rows in standing.values())
    return np.array(both, dtype=np.int64).reshape(-1, 4), *tables


def _between_standing(scene: Scene, left_out: frozenset[int]) -> float:
    """Smallest distance of two bodies that no joint moves relative to each other [m]."""
    still = np.array([not (a.joint or b.joint) for a, b in scene.pairs.bodies], dtype=bool)
    still[list(left_out)] = False
    if not still.any():
        return np.inf
    return float(distances(scene, np.zeros(scene.nq))[still].min())


def _hulls(hulls: Sequence[ConvexHull]) -> Hulls:
    first = np.zeros((len(hulls) + 1, 3), dtype=np.int64)
    around = np.empty((len(hulls), 4))
    for k, hull in enumerate(hulls):
        solid = hull.polytope
        sizes = len(solid.vertices), len(solid.planes), len(solid.edges)
        first[k + 1] = first[k] + sizes
        around[k, :3] = hull.vertices.mean(axis=0)
        around[k, 3] = np.linalg.norm(hull.vertices - around[k, :3], axis=1).max()
    parts = zip(_NO_SOLID, *(hull.polytope for hull in hulls), strict=True)
    solids = (np.ascontiguousarray(np.concatenate(part)) for part in parts)
    return Hulls(Polytope(*solids), first, around)
