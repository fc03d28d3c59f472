"""Smoothing of the splice, and the time map that execution replays."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import make_smoothing_spline
from two_spheres import GOAL, START, obstacles, placed_arm, settings

from dualarm_repro.errors import InputError
from dualarm_repro.planning.search.bidirectional_arms import TwoArmSettings, spliced
from dualarm_repro.planning.search.bidirectional_compiled import plan_bidirectional_compiled
from dualarm_repro.planning.search.splice import roughness, smoothed, smoothed_directly
from dualarm_repro.planning.search.time_map import along_path, replay, shares, time_map


@pytest.fixture(scope="module")
def plan():
    return plan_bidirectional_compiled(placed_arm(), START, GOAL, obstacles(), settings())


@pytest.mark.parametrize("smoothing", [0.1, 1.0, 100.0])
def test_spline_equals_the_direct_minimum_and_keeps_the_ends(plan, smoothing):
    smooth = smoothed(plan.path, smoothing, 1e4)
    assert smooth == pytest.approx(smoothed_directly(plan.path, smoothing, 1e4), abs=1e-9)
    assert smooth[[0, -1]] == pytest.approx(plan.path[[0, -1]], abs=1e-5)


@given(
    count=st.integers(5, 120),
    smoothing=st.sampled_from([0.0, 1e-3, 1.0, 100.0]),
    end_weight=st.sampled_from([0.5, 1.0, 1e4]),
    seed=st.integers(0, 10**6),
)
def test_spline_equals_that_of_scipy_and_the_normal_equations(count, smoothing, end_weight, seed):
    path = np.cumsum(np.random.default_rng(seed).normal(0.0, 0.1, (count, 3)), axis=0)
    before = path.copy()
    found = smoothed(path, smoothing, end_weight)
    assert (path == before).all()
    samples, weights = np.arange(float(count)), np.ones(count)
    weights[[0, -1]] = end_weight
    spline = make_smoothing_spline(samples, path, w=weights, lam=smoothing, axis=0)
    assert found == pytest.approx(spline(samples), abs=1e-9)
    assert found == pytest.approx(smoothed_directly(path, smoothing, end_weight), abs=1e-9)


@given(degree=st.integers(0, 1), smoothing=st.floats(0.0, 1e3))
def test_a_straight_path_stays_as_it_is(degree, smoothing):
    path = np.arange(30.0)[:, np.newaxis] ** degree * [0.1, -0.2]
    assert smoothed(path, smoothing, 1e4) == pytest.approx(path, abs=1e-12)


def test_roughness_falls_as_smoothing_grows(plan):
    values = [roughness(smoothed_directly(plan.path, mu, 1.0)) for mu in (0.0, 0.1, 1.0, 10.0)]
    assert values == sorted(values, reverse=True)
    straight = np.linspace(START, GOAL, 20)
    assert roughness(straight) == pytest.approx(0.0, abs=1e-9)
    x = np.arange(9.0)[:, None]
    # nine points: the ends of the integral lie half a step inside
    assert roughness(x**2) == pytest.approx(4.0 * 8.0, rel=0.2)


def test_bad_smoothing(plan):
    with pytest.raises(InputError, match="at least 5"):
        smoothed(plan.path[:4], 1.0, 1.0)
    for smoothing in (-1.0, np.nan, np.inf):
        with pytest.raises(InputError, match="not negative"):
            smoothed(plan.path, smoothing, 1.0)
    for weight in (0.0, -1.0, np.nan, np.inf):
        with pytest.raises(InputError, match=r"end_weight.*positive"):
            smoothed(plan.path, 1.0, weight)
    with pytest.raises(InputError, match=r"samples \(N, nq\)"):
        smoothed(plan.path[:, 0], 1.0, 1.0)
    with pytest.raises(InputError, match="a number whose curve is finite"):
        smoothed(plan.path, 1e308, 1.0)
    for bad in (np.nan, np.inf):
        path = plan.path.copy()
        path[3, 1] = bad
        with pytest.raises(InputError, match=r"path.*finite numbers"):
            smoothed(path, 0.0, 1.0)


def test_shares_rise_evenly_and_hold_the_middle():
    assert shares(6, 4) == pytest.approx([0, 0.125, 0.25, 0.375, 0.5, 0.5, 0.5])
    assert shares(2, 4) == pytest.approx([0, 0.125, 0.25])
    with pytest.raises(InputError, match="spread"):
        shares(3, 0)


@pytest.mark.parametrize("spread", [5, 31, 60])
def test_replay_moves_the_master_at_its_pace(plan, spread):
    share = time_map(plan, spread)
    assert len(share) == len(plan.path)
    assert share[0] == 0.0
    assert share[-1] == 1.0
    assert (np.diff(share) >= 0).all()
    master = np.linspace(GOAL, START, 21)
    both = replay(master, plan.path, share, spread)
    assert len(both[0]) == len(both[1]) >= len(share)
    assert (both[0][0] == GOAL).all()
    assert both[0][-1] == pytest.approx(START)
    pace = np.abs(np.diff(both[0], axis=0)).max(axis=1)
    assert pace.max() <= 0.5 / spread * np.abs(GOAL).max() * (1 + 1e-9)
    kept = np.flatnonzero(np.r_[True, (np.diff(both[1], axis=0) != 0).any(axis=1)])
    assert (both[1][kept] == plan.path).all()
    assert along_path(master, np.array([0.5]))[0] == pytest.approx(0.5 * GOAL)


@given(
    shares_seen=st.lists(st.floats(0.0, 1.0), max_size=20).map(sorted), spread=st.integers(1, 40)
)
def test_every_jump_of_the_map_is_walked_in_equal_parts(shares_seen, spread):
    share, pace = np.array([0.0, *shares_seen, 1.0]), 0.5 / spread
    slave = np.arange(float(len(share)))[:, np.newaxis]
    master, waiting = replay(np.array([[0.0], [1.0]]), slave, share, spread)
    k = 0
    for row, (a, b) in enumerate(pairwise(share)):
        parts = max(int(np.ceil((b - a) / pace - 1e-9)), 1)
        walked = master[k : k + parts + 1, 0]
        assert walked == pytest.approx(np.linspace(a, b, parts + 1), abs=1e-12)
        assert (waiting[k : k + parts, 0] == row).all()
        k += parts
    assert len(master) == len(waiting) == k + 1
    assert waiting[-1, 0] == len(share) - 1


def test_a_plan_is_smoothed_where_a_spline_fits_and_left_alone_where_none_does(plan):
    chosen = TwoArmSettings(**settings().model_dump(), smoothing=1.0, end_weight=1e4)
    smooth = spliced(plan, chosen).path
    assert smooth == pytest.approx(smoothed(plan.path, 1.0, 1e4))
    assert np.abs(smooth - plan.path).max() > 1e-4
    near = START + 0.01 * (GOAL - START)
    short = plan_bidirectional_compiled(placed_arm(), START, near, obstacles(), settings())
    assert len(short.path) < 5
    assert spliced(short, chosen).path == pytest.approx(short.path)
