"""The direction away from a shape jumps where two parts are equally near, and only there."""

import numpy as np
import pytest

from dualarm_repro.planning.checks.creases import largest_turn, to_capsules, to_hull
from dualarm_repro.planning.field.hull_obstacle import hull_track

#: Two upright capsules side by side, and a line that passes between them.
CORES = np.array([[[-0.2, 0, 0], [-0.2, 0, 1]], [[0.2, 0, 0], [0.2, 0, 1]]], dtype=float)
RADII = np.array([0.05, 0.05])
LINE = np.column_stack([np.linspace(-0.1, 0.1, 101), np.full(101, 0.2), np.full(101, 0.5)])


def test_between_two_capsules_the_direction_jumps_by_the_angle_to_their_axes():
    jump = 2 * np.arctan2(0.2, 0.2)
    # the samples next to the crease lie half a step beside it
    assert largest_turn(to_capsules(CORES, RADII), LINE, 0.02) == pytest.approx(jump, abs=0.01)


def test_around_one_capsule_it_does_not():
    assert largest_turn(to_capsules(CORES[:1], RADII[:1]), LINE, 0.02) < 0.02


def test_around_their_hull_it_does_not():
    corners = CORES.reshape(1, -1, 3) + np.zeros((1, 4, 3))
    deep = np.concatenate([corners, corners - np.array([0.0, 0.1, 0.0])], axis=1)
    track = hull_track(deep)
    distance = to_hull(track.planes[0], track.triangles[0])
    assert largest_turn(distance, LINE, 0.02) < 0.02


def test_what_is_too_near_does_not_count():
    assert largest_turn(to_capsules(CORES, RADII), LINE, 1.0) == 0.0
