"""Lanes of the closed form against the same equations one pose after the other, in plain Python."""

import math

import numpy as np
import pytest
from numba import njit
from numpy.testing import assert_allclose, assert_array_equal

from dualarm_repro.arms import load_arm
from dualarm_repro.arms.kernels import Kinematics
from dualarm_repro.arms.wrist_geometry import wrist_geometry
from dualarm_repro.arms.wrist_ik import inverse_kinematics
from dualarm_repro.arms.wrist_lanes import ON_LIMIT, representative

from . import wrist_reference
from .test_wrist_ik import FREE, general_arm

RIGHT = (np.pi / 2, -np.pi / 2)
ARMS = {
    **{name: lambda name=name: load_arm(name).chain for name in ("irb120", "es165d-slave")},
    "perpendicular": lambda: general_arm(0.15, RIGHT, np.pi),
    "skew": lambda: general_arm(-0.1, (1.1, -0.9), 0.0),
}


def hard_configurations(rng):
    """Random ones, multiples of 45 degrees, aligned and nearly aligned wrists."""
    q = rng.uniform(-np.pi, np.pi, (160, 6))
    q[:40] = np.round(q[:40] * 4 / np.pi) * np.pi / 4
    q[40:60, 4] = rng.choice([0.0, np.pi], 20)
    q[60:80, 4] = rng.uniform(-1e-12, 1e-12, 20)
    return q


@pytest.mark.parametrize("name", ARMS)
@pytest.mark.parametrize("limited", [False, True])
def test_the_same_branches_in_the_same_order(name, limited, rng):
    chain = ARMS[name]()
    geometry, q = wrist_geometry(name, chain), hard_configurations(rng)
    T = Kinematics(chain).poses(q)
    T[-40:, :3, 3] *= rng.uniform(0.2, 2.0, (40, 1))  # some out of reach
    far = 6.0 if limited else np.inf
    for reference in (np.zeros(6), rng.uniform(-5, 5, 6)):
        lower, upper = reference - far * rng.uniform(0.3, 1, 6), reference + far * 0.4
        found = inverse_kinematics(geometry, T, reference, lower, upper)
        expected = wrist_reference.inverse_kinematics(geometry, T, reference, lower, upper)
        assert_array_equal(np.isnan(found), np.isnan(expected))
        whole = ~np.isnan(found).any(axis=2)
        assert whole.any()
        assert not whole.all()
        which = np.nonzero(whole)[0]
        assert_allclose(Kinematics(chain).poses(found[whole]), T[which], atol=1e-10)
        regular = np.abs(np.sin(wrist_angle(found, geometry))) > 1e-4
        assert_allclose(found[regular], expected[regular], rtol=0, atol=2e-12)


def wrist_angle(branches, geometry):
    """Angle about axis 5, counted from where axes 4, 5, 6 are closest to one plane."""
    return branches[..., 4] + math.atan2(*geometry.turn)


@pytest.mark.parametrize("count", range(6))
def test_any_number_of_poses_and_any_layout(count, rng):
    arm = load_arm("kr16-2")
    T = arm.fk(arm.random_configurations(12, rng))
    geometry = wrist_geometry("kr16-2", arm.chain)
    together = inverse_kinematics(geometry, T, np.zeros(6), -FREE, FREE)
    for some, expected in ((T[:count], together[:count]), (T[::2][:count], together[::2][:count])):
        found = inverse_kinematics(geometry, some, np.zeros(6), -FREE, FREE)
        assert found.shape == (count, 8, 6)
        assert_array_equal(found, expected)


@pytest.mark.parametrize("wrong", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("entry", [(0, 3), (1, 1), (2, 2)])
def test_a_pose_that_is_not_finite_has_no_branch_and_disturbs_no_other(wrong, entry, rng):
    arm = load_arm("er16")
    geometry = wrist_geometry("er16", arm.chain)
    T = arm.fk(arm.random_configurations(5, rng))
    expected = inverse_kinematics(geometry, T, np.zeros(6), -FREE, FREE)
    T[(2, *entry)] = wrong
    found = inverse_kinematics(geometry, T, np.zeros(6), -FREE, FREE)
    assert np.isnan(found[2]).all()
    kept = [0, 1, 3, 4]
    assert not np.isnan(expected[kept]).all(axis=(1, 2)).any()
    assert_array_equal(found[kept], expected[kept])


@njit
def representatives(angle, near, lower, upper):
    out = np.empty(len(angle))
    for k in range(len(angle)):
        out[k] = representative(angle[k], near[k], lower[k], upper[k])
    return out


TURN, INF = 2 * np.pi, np.inf


@pytest.mark.parametrize(
    ("angle", "near", "lower", "upper", "expected"),
    [
        (0.5, 0.0, -INF, INF, 0.5),
        (0.5, 20.0, -INF, INF, 0.5 + 3 * TURN),
        (0.5, -20.0, -INF, INF, 0.5 - 3 * TURN),
        (np.pi, 0.0, -INF, INF, np.pi),
        (-np.pi, 0.0, -INF, INF, np.pi),  # half a turn away: the upper side
        (-np.pi + 1e-12, 0.0, -INF, INF, np.pi + 1e-12),
        (0.5, 0.0, 1.0, 8.0, 0.5 + TURN),
        (0.5, 0.0, -20.0, -10.0, 0.5 - 2 * TURN),
        (0.5, 0.0, 0.6, 0.7, np.nan),
        (0.5, 0.0, 0.5 + 0.5 * ON_LIMIT, 0.7, 0.5 + 0.5 * ON_LIMIT),
        (0.5, 0.0, 0.0, 0.5 - 0.5 * ON_LIMIT, 0.5 - 0.5 * ON_LIMIT),
        (0.5, 0.0, 0.5 + 10 * ON_LIMIT, 0.7, np.nan),
        (0.5, 0.0, 0.0, 0.5 - 10 * ON_LIMIT, np.nan),
        (np.nan, 0.0, -INF, INF, np.nan),
        (np.nan, 0.0, -1.0, 1.0, np.nan),
    ],
)
def test_representative(angle, near, lower, upper, expected):
    given = (np.full(3, float(x)) for x in (angle, near, lower, upper))
    assert_allclose(representatives(*given), expected, rtol=0, atol=4e-15)
