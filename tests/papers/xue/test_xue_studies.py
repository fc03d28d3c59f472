"""The stored studies: reproducible cells, honest draws, and the arrangement they led to."""

import numpy as np
import pytest

from dualarm_repro.ledger.assumptions import Chosen
from dualarm_repro.papers.xue import stored
from dualarm_repro.papers.xue.document import Layout, assumption
from dualarm_repro.papers.xue.motions import replay_of, slave_undisturbed
from dualarm_repro.papers.xue.reading import KEPT, nominal
from dualarm_repro.papers.xue.studies import lottery, minima
from dualarm_repro.papers.xue.studies.search import (
    DEMANDS,
    SEARCH,
    disturbed,
    margins,
    on_grid,
    table_2,
)

STUDIES = (
    "xue_search",
    "xue_lottery",
    "xue_ablation",
    "xue_trials",
    "xue_minima",
    "xue_comparison",
    "xue_paths",
    "xue_planners",
)

#: Studies whose cells take longer.
LONG = ("xue_search", "xue_ablation", "xue_paths", "xue_planners")


@pytest.mark.parametrize("name", STUDIES)
def test_a_cell_recomputes_to_what_is_stored(registry, name):
    study = registry.studies[name]
    assert study.status() == "up to date"
    if name not in LONG:
        assert study.spot_check(1, seed=5) == []


def test_lottery_draws_satisfy_fig_9(registry):
    rng = np.random.default_rng(2)
    case, draws, _ = lottery.random_case(0.15, rng)
    assert draws >= 1
    replay = replay_of(case, slave_undisturbed(case.layout, case.planner))
    assert replay.to_obstacles().min() <= 0.0
    assert replay.apart(moving=True).min() <= 0.15
    assert not lottery.repelled_at_goal(case)


def test_enough_layouts(registry):
    assert len(stored.lottery_table()) >= 1000


def test_shares_are_consistent(registry):
    shares = stored.lottery_shares("end_effector")
    for share in shares.values():
        assert 0.0 <= share.low <= share.value <= share.high <= 1.0
    assert shares["text"].value <= shares["traditional_mostly_held"].value
    assert shares["text"].value <= shares["improved_never_missed"].value


def test_clear_share_falls_with_the_radius(registry):
    values = [stored.clear_share(radius).value for radius in (0.0, 0.05, 0.1, 0.15)]
    assert values == sorted(values, reverse=True)
    assert values[0] > values[-1]


def test_nominal_numbers_are_the_best_of_the_search(registry):
    best = SEARCH.load().sort_values("score").iloc[-1]
    layout = nominal().layout
    for name in vars(layout):
        value = getattr(layout, name)
        assert best[name] == (value if isinstance(value, str) else pytest.approx(value, abs=1e-9))


def test_nominal_arrangement_meets_every_demand(registry):
    found = margins(nominal())
    assert {"through", "slave_clear", "arms_clear", "master_clear", "avoidance_needed"} <= set(
        found
    )
    assert min(found.values()) > 0.0
    assert DEMANDS["radius"] == assumption("link_radius")
    seed = {"trial_seed": assumption("trial_seed"), "trial_perturbation": 0.1}
    assert table_2(nominal(), seed) == {"traditional": 8, "improved": 0}


def test_disturbed_arrangements_stay_on_the_grid(registry):
    layout = disturbed(nominal().layout, 0.1, np.random.default_rng(0))
    assert isinstance(layout, Layout)
    for name in ("master_base_x", "window_opening_width", "base_distance"):
        assert getattr(layout, name) == on_grid(getattr(layout, name))


def test_minima_vanish_with_the_joint_term_alone_in_charge():
    found = minima.minima_cell({"weight": 1e3}, np.random.default_rng(0))
    assert found["elsewhere"] == 0
    many = minima.minima_cell({"weight": 1e-2}, np.random.default_rng(0))
    assert many["minima"] > 0


def test_chosen_reads_assumptions_late(registry):
    chosen = Chosen("xue", (*KEPT, "meeting_distance"), extra=3)
    assert dict(chosen)["meeting_distance"] == assumption("meeting_distance")
    assert chosen["extra"] == 3
    assert len(chosen) == len(KEPT) + 2
