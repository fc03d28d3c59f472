"""Statements of `qiu` whose verdict follows what is open: force, table, limits, goals."""

import pytest

from dualarm_repro.ledger import REGISTRY, Verdict, evaluate
from dualarm_repro.papers import load
from dualarm_repro.papers.qiu.document import PRINTED
from dualarm_repro.papers.qiu.pages.field.forces import repulsion
from dualarm_repro.papers.qiu.studies.free_pairs import FREE

load()


@pytest.mark.parametrize(
    ("form", "verdict"),
    [("textbook", Verdict.NOT_REPRODUCED), ("inverse", Verdict.UNDER_ASSUMPTION)],
)
def test_the_form_of_the_force_decides_whether_it_is_inverse_proportion(form, verdict):
    assert evaluate(REGISTRY, "qiu.claim_inverse", {"repulsion_form": form}).verdict is verdict


def test_only_the_textbook_force_ends_without_a_jump():
    range_ = float(PRINTED.influence)
    assert repulsion("textbook", range_) == 0.0
    assert repulsion("inverse", range_) == pytest.approx(2.0 * repulsion("inverse", 2.0 * range_))


def test_a_motion_through_the_table_is_no_free_one():
    table = FREE.load().query(
        "joined and arms > 0 and obstacles > 0 and floor_distance < 0 and beyond_limits <= 0"
    )
    cell = {name: table.iloc[0][name] for name in FREE.cells()[0]}
    assert cell["floor"] == "at_bases"
    found = evaluate(REGISTRY, "qiu.claim_no_collision", cell)
    assert found.verdict is Verdict.NOT_REPRODUCED
    assert [rule.key for rule in found.checker.rules if not rule.holds(found.evidence)] == [
        "others"
    ]


def test_a_goal_beyond_the_limits_fails_only_if_they_are_kept():
    over = {
        limits: evaluate(
            REGISTRY, "qiu.claim_no_collision", {"slave_branch": "front_deep", "limits": limits}
        ).result.obtained["over_limits"]
        for limits in ("kept", "ignored")
    }
    assert over["kept"] > 0.0
    assert over["ignored"] == 0.0


def test_goals_of_either_draw_are_judged_by_themselves():
    found = evaluate(REGISTRY, "qiu.claim_hull_valid")
    shares = found.result.obtained["effective"]
    outcomes = {r.key: r.holds(found.evidence) for r in found.checker.rules}
    for drawn, share in shares.items():
        assert outcomes[f"effective.{drawn}"] == (share["count"] > 0.55 * share["of"])
