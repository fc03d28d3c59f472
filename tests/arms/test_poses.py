"""Poses and configurations from outside: what is taken, and the one line of what is not."""

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualarm_repro.arms.poses import ORTHONORMAL, check_configurations, check_poses, homogeneous
from dualarm_repro.errors import ConfigurationError, InputError


def pose(seed=0):
    rng = np.random.default_rng(seed)
    return homogeneous(pin.exp3(rng.normal(size=3)), rng.normal(size=3))


def test_rotations_and_translations_broadcast():
    R = np.array([pin.exp3(v) for v in np.eye(3)])
    made = homogeneous(R, [1.0, 2.0, 3.0])
    assert made.shape == (3, 4, 4)
    np.testing.assert_array_equal(made[:, :3, :3], R)
    np.testing.assert_array_equal(made[:, :3, 3], [[1, 2, 3]] * 3)
    np.testing.assert_array_equal(made[:, 3], [[0, 0, 0, 1]] * 3)
    grid = homogeneous(np.broadcast_to(np.eye(3), (2, 5, 3, 3)), np.zeros((2, 1, 3)))
    assert grid.shape == (2, 5, 4, 4)


@settings(max_examples=30)
@given(seed=st.integers(0, 10**6))
def test_every_rigid_motion_is_taken_and_comes_back_contiguous(seed):
    T = pose(seed)
    np.testing.assert_array_equal(check_poses("here", T.tolist(), 2), T)
    stack = np.asfortranarray(np.array([T, np.linalg.inv(T)]))
    found = check_poses("here", stack, 3)
    assert found.flags.c_contiguous
    np.testing.assert_array_equal(found, stack)


def test_no_pose_at_all_is_a_batch_of_none():
    assert check_poses("here", np.empty((0, 4, 4)), 3).shape == (0, 4, 4)


def wrong(change):
    T = pose(3)
    change(T)
    return T


@pytest.mark.parametrize(
    "change",
    [
        lambda T: T.__setitem__((slice(3), 0), -T[:3, 0]),  # left-handed
        lambda T: T.__setitem__((0, slice(3)), 1.001 * T[0, :3]),
        lambda T: T.__setitem__((slice(3), slice(3)), 0.0),
        lambda T: T.__setitem__((2, 1), T[2, 1] + 1e-4),
        lambda T: T.__setitem__((1, 3), np.nan),
        lambda T: T.__setitem__((0, 0), np.inf),
        lambda T: T.__setitem__((3, 0), 1e-9),
        lambda T: T.__setitem__((3, 3), 2.0),
    ],
)
def test_what_is_no_rigid_motion_is_refused_alone_and_among_others(change):
    T = wrong(change)
    for given_poses, ndim in ((T, 2), ([pose(), T], 3)):
        with pytest.raises(InputError, match=r"here: T = .*right-handed rotation") as caught:
            check_poses("here", given_poses, ndim)
        assert "\n" not in str(caught.value)


@pytest.mark.parametrize(("share", "taken"), [(0.4, True), (1.5, False)])
def test_rounding_of_single_precision_is_no_error_and_more_is(share, taken):
    T = np.eye(4)
    T[0, 1] = share * ORTHONORMAL
    if taken:
        assert check_poses("here", T, 2)[0, 1] == T[0, 1]
    else:
        with pytest.raises(InputError, match="rotation"):
            check_poses("here", T, 2)


@pytest.mark.parametrize(
    ("T", "ndim", "line"),
    [
        (np.eye(3), 2, r"here: shape of T = \(3, 3\): expected \(4, 4\) finite"),
        (np.eye(4), 3, r"here: shape of T = \(4, 4\): expected \(N, 4, 4\) finite"),
        (np.zeros((2, 4, 4)), 2, "here: shape of T"),
        ("pose", 2, r"here: T = 'pose': expected \(4, 4\) finite"),
        (1j * np.eye(4), 2, "here: T = "),
    ],
)
def test_other_shapes_are_named(T, ndim, line):
    with pytest.raises(InputError, match=line):
        check_poses("here", T, ndim)


@pytest.mark.parametrize(
    ("q", "line"),
    [
        (np.zeros(3), r"shape of q = \(3,\): expected two"),
        (np.zeros((1, 1, 2)), r"shape of q = \(1, 1, 2\)"),
        ([[0, 1], [0, np.nan]], "q = nan: expected two"),
        ([0, -np.inf], "q = -inf: expected two"),
        ([0, "a"], "q = "),
        (None, "q"),
    ],
)
def test_wrong_configurations_are_named(q, line):
    with pytest.raises(ConfigurationError, match=line):
        check_configurations("arm a", q, 2, "two")


def test_configurations_become_floats():
    assert check_configurations("arm a", [1, 2], 2, "two").dtype == np.float64
    assert check_configurations("arm a", np.zeros((0, 2), int), 2, "two").shape == (0, 2)
