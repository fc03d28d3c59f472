"""What the hull of an arm leaves out, what a query of it costs, and how smooth a path is."""

import numpy as np
import pytest
from two_spheres import GOAL, ONE_SIDED, START, obstacles, placed_arm, settings

from dualarm_repro.planning.checks.hull_cover import link_cores, protrusions
from dualarm_repro.planning.checks.query_cost import distinct_faces, query_operations, query_times
from dualarm_repro.planning.checks.smoothness import bending_of, moving_part
from dualarm_repro.planning.field.hull_obstacle import JointCircles, circles_on, hull_track
from dualarm_repro.planning.search.bidirectional_compiled import plan_bidirectional_compiled
from dualarm_repro.scene.posing import links_of

ARM = placed_arm()
Q = ARM.arm.random_configurations(4, np.random.default_rng(3))


def circles(radius):
    return JointCircles((1, 2, 3, 4, 5, 7), (radius,) * 6, 8)


def test_nothing_sticks_out_of_a_wide_hull_and_less_out_of_a_wider_one():
    thin, wide, huge = (protrusions(ARM, Q, circles(radius)) for radius in (0.03, 0.1, 1.5))
    assert thin.shape == link_cores(ARM, Q).shape[:2] == (4, len(links_of(ARM.arm).radius))
    assert thin.max() > wide.max()
    assert huge.max() == 0.0


def test_cost_of_a_query():
    track = hull_track(circles_on(ARM, circles(0.1), Q))
    planes, triangles = distinct_faces(track, 0)
    assert len(np.unique(triangles.reshape(-1, 9), axis=0)) == len(planes) == len(triangles)
    hull, capsules = query_operations(ARM, track, Q, np.random.default_rng(1))
    assert hull > 3 * len(planes)
    assert capsules > len(links_of(ARM.arm).radius)
    assert min(query_times(ARM, track, (0.2, 0.1, 0.9), 100).values()) > 0.0


def test_the_moving_part_of_a_failed_search_ends_where_it_rests():
    ends = ARM, START, GOAL, obstacles()
    free = plan_bidirectional_compiled(*ends, settings())
    assert moving_part(free) is free.path
    chosen = settings(**ONE_SIDED, repulsion={"gain": 1000.0})
    trapped = plan_bidirectional_compiled(*ends, chosen)
    assert not trapped.reached
    assert len(moving_part(trapped)) < len(trapped.path)


def test_a_straight_path_does_not_bend():
    plan = plan_bidirectional_compiled(ARM, START, GOAL, obstacles(), settings())
    spacing = {"joints": 0.05, "tip": 0.03}
    straight = bending_of(plan, lambda path: np.linspace(path[0], path[-1], len(path)), spacing)
    found = bending_of(plan, lambda path: path, spacing)
    assert straight["joints"] == pytest.approx(0.0, abs=1e-12)
    assert found["joints"] > 1e-3
