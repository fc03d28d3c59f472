"""Exact link transforms, joint frames and axes, reach, and counted inverse kinematics."""

import numpy as np
import pinocchio as pin
import pytest
import sympy as sp

from dualarm_repro.arms import load_arm
from dualarm_repro.arms.counted_inverse import counting_inverse
from dualarm_repro.arms.dh import _rotation_x, _rotation_y, _rotation_z, joint_symbols
from dualarm_repro.arms.exact_chain import (
    chain_product,
    craig_parameters,
    craig_transform,
    evaluated,
    same_function,
)
from dualarm_repro.arms.joint_axes import (
    axis_spread,
    common_origins,
    joint_frames,
    joint_placements,
)
from dualarm_repro.arms.reach import largest_reach, symmetric_bases

ARM = load_arm("es165d")
Q = np.array([0.3, -0.4, 0.5, 0.6, -0.7, 0.8])


def test_parameters_are_those_a_link_was_made_of():
    theta = sp.Symbol("theta", real=True)
    link = craig_transform(-sp.pi / 2, sp.Rational("0.285"), theta, sp.Rational("1.025"))
    assert craig_parameters(link) == pytest.approx((0.285, 1.025, -np.pi / 2))
    turned = craig_transform(-sp.pi / 2, sp.Rational("0.285"), theta + 2 * sp.pi, 1.025)
    assert same_function(turned, link)
    assert not same_function(link.T, link)


def test_products_are_the_poses_of_the_arm():
    pose = chain_product(ARM.link_transforms())
    found = evaluated(pose, joint_symbols(6), Q[np.newaxis])[0]
    np.testing.assert_allclose(found, ARM.fk(Q), atol=1e-12)


def test_frames_are_the_products_of_placements():
    links = [joint_placements(ARM, k, Q[k - 1 : k])[0] for k in range(1, 7)]
    frames = joint_frames(ARM, Q)
    np.testing.assert_allclose(np.linalg.multi_dot(links), frames[-1], atol=1e-12)
    assert frames.shape == (6, 4, 4)


def test_axes_of_a_spherical_wrist_meet_and_others_do_not():
    poses = ARM.random_configurations(20, np.random.default_rng(0))
    assert axis_spread(ARM, (4, 5), 5, poses) < 1e-12
    assert axis_spread(ARM, (1, 4), 5, poses) > 0.1


def test_frames_with_one_origin_are_grouped():
    frames = np.tile(np.eye(4), (4, 1, 1))
    frames[1, 0, 3] = 1.0
    frames[3, 0, 3] = 1.0 + 1e-12
    assert common_origins(frames) == [(0, 2), (1, 3)]


def test_nothing_reaches_farther_than_the_reach():
    reach = largest_reach(ARM, np.random.default_rng(0), 2000)
    q = np.random.default_rng(1).uniform(-np.pi, np.pi, (5000, 6))
    distance = np.linalg.norm(ARM.positions(q), axis=1)
    assert reach - 0.2 < distance.max() <= reach


def test_bases_lie_on_either_side_of_the_plane():
    left, right = symmetric_bases(1.4)
    assert left.translation.tolist() == [0.0, 0.7, 0.0]
    assert right.translation.tolist() == [0.0, -0.7, 0.0]


def test_every_call_of_the_inverse_is_counted():
    arm, calls = counting_inverse(ARM)
    for _ in range(2):
        arm.ik_branches(ARM.fk(Q)[np.newaxis])
    assert len(calls) == 2
    ARM.ik_branches(ARM.fk(Q)[np.newaxis])
    assert len(calls) == 2


@pytest.mark.parametrize(
    ("turned", "axis"),
    [(_rotation_x, (1, 0, 0)), (_rotation_y, (0, 1, 0)), (_rotation_z, (0, 0, 1))],
)
def test_turns_about_an_axis(turned, axis):
    found = np.array(turned(sp.Rational(7, 10)).evalf(), dtype=float)
    np.testing.assert_allclose(found[:3, :3], pin.exp3(0.7 * np.array(axis)), atol=1e-15)
    np.testing.assert_array_equal(found[3], [0, 0, 0, 1])
    np.testing.assert_array_equal(found[:3, 3], 0)
