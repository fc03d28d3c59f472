"""Claims in words: each turns with what the stored runs and motions show."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from dualarm_repro.ledger import Verdict, evaluate
from dualarm_repro.papers.xue.pages import beyond, claims, truth
from dualarm_repro.papers.xue.studies import paths


def verdict(registry, name, changes=None):
    return evaluate(registry, f"xue.{name}", changes or {}).verdict


def changed(table, **columns):
    """The same table with other columns."""
    return table.assign(**columns)


def test_a_point_that_freed_every_trapped_run_would_lead_out_of_traps(registry, monkeypatch):
    assert verdict(registry, "claim_virtual_escapes") is Verdict.NOT_REPRODUCED
    table = claims._ablation()
    freed = table["without_virtual_missed"] - table["without_virtual_trapped"]
    monkeypatch.setattr(claims, "_ablation", lambda: changed(table, improved_missed=freed))
    found = evaluate(registry, "xue.claim_virtual_escapes")
    assert found.result.obtained["runs_gained"] == found.result.obtained["runs_trapped"]
    freed_rule = next(rule for rule in found.rules if rule.key == "freed")
    assert str(freed_rule.outcome(found.evidence)) == "holds"


def test_both_populations_decide_about_the_virtual_point(registry, monkeypatch):
    found = evaluate(registry, "xue.claim_virtual_escapes")
    outcomes = {rule.key: str(rule.outcome(found.evidence)) for rule in found.rules}
    assert outcomes["freed"] == "fails"
    shown = claims.lottery_table()
    left = shown["without_virtual_missed"]
    monkeypatch.setattr(claims, "lottery_table", lambda: changed(shown, improved_missed=left))
    found = evaluate(registry, "xue.claim_virtual_escapes")
    assert found.result.obtained["freed_shown"]["count"] == 0
    rule = next(rule for rule in found.rules if rule.key == "freed_shown")
    assert str(rule.outcome(found.evidence)) == "fails"


def test_half_of_the_trapped_runs_make_an_arrangement_count_as_freed():
    table = pd.DataFrame({"without_virtual_trapped": [4, 4, 0], "without_virtual_missed": [4, 4, 1],
                          "improved_missed": [2, 3, 0]})  # fmt: skip
    assert claims.freed(table, "improved") == {"count": 1, "of": 2}


def test_an_inverse_in_a_step_would_be_counted(monkeypatch):
    given = beyond.plan_apf

    def solving(placed, start, *rest):
        placed.arm.ik_branches(placed.arm.fk(start)[np.newaxis])
        return given(placed, start, *rest)

    assert beyond._inverse_calls() == 0
    monkeypatch.setattr(beyond, "plan_apf", solving)
    assert beyond._inverse_calls() == 1


def test_a_point_that_spoils_runs_does_not_hold(registry, monkeypatch):
    table = claims._ablation()
    worse = table["without_virtual_missed"] + 1
    monkeypatch.setattr(claims, "_ablation", lambda: changed(table, improved_missed=worse))
    found = evaluate(registry, "xue.claim_virtual_escapes")
    spoiled = next(rule for rule in found.rules if rule.key == "spoiled")
    assert str(spoiled.outcome(found.evidence)) == "fails"


@pytest.mark.parametrize("switching", ["replaces_goal", "from_start", "always"])
def test_every_switching_is_judged_by_runs_of_its_own(registry, switching):
    name = "xue.claim_virtual_escapes"
    found = evaluate(registry, name, {"virtual_switching": switching})
    table = claims._ablation()
    gained = (table["without_virtual_missed"] - table[f"{switching}_missed"]).sum()
    assert found.result.obtained["runs_gained"] == gained
    assert found.verdict is Verdict.NOT_REPRODUCED


def test_goal_angles_would_decide_if_fig_9_were_free(registry, monkeypatch):
    assert verdict(registry, "claim_goal_angles") is Verdict.NOT_REPRODUCED
    monkeypatch.setattr(claims, "points_to_window", lambda *_: np.array([0.1]))
    assert verdict(registry, "claim_goal_angles") is not Verdict.NOT_REPRODUCED


def test_attraction_is_largest_at_the_start_if_no_arm_gives_way(registry, monkeypatch):
    table = claims.paths_table()
    still = {name: np.zeros(len(table)) for name in table if name.endswith("_rise")}
    monkeypatch.setattr(claims, "paths_table", lambda: changed(table, **still))
    assert verdict(registry, "claim_attraction_falls") is Verdict.REPRODUCED


def test_a_path_farther_from_its_goal_than_at_its_start_is_seen():
    goal = np.zeros(3)
    straight = np.linspace([1.0, 0.0, 0.0], goal, 5)
    assert paths.farther_later(straight, goal) == 0.0
    detour = np.vstack([straight[:1], [[0.0, 1.5, 0.0]], straight])
    assert paths.farther_later(detour, goal) == pytest.approx(0.5)


def test_quality_turns_with_the_paths(registry, monkeypatch):
    table = claims.paths_table()
    names = {name: f"traditional_{name}" for name in ("tool_path", "bending", "postures")}
    better = {f"improved_{name}": 0.5 * table[old] for name, old in names.items()}
    monkeypatch.setattr(claims, "paths_table", lambda: changed(table, **better))
    found = evaluate(registry, "xue.claim_path_quality")
    assert found.result.obtained["tool_path"]["low"] == pytest.approx(np.log(2.0))
    assert found.verdict is Verdict.UNDER_ASSUMPTION
    worse = {f"improved_{name}": 2.0 * table[old] for name, old in names.items()}
    monkeypatch.setattr(claims, "paths_table", lambda: changed(table, **worse))
    assert verdict(registry, "claim_path_quality") is Verdict.NOT_REPRODUCED


def test_an_open_quality_shows_an_arrangement_of_either_kind(registry):
    found = evaluate(registry, "xue.claim_path_quality")
    sides = {entry["verdict"] for entry in found.result.witnesses}
    assert (found.verdict is Verdict.UNDECIDABLE) == (sides == {"holds", "fails"})


def test_a_sampler_as_cheap_as_the_field_would_refute_efficiency(registry, monkeypatch):
    table = beyond.planners_table()
    cheap = {f"rrt_{name}_effort": table["points_effort"] for name in ("both", "in_turn")}
    monkeypatch.setattr(beyond, "planners_table", lambda: changed(table, **cheap))
    assert verdict(registry, "claim_efficient") is Verdict.NOT_REPRODUCED


def test_the_virtual_term_follows_the_print_of_the_form_it_shares(registry, reprint):
    assert verdict(registry, "eq_virtual") is Verdict.UNDER_ASSUMPTION
    reprint("eq09", formula="U_att = k_a/2*|X - X_g|^3")
    assert verdict(registry, "eq_virtual") is Verdict.NOT_REPRODUCED


def test_a_motion_at_another_pace_is_not_adopted_as_equal(registry, monkeypatch):
    from dualarm_repro.papers.xue.pages import scene

    assert verdict(registry, "claim_equal_speed") is Verdict.ADOPTED
    pace = scene.mean_advance
    monkeypatch.setattr(scene, "mean_advance", lambda *track: 1.1 * pace(*track))
    assert verdict(registry, "claim_equal_speed") is Verdict.NOT_REPRODUCED


def test_distances_that_are_not_those_of_joints_are_noticed(registry, monkeypatch):
    assert verdict(registry, "claim_joints_as_points") is Verdict.ADOPTED
    plan = truth.master_plan

    def thicker(*given):
        found = plan(*given)
        return replace(found, clearance=found.clearance - 0.01)

    monkeypatch.setattr(truth, "master_plan", thicker)
    assert verdict(registry, "claim_joints_as_points") is Verdict.NOT_REPRODUCED


def test_sentences_cover_the_text_and_every_claim(registry):
    paper = registry.papers["xue"]
    assert len(paper.sentences) >= 60
    assert paper.unsaid_claims == []
    named = {name for sentence in paper.sentences for name in sentence.items}
    assert named == {f"xue.{key}" for key in paper.items}
    places = " ".join(sentence.place for sentence in paper.sentences)
    assert all(part in places for part in ("Abstract", "Section 0", "Section 4", "Table 2"))
