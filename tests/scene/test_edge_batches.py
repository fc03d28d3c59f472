"""Edges judged side by side: each as if it were alone, and truly."""

import numpy as np
import pinocchio as pin
import pytest

from dualarm_repro.arms import load_arm
from dualarm_repro.scene import Box, PlacedArm, Scene, Sphere, distances
from dualarm_repro.scene.edge_batches import edges_free
from dualarm_repro.scene.edge_kernels import edge_buffers, edge_free
from dualarm_repro.scene.edge_model import edge_model
from dualarm_repro.scene.edges import free_edges
from dualarm_repro.scene.lane_verdicts import (
    LANES,
    box_verdict,
    plane_verdict,
    queue_capsules,
    queue_standing,
    queue_verdict,
)
from dualarm_repro.scene.segments import segment_segment

MARGIN = 0.005
ALL = (1 << LANES) - 1


@pytest.fixture(scope="module", params=["one arm", "two arms"])
def scene(request):
    balls = {"first": Sphere([0.0, 0.1, 0.6], 0.07), "second": Sphere([0.0, -0.25, 0.4], 0.06)}
    turned = pin.SE3(pin.rpy.rpyToMatrix(0.0, 0.0, np.pi), np.array([0.4, 0.0, 0.0]))
    arms = [PlacedArm("a", load_arm("irb120"), pin.SE3(np.eye(3), np.array([-0.4, 0.0, 0.0])))]
    if request.param == "two arms":
        arms.append(PlacedArm("b", load_arm("irb120"), turned))
    crate = Box([0.0, 0.5, 0.2], [0.1, 0.1, 0.2], pin.rpy.rpyToMatrix(0.1, 0.2, 0.3))
    return Scene(arms, balls | {"crate": crate}, floor=0.0)


def _edges(scene, count, seed, width):
    rng = np.random.default_rng(seed)
    starts = rng.uniform(*scene.limits, (count, scene.nq))
    return starts, starts + rng.uniform(-width, width, starts.shape)


def _smallest(scene, starts, ends, samples=101):
    share = np.linspace(0.0, 1.0, samples)[:, np.newaxis]
    return np.array(
        [distances(scene, a + share * (b - a)).min() for a, b in zip(starts, ends, strict=True)]
    )


@pytest.mark.parametrize("width", [0.02, 0.4, 1.5])
def test_no_edge_is_wrongly_free_and_those_that_are_not_come_near(scene, width):
    """600 edges of each length for one arm and for two; distances sampled by other code."""
    starts, ends = _edges(scene, 600, 1, width)
    free, smallest = free_edges(scene, starts, ends, MARGIN), _smallest(scene, starts, ends)
    assert 0 < free.sum() < 600
    assert (smallest[free] > MARGIN).all()
    assert (smallest[~free] <= MARGIN + 3e-3 * width).all()


def test_the_answer_hangs_on_no_edge_beside_it(scene):
    starts, ends = _edges(scene, 150, 2, 0.6)
    free = free_edges(scene, starts, ends, MARGIN)
    alone = [free_edges(scene, a[None], b[None], MARGIN)[0] for a, b in zip(starts, ends, strict=1)]
    np.testing.assert_array_equal(free, alone)
    order = np.random.default_rng(3).permutation(150)
    np.testing.assert_array_equal(
        free_edges(scene, starts[order], ends[order], MARGIN), free[order]
    )


def test_it_is_the_answer_for_edges_one_by_one(scene):
    """The kernel of trees, which halves from sixteen stretches on, judges alike."""
    starts, ends = _edges(scene, 400, 4, 0.4)
    model = edge_model(scene)
    buffers = edge_buffers(model)
    single = [
        edge_free(model, a, b, MARGIN, False, buffers)[0] for a, b in zip(starts, ends, strict=1)
    ]
    free = free_edges(scene, starts, ends, MARGIN)
    clear = np.abs(_smallest(scene, starts, ends) - MARGIN) > 1e-4
    np.testing.assert_array_equal(free[clear], np.array(single)[clear])
    assert clear.mean() > 0.9


def test_edges_that_just_keep_the_margin_are_halved_to_the_end(scene):
    """So many stretches wait, of every length, that one stack holds them only in good order."""
    starts, ends = _edges(scene, 60, 5, 0.4)
    keep = distances(scene, starts).min(axis=1) > 0.02
    starts, ends = starts[keep], ends[keep]
    smallest = _smallest(scene, starts, ends, 2001)
    model = edge_model(scene)
    for row in np.flatnonzero(smallest > 0.001)[:10]:
        first, last = np.repeat(starts[[row]], 70, axis=0), np.repeat(ends[[row]], 70, axis=0)
        free, looked = np.empty(70, dtype=bool), np.empty(70, dtype=np.int64)
        edges_free(model, first, last, smallest[row] + 1e-9, free, looked)
        assert not free.any()
        edges_free(model, first, last, smallest[row] - 1e-4, free, looked)
        assert free.all()
        assert len(set(looked.tolist())) == 1


def test_few_configurations_are_looked_at_where_there_is_room():
    scene = Scene([PlacedArm("a", load_arm("irb120"))])
    starts = np.zeros((40, 6))
    free, looked = np.empty(40, dtype=bool), np.empty(40, dtype=np.int64)
    edges_free(edge_model(scene), starts, starts + 0.01, 0.0, free, looked)
    assert free.all()
    assert (looked == 2).all()


def _block(cores):
    middle, half = cores.mean(axis=1), 0.5 * (cores[:, 1] - cores[:, 0])
    return np.concatenate([middle.T, half.T]).reshape(-1)


@pytest.mark.parametrize("parallel", [False, True])
@pytest.mark.parametrize("stands", [False, True])
def test_queued_capsules_are_judged_by_the_distance_of_segments(parallel, stands):
    rng, length = np.random.default_rng(7), 0.6
    squares = (0.25 * length**2,) * 2
    for _ in range(50):
        first, second = rng.normal(size=(2, LANES, 2, 3))
        if stands:
            second[:] = second[0]
        if parallel:
            first[:, 1] = first[:, 0] + second[:, 1] - second[:, 0]
        for one in (first, second):
            way = one[:, 1] - one[:, 0]
            one[:, 1] = one[:, 0] + length * way / np.linalg.norm(way, axis=1, keepdims=True)
        right = np.array([
            segment_segment(tuple(a[0]), tuple(a[1] - a[0]), tuple(b[0]), tuple(b[1] - b[0]))[0]
            for a, b in zip(first, second, strict=True)
        ])  # fmt: skip
        ends, standing = np.stack([_block(first), _block(second)]), _block(second).reshape(6, LANES)
        near = int(rng.integers(1, ALL))
        for change, unsure, contact in ((1e-9, near, 0), (-1e-9, 0, 0), (0.0, near, near)):
            travel = np.zeros((2, 2, LANES))
            apart = 1e-12
            travel[0, 0] = right + change - apart
            queue, owner = np.full((2, 13, LANES), np.nan), np.zeros((2, LANES), dtype=np.int64)
            found = 0
            for k in range(LANES):
                if not near >> k & 1:
                    continue
                if contact:
                    apart, travel[0, 0, k] = right[k] + 1e-9, 0.0
                start = (queue, owner, 0, 1 << k, ends, 0)
                if stands:
                    point = np.ascontiguousarray(standing[:, k])[np.newaxis]
                    count = queue_standing(*start, point, 0, *squares, apart, travel)
                else:
                    count = queue_capsules(*start, 1, *squares, apart, travel, 0, 1)
                found |= queue_verdict(queue, owner, count) & ((1 << 2 * LANES) - 1)
            assert found & ALL == unsure
            assert found >> LANES == contact


def test_box_and_plane_tell_contact_of_a_lane_from_its_own_way():
    core = np.tile(np.array([[0.0, 0.0, 0.5], [0.0, 0.0, 1.5]]), (LANES, 1, 1))
    core[3, :, 2] -= 0.1
    block, ways = _block(core), np.zeros(LANES)
    ways[5] = 0.2
    plane, pose, half = np.array([0.0, 0.0, 1.0, 0.0]), np.eye(3, 4), np.full(3, 0.2)
    assert plane_verdict(block, plane, 0.45, ways) == 1 << 3 | 1 << 5 | 1 << (LANES + 3)
    assert box_verdict(block, pose, half, 0.5, 0.25, ways) == 1 << 3 | 1 << 5 | 1 << (LANES + 3)
