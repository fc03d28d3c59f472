"""Laws of approach and joint bounds, by values worked out by hand and by what holds for all."""

from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualarm_repro.control.damper import approach_bound, joint_bounds
from dualarm_repro.control.settings import ControllerSettings, Damper
from dualarm_repro.settings import code


@pytest.mark.parametrize(
    ("law", "d", "beta"),
    [
        (Damper.LINEAR, 0.05, 0.06),
        (Damper.LINEAR, 0.02, -0.03),
        # Half way between the ranges sin^2(pi/4) = 1/2 of v = 3 * 0.06.
        (Damper.SINE_SQUARED, 0.06, 0.09),
        (Damper.SINE_SQUARED, 0.05, 0.18 * 0.25),
        (Damper.SINE_SQUARED, 0.02, 0.0),
        (Damper.SINE_SQUARED, 0.2, 0.18),
        (Damper.STEP, 0.03, 0.18),
        (Damper.STEP, 0.0299, -0.18),
        (Damper.ZERO_INSIDE, 0.08, 0.0),
    ],
)
def test_each_law_has_the_value_of_its_formula(law, d, beta):
    assert approach_bound(code(law), d, 3.0, 0.09, 0.03) == pytest.approx(beta, abs=1e-15)


def test_a_linear_damper_never_lets_a_distance_reach_the_inner_range():
    """dd/dt = -beta(d) from the outer range: d - d2 falls with e^(-k t)."""
    d, dt = 0.09, 1e-3
    for _ in range(1000):
        d -= dt * approach_bound(code(Damper.LINEAR), d, 3.0, 0.09, 0.03)
    assert d - 0.03 == pytest.approx(0.06 * (1 - 3.0 * dt) ** 1000)
    assert d > 0.03


@pytest.mark.parametrize("law", [Damper.LINEAR, Damper.SINE_SQUARED, Damper.STEP])
@settings(max_examples=20)
@given(d=st.floats(-0.05, 0.15), scale=st.floats(0.1, 10.0))
def test_bounds_scale_with_the_gain_and_with_all_lengths(law, d, scale):
    plain = approach_bound(code(law), d, 3.0, 0.09, 0.03)
    assert approach_bound(code(law), d, 3.0 * scale, 0.09, 0.03) == pytest.approx(scale * plain)
    if abs(d - 0.03) > 1e-9:  # scaled, the edge of the step falls to either side
        longer = approach_bound(code(law), scale * d, 3.0, scale * 0.09, scale * 0.03)
        assert longer == pytest.approx(scale * plain)


def bounds(q, **changed):
    """Bounds of joints in [-1, 2] with speeds up to 3."""
    n = len(q)
    arrays = SimpleNamespace(lower=np.full(n, -1.0), upper=np.full(n, 2.0), speed=np.full(n, 3.0))
    numbers = ControllerSettings(limit_gain=4.0, limit_margin=0.1, **changed).numbers()
    lower, upper = np.empty(n), np.empty(n)
    joint_bounds.py_func(arrays, numbers, np.asarray(q, dtype=float), lower, upper)
    return lower, upper


def test_joint_bounds_by_hand():
    lower, upper = bounds([0.5, 1.8, 1.9, 2.5, -0.8, -3.0])
    np.testing.assert_allclose(upper, [3.0, 0.4, 0.0, -2.4, 3.0, 3.0], atol=1e-12)
    np.testing.assert_allclose(lower, [-3.0, -3.0, -3.0, -3.0, -0.4, 3.0], atol=1e-12)


@settings(max_examples=50)
@given(q=st.lists(st.floats(-5.0, 5.0), min_size=2, max_size=2).map(sorted))
def test_bounds_never_cross_nor_exceed_the_speed_and_fall_with_the_angle(q):
    lower, upper = bounds(q)
    assert (lower <= upper).all()
    assert (np.abs([lower, upper]) <= 3.0).all()
    assert lower[0] >= lower[1]
    assert upper[0] >= upper[1]


def test_limits_are_left_out_as_asked():
    lower, upper = bounds([2.5], angle_limits=False)
    assert (lower[0], upper[0]) == (-3.0, 3.0)
    lower, upper = bounds([2.5], limits=False)
    assert (lower[0], upper[0]) == (-np.inf, np.inf)
