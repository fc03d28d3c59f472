"""Distances of all pairs of capsules at many configurations, beside the C++ loop of Pinocchio."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pinocchio as pin
from equal_work import reference, same
from planning_scenes import two_arms
from timing import OURS, Row, timed

from dualarm_repro.baselines.pinocchio_scene import whole_model
from dualarm_repro.scene import Scene, distances
from dualarm_repro.scene.pair_kernels import capsules_capsules
from dualarm_repro.scene.placement import place

POSED, PLACED = "distances of capsules, poses included", "distances of capsules in place"
CONFIGURATIONS, CHECKED = 1_000, 50
_PEER = "pin.computeDistances"
_SAME = 1e-6  # [m]
_NO_WITNESS = np.empty((0, 0, 3, 3))


def measure() -> Iterator[Row]:
    """Time per pair. The peer leaves its distances where they are: reading them costs extra."""
    scene = two_arms()
    q = np.random.default_rng(0).uniform(*scene.limits, (CONFIGURATIONS, scene.nq))
    yield from _posed(scene, q)
    yield from _placed(scene, q)


def _posed(scene: Scene, q: np.ndarray) -> Iterator[Row]:
    pairs = len(scene.pairs) * len(q)
    model, geometry = whole_model(scene)
    data, shapes = model.createData(), pin.GeometryData(geometry)

    def loop() -> None:
        for one in q:
            pin.computeDistances(model, data, geometry, shapes, one)

    def found() -> np.ndarray:
        rows = []
        for one in q[:CHECKED]:
            pin.computeDistances(model, data, geometry, shapes, one)
            rows.append([result.min_distance for result in shapes.distanceResults])
        return np.array(rows)

    yield timed(POSED, OURS, lambda: distances(scene, q), pairs, check=reference())
    check = same(lambda: distances(scene, q[:CHECKED]), found, _SAME)
    yield timed(POSED, _PEER, loop, pairs, check=check)


def _placed(scene: Scene, q: np.ndarray) -> Iterator[Row]:
    """Ours for all configurations; the peer again and again for the first, in its caches."""
    bodies, pairs = scene.bodies, scene.pairs.rows["capsule"]
    placed = place(scene, q, np.zeros(len(q)))
    out = np.empty((len(q), len(pairs)))
    model, geometry = whole_model(scene)
    data, shapes = model.createData(), pin.GeometryData(geometry)
    pin.updateGeometryPlacements(model, data, geometry, shapes, q[0])

    def ours() -> np.ndarray:
        capsules_capsules(placed.cores, bodies.radius, pairs, out, _NO_WITNESS, 0)
        return out

    def loop() -> None:
        for _ in range(len(q)):
            pin.computeDistances(geometry, shapes)

    def found() -> list[float]:
        pin.computeDistances(geometry, shapes)
        return [result.min_distance for result in shapes.distanceResults]

    yield timed(PLACED, OURS, ours, out.size, check=reference())
    check = same(lambda: ours()[0], found, _SAME)
    yield timed(PLACED, _PEER, loop, out.size, check=check)
