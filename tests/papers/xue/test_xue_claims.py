"""Statements about one run and about the methods: existence, three answers, witnesses."""

import numpy as np
import pandas as pd
import pytest
from evaluated_items import evaluated

from dualarm_repro.ledger import Verdict, evaluate
from dualarm_repro.ledger.settled import settle
from dualarm_repro.ledger.shares import Share
from dualarm_repro.papers.xue import stored
from dualarm_repro.papers.xue.document import lengths
from dualarm_repro.papers.xue.motions import cores_of, replay_of, slave_plan
from dualarm_repro.papers.xue.pages import truth
from dualarm_repro.papers.xue.pages.table2 import superiority
from dualarm_repro.papers.xue.pages.table2 import table as table_2
from dualarm_repro.papers.xue.pages.table2.statements import printed_seconds
from dualarm_repro.papers.xue.pages.truth import arms_witnesses
from dualarm_repro.papers.xue.reading import nominal
from dualarm_repro.papers.xue.stored import mean_with_interval
from dualarm_repro.planning.checks.link_clearance import LinkClearance
from dualarm_repro.planning.trials.link_cores import LinkCores


def settled(registry, name):
    return settle(registry, evaluate(registry, f"xue.{name}"), lambda _: "")


def test_mean_with_interval():
    found = mean_with_interval(np.array([1.0, -1.0, 1.0, -1.0]))
    assert found["value"] == 0.0
    assert found["high"] == -found["low"] == pytest.approx(1.96 * np.sqrt(4 / 3) / 2, abs=1e-3)
    assert found["of"] == 4


def test_traps_that_hold_are_possible(registry):
    evaluation = evaluate(registry, "xue.claim_trapped_8")
    assert evaluation.verdict is Verdict.UNDER_ASSUMPTION
    assert evaluation.result.obtained["held"]["traditional"] == 8
    assert evaluation.result.obtained["unproved"] == 0


def test_runs_that_only_stand_still_are_no_traps(registry, monkeypatch):
    """Eight that stand still, none in a minimum: what a saddle or an edge makes of the count."""
    given = table_2.assumed_trials

    def on_a_saddle(assumed):
        trials = given(assumed)
        return trials._replace(traditional=trials.traditional._replace(held=0))

    monkeypatch.setattr(table_2, "assumed_trials", on_a_saddle)
    assert evaluate(registry, "xue.claim_trapped_8").verdict is Verdict.NOT_REPRODUCED


def test_a_witness_lies_within_the_declared_ranges(registry):
    (witness,) = table_2.trapped_witnesses("end_effector")
    for name, value in witness["values"].items():
        declared = registry.papers["xue"].assumptions[name]
        if declared.range:
            assert declared.range[0] <= value <= declared.range[1]
        elif declared.choices:
            assert value in declared.choices


def test_whether_other_links_collide_has_a_witness_of_either_kind(registry):
    holds, fails = arms_witnesses(0.12)
    assert (
        holds["judged"]["links_touch_at_radius"] > 0.12 >= fails["judged"]["links_touch_at_radius"]
    )
    assert settled(registry, "claim_only_tcp").verdict is Verdict.UNDECIDABLE


def test_a_counterexample_refutes_the_inference_from_tips_to_links(registry, monkeypatch):
    found = settled(registry, "claim_tip_check_suffices")
    assert found.verdict is Verdict.NOT_REPRODUCED
    (witness,) = [entry for entry in found.witnesses if entry["choice"].startswith("arrangement")]
    assert witness["judged"]["links_touch_at_radius"] <= 0.12
    assert witness["judged"]["flanges_apart"] > 0.15
    clear = stored.lottery_table().assign(cores_arms=1.0)
    monkeypatch.setattr(truth, "lottery_table", lambda: clear)
    assert evaluate(registry, "xue.claim_tip_check_suffices").verdict is Verdict.UNDER_ASSUMPTION


def test_last_links_that_may_touch_are_not_counted_as_others():
    radius, last = 0.12, 2 * lengths("matrices")["d6"]
    assert last == pytest.approx(2 * 0.225)
    near, far = 2 * radius + last - 1e-6, 2 * radius + last + 1e-6
    table = pd.DataFrame({"cores_arms": [0.2, 0.2, 0.3], "flanges_apart": [near, far, far]})
    assert truth.others_touch(table, radius).tolist() == [False, True, False]


def test_other_links_leave_the_pair_of_last_ones_aside():
    bodies = [("master/capsule_4_joint_6", "slave/capsule_4_joint_6"),
              ("master/capsule_3_joint_4", "slave/capsule_4_joint_6"),
              ("master/capsule_3_joint_4", "slave/capsule_3_joint_4"),
              ("master/capsule_4_joint_6", "window/0")]  # fmt: skip
    distance = np.array([[0.1, 0.3, 0.5, 0.0]])
    found = LinkClearance(tuple(bodies), np.zeros(1), {}, distance)
    assert truth.other_links(LinkCores(found)) == 0.3


def test_the_bound_looks_where_the_end_effectors_are_looked_at():
    """Cores and end effectors at the same instants, or two last links could slip through."""
    case = nominal()
    replay = replay_of(case, slave_plan(case))
    cores = cores_of(replay, case.layout)
    np.testing.assert_array_equal(cores.found.index, replay.times)


def test_runs_of_one_arrangement_are_one_observation():
    """A hundred arrangements are not made more certain by ten equal runs in each."""
    part = pd.Series([10.0, 0.0] * 50)
    found = stored.mean_share(part, pd.Series([10.0] * 100))
    assert found.value == 0.5
    # the spread of a sample of 100 has 99 degrees of freedom: 0.5 % more
    assert found.high - found.low == pytest.approx(2 * 1.96 * 0.5 / 10, rel=0.01)
    assert found.high - found.low > 2 * (Share.of(500, 1000).high - Share.of(500, 1000).low)
    empty = stored.mean_share(pd.Series([0.0]), pd.Series([0.0]))
    assert empty[1:] == (0.0, 1.0)


def test_a_point_that_misses_in_most_arrangements_would_be_hard_to_apply(registry, monkeypatch):
    name = "xue.claim_no_ik"
    assert evaluate(registry, name).verdict is Verdict.NOT_REPRODUCED
    missing = stored.lottery_table()
    missing = missing.assign(cartesian_ik_missed=missing["cartesian_ik_runs"])
    monkeypatch.setattr(stored, "lottery_table", lambda: missing)
    assert evaluate(registry, name).verdict is Verdict.REPRODUCED


def test_an_advantage_below_its_margin_is_none(registry, monkeypatch):
    table = stored.lottery_table()
    little = table.assign(traditional_missed=table["improved_missed"] + (table.index % 10 == 0))
    monkeypatch.setattr(superiority, "lottery_table", lambda: little)
    found = evaluate(registry, "xue.claim_better")
    assert 0.0 < found.result.obtained["ability"]["low"]
    assert found.verdict is Verdict.NOT_REPRODUCED


def test_a_table_likelier_than_the_text_by_a_hair_is_open(registry, monkeypatch):
    shown = stored.outcomes_of_table_2("end_effector")
    hair = np.zeros(len(shown["text"]), dtype=bool)
    hair[:8] = True
    hardly = {**shown, "text": hair, "table": np.zeros_like(hair)}
    monkeypatch.setattr(stored, "outcomes_of_table_2", lambda _: hardly)
    found = evaluate(registry, "xue.tab02")
    rule = next(rule for rule in found.rules if rule.key == "text_less_table")
    assert found.result.obtained["text_less_table"]["low"] > 0.0
    assert str(rule.outcome(found.evidence)) == "open"


def test_text_and_table_are_outcomes_that_exclude_each_other(registry):
    found = stored.outcomes_of_table_2("end_effector")
    assert not (found["text"] & found["table"]).any()
    assert (found["text"] <= found["traditional_mostly_held"]).all()


def test_times_change_places_with_the_labels():
    as_printed, exchanged = printed_seconds("trap_column"), printed_seconds("row_labels")
    assert as_printed["traditional"] == exchanged["improved"] == 0.53


def test_superiority_turns_with_the_outcomes_of_the_lottery(registry, monkeypatch):
    table = stored.lottery_table()
    before = evaluate(registry, "xue.claim_better")
    swapped = table.copy()
    swapped["traditional_missed"] = table["improved_missed"]
    swapped["improved_missed"] = table["traditional_missed"]
    monkeypatch.setattr(superiority, "lottery_table", lambda: swapped)
    after = evaluate(registry, "xue.claim_better")
    for name in ("ability", "robustness"):
        assert after.result.obtained[name]["low"] == -before.result.obtained[name]["high"]
    assert after.verdict is Verdict.NOT_REPRODUCED


def test_methods_that_differ_by_the_margin_leave_superiority_open(registry, monkeypatch):
    """Exchanged in a quarter of the arrangements, of the advantage half is left."""
    table = stored.lottery_table()
    even, some = table.copy(), table.index % 4 == 0
    even.loc[some, "traditional_missed"] = table.loc[some, "improved_missed"]
    even.loc[some, "improved_missed"] = table.loc[some, "traditional_missed"]
    monkeypatch.setattr(superiority, "lottery_table", lambda: even)
    found = evaluate(registry, "xue.claim_better")
    assert found.verdict is Verdict.UNDECIDABLE
    assert {entry["verdict"] for entry in found.result.witnesses} == {"holds", "fails"}


def test_points_with_a_length_are_not_joints_as_points(registry):
    name = "xue.claim_joints_as_points"
    assert evaluate(registry, name).verdict is Verdict.ADOPTED
    assert evaluate(registry, name, {"control_points": "five_links"}).verdict is not Verdict.ADOPTED


@pytest.mark.parametrize("sense", ["same_step", "same_tool_speed"])
def test_speeds_are_equal_in_either_sense(registry, sense):
    found = evaluate(registry, "xue.claim_equal_speed", {"equal_speed_meaning": sense})
    assert found.verdict is Verdict.ADOPTED
    assert found.result.obtained["other_difference"] > 0.1


@pytest.mark.parametrize(
    ("switching", "verdict"),
    [("on_when_stuck", Verdict.REGENERATED), ("from_start", Verdict.NOT_REPRODUCED)],
)
def test_flow_turns_to_the_virtual_point_only_in_a_trap(registry, switching, verdict):
    found = evaluate(registry, "xue.fig07", {"virtual_switching": switching})
    assert found.verdict is verdict


def test_a_longer_upper_arm_exceeds_the_printed_reach(registry):
    assert evaluated("xue.fig05").result.obtained["beyond_reach"] == 0
    assert evaluate(registry, "xue.fig05", {"upper_arm": 1.15}).verdict is Verdict.NOT_REPRODUCED


def test_only_joints_without_limits_hold_the_printed_start(registry):
    assert evaluated("xue.fig05").result.obtained["holds_start"] == ["full_turns"]
