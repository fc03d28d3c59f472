"""The distance of joint vectors is a metric on the circle of every joint that turns for ever."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualarm_repro.arms.joint_space import JointSpace
from dualarm_repro.arms.joint_type import JointType

KINDS = (JointType.CONTINUOUS, JointType.REVOLUTE, JointType.PRISMATIC)
SPACE = JointSpace("a", KINDS, np.array([-np.inf, -9.0, -9.0]), np.array([np.inf, 9.0, 9.0]))
VECTORS = st.lists(st.floats(-9.0, 9.0), min_size=3, max_size=3)


@settings(max_examples=50)
@given(a=VECTORS, b=VECTORS, c=VECTORS, turns=st.integers(-3, 3))
def test_symmetry_triangle_inequality_and_full_turns(a, b, c, turns):
    there = SPACE.distance(a, b)
    assert there == pytest.approx(SPACE.distance(b, a), abs=1e-12)
    assert SPACE.distance(a, c) <= there + SPACE.distance(b, c) + 1e-9
    assert there <= np.linalg.norm(np.subtract(b, a)) + 1e-12
    turned = [b[0] + 2 * np.pi * turns, *b[1:]]
    assert SPACE.distance(a, turned) == pytest.approx(there, abs=1e-9)
    assert SPACE.distance(a, a) == 0.0


@settings(max_examples=50)
@given(a=VECTORS, b=VECTORS)
def test_the_nearest_turn_is_the_same_posture_within_half_a_turn(a, b):
    near = SPACE.nearest(b, a)
    assert abs(near[0] - a[0]) <= np.pi + 1e-9
    assert np.sin(near[0]) == pytest.approx(np.sin(b[0]), abs=1e-12)
    assert np.cos(near[0]) == pytest.approx(np.cos(b[0]), abs=1e-12)
    assert near[1:].tolist() == b[1:]
    # Where half a turn either way is as short, either may be taken.
    if abs(abs(near[0] - a[0]) - np.pi) > 1e-9:
        np.testing.assert_allclose(a + SPACE.difference(a, b), near, atol=1e-9)


def test_rows_are_measured_one_by_one():
    starts, ends = np.zeros((2, 3)), np.array([[0.0, 3.0, 4.0], [2 * np.pi, 0.0, 0.0]])
    np.testing.assert_allclose(SPACE.distance(starts, ends), [5.0, 0.0], atol=1e-12)
    assert isinstance(SPACE.distance(starts[0], ends[0]), float)
    assert SPACE.within_limits([[0, 9.0, 0], [0, 9.1, 0]]).tolist() == [True, False]
    assert SPACE.within_limits([0, 9.1, 0], tolerance=0.11) is True
    assert SPACE.slides.tolist() == [False, False, True]
    assert SPACE.turns_for_ever.tolist() == [True, False, False]


def test_limits_may_be_left_aside():
    low, high = SPACE.limits(enforced=False)
    assert np.isneginf(low).all()
    assert np.isposinf(high).all()
    assert SPACE.limits()[1].tolist() == [np.inf, 9.0, 9.0]
