"""Trials of the slave: counts, and the reuse of runs that meet no trap."""

from dataclasses import replace

import numpy as np
import pytest

from dualarm_repro.arms.tool_postures import tool_posture
from dualarm_repro.papers.xue.document import placed_slave
from dualarm_repro.papers.xue.motions import slave_obstacles
from dualarm_repro.papers.xue.outcomes import (
    VARIANTS,
    clear_starts,
    outcomes,
    run_variant,
    run_variants,
    starts,
    summary,
)
from dualarm_repro.papers.xue.reading import nominal
from dualarm_repro.papers.xue.studies.ablation import NAMED
from dualarm_repro.planning.trials.runs import TOUCHES, touching


@pytest.fixture(scope="module")
def case(registry):
    return nominal()


@pytest.fixture(scope="module")
def begin(case):
    return starts(case, 0.1, 6, np.random.default_rng(3))


def test_starts_stay_within_the_half_width_and_follow_the_seed(case, begin):
    away = np.abs(begin - placed_slave(case.layout).start)
    assert 0.05 < away.max() <= 0.1
    np.testing.assert_array_equal(begin, starts(case, 0.1, 6, np.random.default_rng(3)))


@pytest.mark.parametrize("method", VARIANTS)
def test_batch_agrees_with_single_plans(case, begin, method):
    runs = run_variant(case, method, begin[:2])
    placed, settings = placed_slave(case.layout), VARIANTS[method].settings(case)
    for k, start in enumerate(begin[:2]):
        around = placed, start, placed.goal, slave_obstacles(case), settings
        plan = VARIANTS[method].single(*around)
        assert (runs.reason[k], runs.steps[k]) == (plan.reason, plan.steps)
        np.testing.assert_allclose(runs.last[k], plan.path[-1], atol=1e-12)


def test_rerun_of_the_missed_is_the_improved_method(case):
    yawed = case._replace(layout=replace(case.layout, **NAMED["yawed"]))
    begin = starts(yawed, 0.1, 5, np.random.default_rng(0))
    made = run_variants(yawed, ("without_virtual", "improved"), begin)
    whole = run_variant(yawed, "improved", begin)
    assert not made["without_virtual"].reached.all(), "the point is needed here"
    for one, other in zip(made["improved"], whole, strict=True):
        np.testing.assert_array_equal(one, other)
    assert made["improved"].rescued.any()


def test_a_wall_holds_an_arm(case):
    """Without an opening, and too wide to slide off, the wall is a minimum."""
    begin = starts(case, 0.1, 10, np.random.default_rng(0))
    found = summary(case, "traditional", run_variant(case, "traditional", begin))
    assert found.held <= found.trapped
    closed = replace(
        case.layout, window_opening_width=0.02, window_opening_height=0.02, window_bar=0.8
    )
    wall = case._replace(layout=closed)
    found = summary(wall, "traditional", run_variant(wall, "traditional", begin))
    assert found.held == found.trapped == found.stationary == len(begin)


def test_a_perturbed_start_that_touches_a_bar_is_named_and_counted(case):
    arm, base = placed_slave(case.layout).arm, case.layout.slave_base
    inside = [
        tool_posture(arm, bar.center - base, "radial_horizontal") for bar in case.layout.window()
    ]
    begin = np.array([q for q in inside if q is not None])
    assert len(begin), "the middle of some bar is within reach"
    runs = run_variant(case, "traditional", begin)
    assert set(runs.reason) == {TOUCHES}
    assert summary(case, "traditional", runs).missed == len(begin)


def test_starts_in_contact_are_left_out_and_counted(case):
    """A bar right beside the printed Start, into which some perturbed starts reach."""
    begin = placed_slave(case.layout).start
    tip = placed_slave(case.layout).placement.act(case_tip(case, begin))
    across = 0.5 * case.layout.window_opening_width + 0.5 * case.layout.window_bar + 0.09
    near = replace(
        case.layout,
        window_centre_x=float(tip[0]),
        window_centre_y=float(tip[1] + across),
        window_centre_z=float(tip[2]),
    )
    beside = case._replace(layout=near)
    found, left_out = clear_starts(beside, 0.2, 8, np.random.default_rng(0))
    assert found.shape == (8, 6)
    assert left_out > 0
    for name in ("traditional", "improved"):
        assert not touching(VARIANTS[name].problem(beside), found).any()
    assert clear_starts(case, 0.05, 8, np.random.default_rng(0))[1] == 0


def case_tip(case, q):
    return placed_slave(case.layout).arm.positions(q)


def test_the_printed_criterion_is_one_that_the_position_does_not_meet(case, begin):
    by_position = run_variant(case, "five_points", begin)
    by_angles = run_variant(case, "five_points", begin, "goal_angles")
    goal = placed_slave(case.layout).goal
    assert by_position.reached.sum() > by_angles.reached.sum()
    close = np.abs(by_angles.last[by_angles.reached] - goal).max(initial=0.0)
    assert close <= case.planner.goal_tolerance
    rests = summary(case, "five_points", by_angles)
    assert rests.held <= rests.trapped < rests.missed


def test_outcomes_are_flat_columns(case, begin):
    row = outcomes(case, ("traditional", "without_virtual", "improved"), begin[:2])
    assert row["traditional_runs"] == row["improved_runs"] == 2
    assert all(np.isscalar(value) for value in row.values())
