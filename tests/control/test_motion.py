"""Quantities that judge a motion, from samples whose values are known by hand."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualarm_repro.control.motion import FOLLOWED, JointLimits, Motion
from dualarm_repro.errors import InputError

LIMITS = JointLimits(np.array([-1.0, -2.0]), np.array([1.0, 0.5]), np.array([4.0, 5.0]))


@pytest.fixture(scope="module")
def motion():
    x = np.array([[1.0, -2.0], [3.0, 0.0], [-1.0, 2.0]])
    q = np.vstack([np.zeros(2), np.cumsum(0.1 * x, axis=0)])
    error = np.array([[0.0, 1e-4], [2e-4, 0.0], [9e-4, 0.0], [0.0, 0.0]])
    distance = np.array([0.3, 0.2, 0.25, 0.4])
    return Motion(0.1, 0.1 * np.arange(4), q, x, error, distance, *np.zeros((2, 3)), LIMITS)


def test_each_measure_by_hand(motion):
    assert motion.peak_speed == 3.0
    assert motion.mean_speed == pytest.approx(9.0 / 6.0)
    assert motion.energy == pytest.approx(0.5 * 0.1 * (1 + 4 + 9 + 1 + 4))
    # Changes 2, 2 and -4, 2 over 0.1 s.
    assert motion.peak_acceleration == pytest.approx(40.0)
    assert motion.rms_acceleration == pytest.approx(np.sqrt((4 + 4 + 16 + 4) / 4) / 0.1)
    assert motion.smallest_distance == 0.2
    assert motion.largest_error == 9e-4
    # q runs through (0, 0), (.1, -.2), (.4, -.2), (.3, 0): the second joint is nearest its end.
    assert motion.angle_excess == pytest.approx(-0.5)
    assert motion.speed_excess == pytest.approx(-1.0)
    assert motion.broken == ()


@pytest.mark.parametrize("excess", [-1e-6, 1e-6])
def test_a_bound_is_broken_beyond_rounding_alone(motion, excess):
    beyond = excess > 0
    at_the_end = np.array([[0.0, 0.5 + excess]])
    assert ("angle" in replace(motion, q=np.vstack([motion.q, at_the_end])).broken) is beyond
    below = np.array([[-1.0 - excess, 0.0]])
    assert ("angle" in replace(motion, q=np.vstack([motion.q, below])).broken) is beyond
    fast = np.array([[-4.0 - excess, 0.0]])
    assert ("speed" in replace(motion, x=np.vstack([motion.x, fast])).broken) is beyond
    assert (
        "path" in replace(motion, error=motion.error + FOLLOWED - 9e-4 + excess).broken
    ) is beyond
    assert ("contact" in replace(motion, distance=motion.distance - 0.2 - excess).broken) is beyond


def test_links_that_just_touch_are_in_contact(motion):
    assert replace(motion, distance=motion.distance - 0.2).broken == ("contact",)


def test_every_broken_bound_is_named_in_order(motion):
    wrong = replace(
        motion,
        q=motion.q + 9.0,
        x=motion.x + 9.0,
        distance=-motion.distance,
        error=motion.error + 1,
    )
    assert wrong.broken == ("angle", "speed", "contact", "path")


@settings(max_examples=20)
@given(factor=st.floats(0.1, 10.0))
def test_measures_scale_as_their_units_say(motion, factor):
    """The same path in ``factor`` times the time."""
    slow = replace(motion, dt=factor * motion.dt, x=motion.x / factor)
    assert slow.peak_speed == pytest.approx(motion.peak_speed / factor)
    assert slow.mean_speed == pytest.approx(motion.mean_speed / factor)
    assert slow.energy == pytest.approx(motion.energy / factor)
    assert slow.peak_acceleration == pytest.approx(motion.peak_acceleration / factor**2)
    assert slow.rms_acceleration == pytest.approx(motion.rms_acceleration / factor**2)


def test_a_run_that_stopped_at_once_has_measures_too(motion):
    none = replace(motion, q=motion.q[:1], x=motion.x[:0], stopped="at once")
    assert (none.peak_speed, none.mean_speed, none.energy) == (0.0, 0.0, 0.0)
    assert (none.peak_acceleration, none.rms_acceleration) == (0.0, 0.0)
    assert none.speed_excess == -np.inf
    assert not none.finished


def test_one_step_has_no_acceleration(motion):
    one = replace(motion, q=motion.q[:2], x=motion.x[:1])
    assert (one.peak_acceleration, one.rms_acceleration) == (0.0, 0.0)
    assert one.peak_speed == 2.0


def test_drift_is_taken_after_every_full_period(motion):
    np.testing.assert_allclose(motion.drift(0.1), [0.2, 0.4, 0.3])
    np.testing.assert_allclose(motion.drift(0.2), [0.4])
    np.testing.assert_allclose(motion.drift(0.29), [0.3])


@pytest.mark.parametrize("period", [0.04, 0.4, 7.0])
def test_a_period_outside_the_motion_is_refused(motion, period):
    with pytest.raises(
        InputError, match=r"Motion\.drift: period = .*from one step, 0\.1, to the 4"
    ):
        motion.drift(period)
    with pytest.raises(InputError, match="period = -1"):
        motion.drift(-1.0)
