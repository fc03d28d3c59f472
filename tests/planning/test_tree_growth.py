"""Trees of RRT-Connect and shortcuts, on hand-made trees and in a scene without obstacles."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualarm_repro.arms import load_arm
from dualarm_repro.planning.search.tree_kernels import (
    MET,
    MORE,
    SPENT,
    Trees,
    _along,
    _point,
    _replaced,
    grow,
    joined,
    search,
    shortened,
)
from dualarm_repro.scene import PlacedArm, Scene
from dualarm_repro.scene.edge_kernels import edge_buffers
from dualarm_repro.scene.edge_model import edge_model


def trees_of(start, goal, room=64):
    nodes, parent = np.zeros((2, room, len(start))), np.full((2, room), -1)
    nodes[0, 0], nodes[1, 0] = start, goal
    return Trees(nodes, parent, np.array([1, 1, 0, 0]))


@pytest.fixture(scope="module")
def model():
    """An arm alone: every configuration within reach of its joints is free."""
    return edge_model(Scene([PlacedArm("arm", load_arm("irb120"))]))


START, GOAL = np.zeros(6), np.array([0.6, 0.4, -0.3, 0.2, 0.5, 0.1])


def test_the_way_from_start_to_goal_runs_up_one_tree_and_down_the_other():
    trees = trees_of([0.0], [9.0])
    for side, node, place, parent in (
        (0, 1, 1.0, 0), (0, 2, -1.0, 0), (0, 3, 2.0, 1),
        (1, 1, 8.0, 0), (1, 2, 2.0, 1),
    ):  # fmt: skip
        trees.nodes[side, node], trees.parent[side, node] = place, parent
    assert joined(trees, 3, 2)[:, 0].tolist() == [0.0, 1.0, 2.0, 8.0, 9.0]
    trees.nodes[1, 0] = 2.0
    assert joined(trees, 3, 0)[:, 0].tolist() == [0.0, 1.0, 2.0]


def test_points_of_a_path_by_their_way():
    rows, out = np.array([[0.0, 0.0], [3.0, 0.0], [3.0, 4.0]]), np.empty(2)
    for way, row, place in (
        (0.0, 0, [0, 0]), (1.5, 0, [1.5, 0]), (3.0, 0, [3, 0]),
        (5.0, 1, [3, 2]), (7.0, 1, [3, 4]), (9.0, 1, [3, 4]),
    ):  # fmt: skip
        assert _point(rows, 3, way, out) == row
        assert out.tolist() == pytest.approx(place)
    assert _along(rows, 0, 1, np.array([[1.0, 0.0], [3.0, 1.0]])) == pytest.approx(3.0)


@pytest.mark.parametrize(
    ("first", "last", "expected"),
    [
        (0, 1, [0, 90, 91, 2, 3]),
        (0, 2, [0, 90, 91, 3]),
        (1, 2, [0, 1, 90, 91, 3]),
        (0, 0, [0, 90, 91, 1, 2, 3]),
    ],
)
def test_a_shortcut_takes_the_place_of_the_rows_between(first, last, expected):
    rows = np.zeros((8, 1))
    rows[:4, 0] = range(4)
    size = _replaced(rows, 4, first, last, np.array([[90.0], [91.0]]))
    assert rows[:size, 0].tolist() == expected


def test_where_nothing_is_in_the_way_the_straight_line_is_the_answer(model):
    trees = trees_of(START, GOAL)
    outcome, path = search(
        model, trees, np.zeros((0, 6)), np.zeros((0, 2)), 0.1, 0.0, np.array([500, 500]), 5
    )
    assert outcome == MET
    np.testing.assert_array_equal(path, [START, GOAL])


@pytest.mark.parametrize("seed", range(3))
def test_trees_grow_by_steps_no_longer_than_asked_and_meet(model, seed):
    trees = trees_of(START, GOAL)
    samples = np.random.default_rng(seed).uniform(-0.5, 0.8, (20, 6))
    outcome, a, b = grow(model, trees, samples, 0.25, 0.0, 5000, edge_buffers(model))
    assert outcome == MET
    np.testing.assert_array_equal(trees.nodes[0, a], trees.nodes[1, b])
    for side in range(2):
        for node in range(1, trees.counts[side]):
            parent = trees.parent[side, node]
            assert 0 <= parent < node
            way = np.linalg.norm(trees.nodes[side, node] - trees.nodes[side, parent])
            assert way <= 0.25 + 1e-12
    path = joined(trees, a, b)
    np.testing.assert_array_equal(path[[0, -1]], [START, GOAL])


def test_samples_or_the_budget_run_out(model):
    buffers = edge_buffers(model)
    far = np.full((1, 6), 0.1)
    assert grow(model, trees_of(START, GOAL), far[:0], 0.1, 0.0, 500, buffers)[0] == MORE
    spent = trees_of(START, GOAL)
    spent.counts[3] = 500
    assert grow(model, spent, far, 0.1, 0.0, 500, buffers)[0] == SPENT
    full = trees_of(START, GOAL, room=2)
    full.counts[0] = 1
    assert grow(model, full, far, 0.1, 0.0, 500, buffers)[0] == SPENT


def length(path):
    return float(np.linalg.norm(np.diff(path, axis=0), axis=1).sum())


@settings(max_examples=15)
@given(seed=st.integers(0, 10**6))
def test_shortcuts_keep_the_ends_and_in_free_space_leave_the_straight_line(model, seed):
    rng = np.random.default_rng(seed)
    path = np.cumsum(rng.uniform(-0.1, 0.1, (8, 6)), axis=0)
    count = np.array([0, 0, 0, 0])
    found = shortened(model, path, rng.random((10, 2)), 0.0, 5000, 10, count, edge_buffers(model))
    np.testing.assert_array_equal(found, path[[0, -1]])
    assert count[3] > 0
    spent = np.array([0, 0, 0, 5000])
    kept = shortened(model, path, rng.random((10, 2)), 0.0, 5000, 10, spent, edge_buffers(model))
    np.testing.assert_array_equal(kept, path)
    assert length(found) <= length(kept)
