"""Compiled nearest shapes against the distances of all shapes, their order and their moves."""

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualarm_repro.planning.field.nearest_kernels import nearest_shapes, witness
from dualarm_repro.planning.field.obstacles import obstacles_of
from dualarm_repro.scene import Box, Capsule, HalfSpace, PlacedArm, Scene, Sphere

from dualarm_repro.arms import load_arm  # isort: skip

IDENTITY = np.eye(3, 4)[None]


@pytest.fixture(scope="module")
def around():
    shapes = {
        "pair": (Sphere((0.6, 0.0, 0.2), 0.1), Capsule((0.2, 0.5, 0), (0.2, 0.9, 0.3), 0.05)),
        "block": Box((-0.5, -0.2, 0.3), (0.2, 0.4, 0.3), pin.exp3(np.array([0.2, 0.4, 0.1]))),
        "floor": HalfSpace((0.0, 0.1, 1.0), -0.6),
    }  # fmt: skip
    return obstacles_of(Scene([PlacedArm("arm", load_arm("irb120"))], shapes))


def parts(around):
    return (
        around.cores[0], around.radius, around.boxes[0], around.half, around.planes
    )  # fmt: skip


def nearest(around, ends, radius):
    joint, groups = np.zeros(len(ends), np.int64), int(around.group.max()) + 1
    distance, shape = np.empty((len(ends), groups)), np.zeros((len(ends), groups), np.int64)
    frames = IDENTITY.copy()
    nearest_shapes(joint, ends, radius, frames, *parts(around), around.group, distance, shape)
    return distance, shape


def drawn(seed, lengths=True):
    rng = np.random.default_rng(seed)
    ends = np.repeat(rng.uniform(-1.0, 1.0, (4, 1, 3)), 2, axis=1)
    if lengths:
        ends[2:, 1] += rng.normal(scale=0.3, size=(2, 3))
    return ends, rng.uniform(0.0, 0.1, 4)


@settings(max_examples=30)
@given(seed=st.integers(0, 10**6))
def test_of_every_obstacle_the_nearest_shape_counts(around, seed):
    ends, radius = drawn(seed)
    distance, shape = nearest(around, ends, radius)
    every, point, outward = (part[0] for part in around.distances(ends[None], radius, 0))
    for k in range(len(ends)):
        for group in range(distance.shape[1]):
            members = np.flatnonzero(around.group == group)
            best = members[every[k, members].argmin()]
            assert distance[k, group] == pytest.approx(every[k, best], abs=1e-9)
            apart = np.sort(every[k, members])
            if len(members) == 1 or apart[1] - apart[0] > 1e-9:
                assert shape[k, group] == best
            if distance[k, group] + radius[k] > 1e-3:  # outside there is one direction
                p, n = witness(ends[k], IDENTITY[0], *parts(around), best)
                np.testing.assert_allclose(n, outward[k, best], atol=1e-6)
                # On the core here, on the surface there: apart along the direction.
                offset = np.subtract(p, point[k, best])
                np.testing.assert_allclose(np.cross(offset, n), 0.0, atol=1e-6)
                assert np.linalg.norm(offset) <= radius[k] + 1e-9


@settings(max_examples=30)
@given(seed=st.integers(0, 10**6), by=st.floats(0.0, 0.3))
def test_a_distance_changes_by_no_more_than_the_point_moves_and_grows_along_its_direction(
    around, seed, by
):
    ends, radius = drawn(seed, lengths=False)
    distance, shape = nearest(around, ends, radius)
    way = np.random.default_rng(seed).normal(size=3)
    moved, _ = nearest(around, ends + by * way / np.linalg.norm(way), radius)
    assert (np.abs(moved - distance) <= by + 1e-9).all()
    thicker, _ = nearest(around, ends, radius + by)
    np.testing.assert_allclose(thicker, distance - by, atol=1e-9)
    step = 1e-6
    for k in range(len(ends)):
        for group in range(distance.shape[1]):
            if distance[k, group] + radius[k] < 1e-2:
                continue
            _, n = witness(ends[k], IDENTITY[0], *parts(around), shape[k, group])
            assert np.linalg.norm(n) == pytest.approx(1.0)
            further, _ = nearest(around, ends[k : k + 1] + step * np.array(n), radius[k : k + 1])
            # At a crease another shape may be the nearest already.
            assert (further[0, group] - distance[k, group]) / step <= 1.0 + 1e-6


@settings(max_examples=15)
@given(seed=st.integers(0, 10**6))
def test_the_direction_of_a_core_is_of_no_consequence(around, seed):
    ends, radius = drawn(seed)
    one, other = nearest(around, ends, radius), nearest(around, ends[:, ::-1].copy(), radius)
    np.testing.assert_allclose(one[0], other[0], atol=1e-9)


def test_points_over_a_floor_and_beside_a_ball_by_hand():
    shapes = {"ball": Sphere((0.0, 0.0, 1.0), 0.25), "floor": HalfSpace((0, 0, 1), 0.1)}
    around = obstacles_of(Scene([PlacedArm("arm", load_arm("irb120"))], shapes))
    ends = np.array([[[0.0, 0.75, 1.0]] * 2, [[0.0, 1.0, 0.5], [0.0, 1.0, 0.3]]])
    distance, _ = nearest(around, ends, np.array([0.05, 0.1]))
    named = [around.names.index(name) for name in ("ball", "floor")]
    columns = [around.group[k] for k in named]
    found = distance[:, columns]
    np.testing.assert_allclose(found[0], [0.75 - 0.25 - 0.05, 1.0 - 0.1 - 0.05], atol=1e-12)
    np.testing.assert_allclose(found[1], [np.hypot(1, 0.5) - 0.25 - 0.1, 0.3 - 0.1 - 0.1])
    p, n = witness(ends[1], IDENTITY[0], *parts(around), named[1])
    assert p == pytest.approx((0.0, 1.0, 0.3))
    assert n == pytest.approx((0.0, 0.0, 1.0))
