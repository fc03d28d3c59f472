"""Goals given as points: reached ones, and one beyond the reach of the arm."""

import numpy as np
import pytest
from two_spheres import GOAL, START, placed_arm

from dualarm_repro.arms import load_arm
from dualarm_repro.errors import ConfigurationError, InputError
from dualarm_repro.planning.field.control_points import end_effector
from dualarm_repro.planning.tasks.tip_goal import nearest_posture, tip_posture
from dualarm_repro.scene import PlacedArm

BEYOND = [-0.1, -0.2, 0.75]


def test_reachable_points_are_reached_within_the_limits():
    placed = placed_arm()
    for q in placed.arm.random_configurations(5, np.random.default_rng(3)):
        point = end_effector(placed, q)
        posture = tip_posture(placed, point, START)
        assert posture.residual < 1e-6
        assert posture.tip == pytest.approx(point, abs=1e-6)
        assert placed.arm.within_limits(posture.q)


def test_out_of_reach_names_arm_point_and_shortfall():
    with pytest.raises(InputError, match=r"arm arm: goal = \[-0.1, -0.2, 0.75\].*0.0219 m"):
        tip_posture(placed_arm(), BEYOND, START)


def test_best_effort_stretches_towards_the_point():
    placed = placed_arm()
    posture = tip_posture(placed, BEYOND, GOAL, best_effort=True)
    shoulder = np.array([0.35, 0.0, 0.29])
    reach = 0.27 + np.hypot(0.302, 0.07) + 0.072
    assert np.linalg.norm(posture.tip - shoulder) == pytest.approx(reach, abs=1e-7)
    assert posture.residual == pytest.approx(np.linalg.norm(BEYOND - shoulder) - reach, abs=1e-9)


def test_joints_that_turn_for_ever_have_finite_postures():
    """Three of the joints of a Kinova have no limits."""
    placed = PlacedArm("arm", load_arm("kinova-j2s6s200"))
    assert placed.arm.turns_for_ever.sum() == 3
    q = np.array([9.0, 2.9, 1.3, -8.0, 1.4, 20.0])
    found = tip_posture(placed, end_effector(placed, q), q + 0.2)
    assert found.residual < 1e-6
    assert np.abs(placed.arm.difference(q, found.q)).max() < 0.5


def test_bad_input():
    with pytest.raises(InputError, match="three finite numbers"):
        nearest_posture(placed_arm(), [0, 0, np.nan], START)
    with pytest.raises(ConfigurationError):
        nearest_posture(placed_arm(), BEYOND, [0.0])
