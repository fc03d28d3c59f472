"""Measures of `qiu` that do not depend on how a path is sampled or on a clock."""

import numpy as np
import pytest

from dualarm_repro.papers.qiu.improvements import RATIOS, nearest
from dualarm_repro.papers.qiu.operations import operations
from dualarm_repro.papers.qiu.smoothness import bending, until_rest
from dualarm_repro.planning.field.hull_obstacle import hull_track, point_hull
from dualarm_repro.scene.points import point_capsule
from dualarm_repro.scene.vectors import dot, minus


def _arc(count, radius=2.0):
    angle = np.linspace(0.0, 1.0, count)
    return radius * np.column_stack([np.cos(angle), np.sin(angle)])


def test_bending_of_an_arc_is_its_squared_curvature_however_it_is_sampled():
    found = [bending(_arc(count), 0.05) for count in (100, 400, 2000)]
    assert found == pytest.approx([0.25] * 3, rel=0.05)
    assert bending(np.linspace([0.0, 0.0], [1.0, 2.0], 30), 0.05) == pytest.approx(0.0, abs=1e-15)


def test_a_path_that_chatters_at_its_end_is_cut_there():
    way = np.linspace(0.0, 1.0, 21)[:, np.newaxis]
    path = np.vstack([way, 1.0 + 0.01 * (-1.0) ** np.arange(60)[:, np.newaxis]])
    assert 18 <= until_rest(path, 0.02) <= 21


def test_operations_are_counted_through_every_function_that_is_called():
    one, other = (1.0, 2.0, 3.0), (0.5, 0.0, 2.0)
    assert operations(dot, one, other) == 5
    assert operations(minus, one, other) == 3
    assert operations(point_capsule, one, other, (0.0, 0.0, 1.0), 0.1) > 5 + 3


def test_cost_of_a_hull_grows_with_its_faces_and_that_of_a_capsule_is_fixed():
    rng = np.random.default_rng(1)
    point = (3.0, 2.0, 1.0)
    costs = []
    for count in (8, 40):
        track = hull_track(rng.normal(size=(1, count, 3)))
        costs.append(operations(point_hull, point, track.planes[0], track.triangles[0]))
    assert costs[0] < costs[1]
    capsules = {operations(point_capsule, point, tuple(rng.normal(size=3)), (0.0, 0.0, 1.0), 0.1)
                for _ in range(3)}  # fmt: skip
    assert max(capsules) < costs[0]


def test_the_stored_ratio_is_the_nearest_by_its_factor():
    assert nearest(0.04) == 0.1
    assert nearest(0.02) == 0.01
    assert all(nearest(ratio) == ratio for ratio in RATIOS)
