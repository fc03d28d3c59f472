"""A timed spline: motions known by hand, derivatives by differences, extrema by dense sampling."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import CubicSpline

from dualarm_repro.planning.timing.timed_spline import TimedSpline


def straight(slope=2.0, length=1.0, square=(0.0, 4.0, 0.0)):
    """q = slope s on a grid of equal pieces."""
    knots = np.linspace(0.0, length, 5)
    spline = CubicSpline(knots, slope * knots[:, None])
    grid = np.linspace(0.0, length, len(square))
    if len(square) == 3:
        assert grid[1] in knots
    return TimedSpline(spline, grid, np.array(square, dtype=float))


def test_a_ramp_up_and_down_by_hand():
    """s' rises to 2 over half a metre: half a second at 4 /s^2, and down again."""
    motion = straight()
    assert motion.time.tolist() == pytest.approx([0.0, 0.5, 1.0])
    q, speed, acceleration = motion.at(np.array([0.0, 0.25, 0.5, 0.75, 1.0]))
    assert q[:, 0] == pytest.approx([0.0, 0.25, 1.0, 1.75, 2.0])
    assert speed[:, 0] == pytest.approx([0.0, 2.0, 4.0, 2.0, 0.0], abs=1e-7)
    assert acceleration[[0, 1, 3], 0] == pytest.approx([8.0, 8.0, -8.0])
    fast, sharp = motion.largest()
    assert (fast[0], sharp[0]) == pytest.approx((4.0, 8.0))
    assert motion.away_from_chords() == pytest.approx(0.0, abs=1e-12)


def test_a_constant_rate_has_no_acceleration():
    motion = straight(square=(9.0, 9.0, 9.0))
    assert motion.time[-1] == pytest.approx(1.0 / 3.0)
    _, speed, acceleration = motion.at(np.linspace(0.0, 1.0 / 3.0, 7))
    assert speed == pytest.approx(np.full((7, 1), 6.0))
    assert acceleration == pytest.approx(np.zeros((7, 1)), abs=1e-9)


@pytest.mark.parametrize("factor", [0.5, 3.0])
def test_the_same_motion_more_slowly(factor):
    motion = wavy(3)
    slow = motion.slowed(factor)
    assert slow.time == pytest.approx(factor * motion.time)
    for (plain, late), power in zip(
        zip(motion.largest(), slow.largest(), strict=True), (1, 2), strict=True
    ):
        assert late == pytest.approx(plain / factor**power)
    times = np.linspace(0.0, motion.time[-1], 9)
    np.testing.assert_allclose(slow.at(factor * times)[0], motion.at(times)[0], atol=1e-9)


def wavy(seed, joints=3, pieces=6):
    rng = np.random.default_rng(seed)
    knots = np.concatenate([[0.0], np.cumsum(rng.uniform(0.2, 1.0, 5))])
    spline = CubicSpline(knots, rng.normal(size=(6, joints)))
    share = np.arange(pieces) / pieces
    grid = np.append((knots[:-1, None] + np.outer(np.diff(knots), share)).ravel(), knots[-1])
    square = rng.uniform(0.05, 2.0, len(grid))
    square[[0, -1]] = 0.0
    return TimedSpline(spline, grid, square)


@settings(max_examples=20)
@given(seed=st.integers(0, 10**6))
def test_speeds_and_accelerations_are_the_derivatives_in_time(seed):
    motion, step = wavy(seed), 1e-6
    rng = np.random.default_rng(seed)
    piece = rng.integers(0, len(motion.grid) - 1, 12)
    share = rng.uniform(0.2, 0.8, 12)
    times = motion.time[piece] + share * np.diff(motion.time)[piece]
    _, speed, acceleration = motion.at(times)
    before, after = motion.at(times - step), motion.at(times + step)
    np.testing.assert_allclose((after[0] - before[0]) / (2 * step), speed, atol=1e-6)
    np.testing.assert_allclose((after[1] - before[1]) / (2 * step), acceleration, atol=1e-5)


@settings(max_examples=20)
@given(seed=st.integers(0, 10**6))
def test_the_extrema_are_those_of_a_dense_sample(seed):
    motion = wavy(seed)
    fast, sharp = motion.largest()
    times = np.concatenate([
        np.linspace(a + 1e-9, b - 1e-9, 200) for a, b in pairwise(motion.time)
    ])  # fmt: skip
    _, speed, acceleration = motion.at(times)
    sampled = np.abs(speed).max(axis=0), np.abs(acceleration).max(axis=0)
    for found, least in zip((fast, sharp), sampled, strict=True):
        assert (found >= least - 1e-6).all()
        # two hundred samples a piece miss little of a parabola
        np.testing.assert_allclose(found, least, rtol=2e-3)


@settings(max_examples=20)
@given(seed=st.integers(0, 10**6))
def test_the_distance_from_the_chords_is_that_of_a_dense_sample(seed):
    motion = wavy(seed)
    knots, worst = motion.spline.x, 0.0
    for a, b in pairwise(knots):
        s = np.linspace(a, b, 400)
        chord = motion.spline(a) + np.outer((s - a) / (b - a), motion.spline(b) - motion.spline(a))
        worst = max(worst, float(np.abs(motion.spline(s) - chord).max()))
    assert motion.away_from_chords() == pytest.approx(worst, rel=1e-4)
    assert motion.away_from_chords() >= worst - 1e-12


def test_a_motion_passes_its_grid_when_it_says_and_ends_at_its_ends():
    motion = wavy(5)
    q, _, _ = motion.at(motion.time)
    np.testing.assert_allclose(q, motion.spline(motion.grid), atol=1e-9)
    early, late = motion.at(np.array([0.0, motion.time[-1]]))[1]
    np.testing.assert_allclose([early, late], 0.0, atol=1e-6)
