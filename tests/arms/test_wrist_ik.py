"""Closed-form inverse kinematics: every branch, limits, singular and unreachable poses."""

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given
from hypothesis import strategies as st
from long_tests import long_where
from numpy.testing import assert_allclose

from dualarm_repro.arms import load_arm
from dualarm_repro.arms.chain import Chain
from dualarm_repro.arms.kernels import Kinematics
from dualarm_repro.arms.wrist_geometry import wrist_geometry
from dualarm_repro.arms.wrist_ik import inverse_kinematics
from dualarm_repro.errors import ConfigurationError, InputError, UnsupportedArmError

SPHERICAL = ["es165d", "es165d-public", "es165d-slave", "irb120", "er16", "kr16-2", "irb2400"]
FREE = np.full(6, np.inf)


def angle_between(a, b):
    """Largest difference of two configurations up to full turns [rad]."""
    return np.abs(np.angle(np.exp(1j * (a - b)))).max(axis=-1)


@pytest.mark.parametrize("name", SPHERICAL)
def test_every_branch_reproduces_the_pose_and_one_is_the_generating_configuration(name, rng):
    arm = load_arm(name)
    q = arm.random_configurations(2000, rng)
    q = q[arm.manipulability(q) > 1e-4]
    T = arm.fk(q)
    branches = arm.ik_branches(T)
    found = ~np.isnan(branches).any(axis=2)
    assert_allclose(arm.fk(branches[found]), T[np.nonzero(found)[0]], atol=1e-10)
    assert arm.within_limits(branches[found]).all()
    away = angle_between(branches, q[:, np.newaxis])
    assert np.nanmin(away, axis=1).max() < 1e-7
    for pose, row in zip(T[:50], branches, strict=False):
        assert_allclose(arm.ik(pose), row[~np.isnan(row).any(axis=1)], atol=0)


@pytest.mark.parametrize("name", SPHERICAL)
def test_eight_distinct_branches_before_the_limits(name, rng):
    """The irb120 has no shoulder offset, so both shoulders reach; else the pose is chosen close."""
    arm = load_arm(name)
    geometry = wrist_geometry(name, arm.chain)
    near = max(geometry.upper_arm[0], geometry.forearm[0])
    q = arm.random_configurations(400, rng)
    wrist = arm.joint_positions(q)[:, 4]
    column = arm.joint_positions(np.zeros(6))[1] * (0, 0, 1)
    close = q[np.linalg.norm(wrist - column, axis=1) < near]
    assert len(close) > 20
    for pose in arm.fk(close[:20]):
        branches = arm.ik(pose, within_limits=False)
        assert len(branches) == 8
        for k, branch in enumerate(branches):
            assert angle_between(np.delete(branches, k, axis=0), branch).min() > 1e-3


@given(st.lists(st.floats(-2.5, 2.5), min_size=6, max_size=6))
def test_any_configuration_is_found_again(q):
    arm = load_arm("er16")
    pose = arm.fk(q)
    branches = arm.ik(pose, reference=q, within_limits=False)
    assert_allclose(arm.fk(branches), np.broadcast_to(pose, (len(branches), 4, 4)), atol=1e-9)
    if arm.manipulability(q) > 1e-3:
        assert angle_between(branches, np.array(q)).min() < 1e-7


def test_branch_numbers_are_continuous_along_a_path():
    arm = load_arm("er16")
    turn = np.linspace(0, 1, 400)[:, np.newaxis]
    q = np.array([0.4, 0.3, 0.1, -0.8, 0.9, 0.5]) + turn * [0.6, 0.2, -0.3, 0.5, 0.3, -0.7]
    branches = arm.ik_branches(arm.fk(q), reference=q[0])
    followed = [b for b in range(8) if angle_between(branches[:, b], q).max() < 1e-9]
    assert len(followed) == 1
    assert np.abs(np.diff(branches[:, followed[0]], axis=0)).max() < 0.01


def general_arm(lateral, wrist_angles, elbow_turn):
    """Lateral offset, an elbow axis that may point backwards, and a wrist with skew axes."""
    alphas = [0.0, -np.pi / 2, elbow_turn, -np.pi / 2, *wrist_angles]
    a = [0.0, 0.2, 0.7, 0.1, 0.0, 0.0]
    d = [0.5, lateral, 0.0, 0.6, 0.0, 0.15]
    rotation = [pin.utils.rotate("x", alpha) for alpha in alphas] + [
        pin.rpy.rpyToMatrix(0.3, -0.2, 0.5)
    ]
    translation = [
        R @ np.array([0.0, 0.0, d_i]) + np.array([a_i, 0.0, 0.0])
        for R, a_i, d_i in zip(rotation, a, d, strict=False)
    ]
    return Chain(np.array(rotation), np.array([*translation, np.array([0.05, -0.03, 0.1])]))


@pytest.mark.parametrize("lateral", [0.0, 0.15, -0.1])
@pytest.mark.parametrize("wrist", [(np.pi / 2, -np.pi / 2), (1.1, -0.9), (-2.0, 1.3)])
@pytest.mark.parametrize("elbow", long_where(bool, [0.0, np.pi]))
def test_offset_shoulder_and_skew_wrist(lateral, wrist, elbow, rng):
    chain = general_arm(lateral, wrist, elbow)
    q = rng.uniform(-np.pi, np.pi, (400, 6))
    T = Kinematics(chain).poses(q)
    branches = inverse_kinematics(wrist_geometry("general", chain), T, np.zeros(6), -FREE, FREE)
    found = ~np.isnan(branches).any(axis=2)
    assert_allclose(Kinematics(chain).poses(branches[found]), T[np.nonzero(found)[0]], atol=1e-9)
    away = np.nanmin(angle_between(branches, q[:, np.newaxis]), axis=1)
    assert np.quantile(away, 0.98) < 1e-9
    assert away.max() < 1e-5


@pytest.mark.parametrize("q4", [-0.7, 0.0, 1.2])
def test_singular_wrist_takes_the_reference(q4, rng):
    arm = load_arm("irb120")
    for q in arm.random_configurations(100, rng):
        q[4] = 0.0
        branches = arm.ik(arm.fk(q), reference=[0, 0, 0, q4, 0, 0], within_limits=False)
        assert_allclose(
            arm.fk(branches), np.broadcast_to(arm.fk(q), (len(branches), 4, 4)), atol=1e-10
        )
        assert len(branches) == 7, "both wrist branches of this arm posture are one"
        aligned = branches[np.abs(branches[:, 4]) < 1e-9]
        assert_allclose(aligned[:, 3], q4, atol=1e-12)
        assert angle_between(aligned[:, :3], q[:3]).min() < 1e-7


def test_no_detour_by_the_sign_of_a_zero():
    """Rounding of a pose must not move an angle of half a turn to the other end of its range."""
    arm = load_arm("kr16-2")
    exact = arm.fk([0.0, -1.2, 1.3, 0.0, 0.5, 0.0])
    reference = arm.ik(exact, within_limits=False)
    assert (np.abs(reference - np.pi) < 1e-9).any(), "some branches turn a joint by half a turn"
    for noise in (1e-17, -1e-17, 1e-15, -1e-15):
        for row, column in ((1, 0), (1, 1), (1, 2), (1, 3), (0, 1), (2, 1)):
            pose = exact.copy()
            pose[row, column] += noise
            assert_allclose(arm.ik(pose, within_limits=False), reference, atol=1e-9)


def test_wrist_centre_on_axis_1_takes_the_reference():
    arm = load_arm("irb120")
    upright = arm.fk([0.0, 0.0, -np.arctan2(0.302, 0.07), 0.0, 0.3, 0.0])
    assert wrist_centre(arm, upright)[0] == pytest.approx(0.0, abs=1e-12)
    branches = arm.ik(upright, reference=[0.8, 0, 0, 0, 0, 0], within_limits=False)
    assert_allclose(branches[:, 0], 0.8, atol=1e-9)
    assert_allclose(arm.fk(branches), np.broadcast_to(upright, (len(branches), 4, 4)), atol=1e-10)


def wrist_centre(arm, pose):
    return pose[:3, 3] - 0.072 * pose[:3, 2]


def test_stretched_arm_and_out_of_reach():
    """Wrist at the full length of upper arm and forearm; a millimetre further there is nothing."""
    arm = load_arm("irb120")
    straight = np.array([0.3, 0.5, -np.arctan2(0.302, 0.07), 0.4, 0.6, 0.2])
    pose = arm.fk(straight)
    branches = arm.ik(pose, within_limits=False)
    assert_allclose(arm.fk(branches), np.broadcast_to(pose, (len(branches), 4, 4)), atol=1e-10)
    assert len(branches) == 4, "both elbows of a stretched arm are one"
    assert angle_between(branches, straight).min() < 1e-6
    shoulder = arm.joint_positions(straight)[1]
    outward = wrist_centre(arm, pose) - shoulder
    pose[:3, 3] += 1e-3 * outward / np.linalg.norm(outward)
    assert arm.ik(pose).shape == (0, 6)
    assert np.isnan(arm.ik_branches(pose[np.newaxis])).all()


def test_lateral_offset_leaves_a_hole_about_axis_1():
    chain = general_arm(0.15, (np.pi / 2, -np.pi / 2), 0.0)
    geometry = wrist_geometry("general", chain)
    pose = np.eye(4)
    across, _, upwards = np.array(geometry.base)
    pose[:3, 3] = 0.1 * across + 0.8 * upwards + geometry.origin + geometry.flange[2]
    assert np.isnan(inverse_kinematics(geometry, pose[np.newaxis], np.zeros(6), -FREE, FREE)).all()
    pose[:3, 3] += 0.1 * across
    assert not np.isnan(
        inverse_kinematics(geometry, pose[np.newaxis], np.zeros(6), -FREE, FREE)
    ).all()


def test_representative_nearest_to_the_reference():
    arm = load_arm("kr16-2")
    pose = arm.fk([2.9, -1.2, 1.3, 2.0, 0.7, -1.0])
    for reference in (np.zeros(6), np.array([0, 0, 0, 6.0, 0, -6.0])):
        for q in arm.ik(pose, reference=reference):
            for j in range(6):
                others = q[j] + 2 * np.pi * np.array([-2, -1, 1, 2])
                fits = others[(others >= arm.lower[j]) & (others <= arm.upper[j])]
                assert (np.abs(fits - reference[j]) >= abs(q[j] - reference[j]) - 1e-9).all()


def test_limits_themselves_are_within():
    arm = load_arm("er16")
    q = np.where(np.arange(6) % 2, arm.upper, arm.lower) * [1, 0.5, 0.5, 1, 1, 1]
    branches = arm.ik(arm.fk(q))
    assert angle_between(branches, q).min() < 1e-7
    assert arm.within_limits(branches).all()


@pytest.mark.parametrize(
    ("name", "lacks"),
    [("panda", "six joints"), ("xarm7", "six joints"), ("ur5", "one point")],
)
def test_other_arms_are_refused(name, lacks):
    with pytest.raises(UnsupportedArmError, match=lacks):
        load_arm(name).ik(np.eye(4))


@pytest.mark.parametrize(
    ("T", "field"),
    [
        (np.eye(3), "shape of T"),
        (np.full((4, 4), np.nan), "T"),
        (2 * np.eye(4), "T"),
        (np.diag([1.0, 1.0, -1.0, 1.0]), "T"),
        (np.eye(4) + np.eye(4)[[3, 0, 1, 2]].T * 0.1, "T"),
        ("pose", "T"),
    ],
)
def test_what_is_no_pose(T, field):
    with pytest.raises(InputError, match="irb120") as caught:
        load_arm("irb120").ik(T)
    assert caught.value.field == field
    with pytest.raises(ConfigurationError):
        load_arm("irb120").ik(np.eye(4), reference=[0.0] * 5)
