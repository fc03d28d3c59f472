"""Distances between axes, nearest points, and tips ahead of the flange, against the scene."""

import numpy as np
import pytest

from dualarm_repro import load_arm
from dualarm_repro.control.axis_distance import axis_distances, largest_thickness, nearest_points
from dualarm_repro.control.frozen import arm_pair
from dualarm_repro.control.settings import ControllerSettings
from dualarm_repro.control.simulate import simulate
from dualarm_repro.control.tip import with_tip
from dualarm_repro.errors import InputError
from dualarm_repro.scene import distances


def test_axes_are_as_far_apart_as_surfaces_and_radii_say(system, q):
    arrays = system.arrays
    surfaces = distances(system.scene, q) + arrays.radius[arrays.pairs].sum(axis=1)
    assert axis_distances(system, q[np.newaxis]) == pytest.approx(surfaces.min(), abs=1e-9)


def test_the_thickest_links_that_move(system):
    arrays = system.arrays
    base = arrays.radius[arrays.first == arrays.last].max()
    rest = np.sort(arrays.radius[arrays.first < arrays.last])[-1]
    assert largest_thickness(system) == pytest.approx(2 * rest)
    assert largest_thickness(system) < 2 * base


def test_nearest_points_are_the_smallest_distance_apart(crossing):
    settings = ControllerSettings(avoid=False)
    motion = simulate(*crossing.parts, settings, dt=0.02, slack=True)
    for k in (0, int(motion.distance.argmin())):
        a, b = nearest_points(crossing.system, motion.q[k])
        assert np.linalg.norm(b - a) == pytest.approx(abs(motion.distance[k]), abs=1e-9)
    assert motion.distance.min() < 0


def test_wide_ranges_between_axes_exclude_contact(crossing):
    thick = largest_thickness(crossing.system)
    settings = ControllerSettings(surface=False, inner=0.03 + thick, outer=0.1 + thick)
    motion = simulate(*crossing.parts, settings, dt=5e-3)
    assert axis_distances(crossing.system, motion.q).min() >= settings.inner - 5e-4
    assert motion.smallest_distance > 0.0


def test_a_tip_lies_ahead_of_the_flange():
    arm = load_arm("xarm7")
    longer, q = with_tip(arm, 0.1), np.full(7, 0.3)
    flange = arm.fk(q)
    np.testing.assert_allclose(longer.fk(q)[:3, 3], flange[:3, 3] + 0.1 * flange[:3, 2], atol=1e-12)
    np.testing.assert_allclose(longer.fk(q)[:3, :3], flange[:3, :3], atol=1e-12)
    pair = arm_pair(longer, 0.6)
    both = np.concatenate([q, q])
    moved = pair.tips(both) - arm_pair(arm, 0.6).tips(both)
    np.testing.assert_allclose(np.linalg.norm(moved, axis=1), 0.1, atol=1e-12)
    with pytest.raises(InputError, match="ahead"):
        with_tip(arm, -0.1)
