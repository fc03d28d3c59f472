"""Verdicts over all declared choices: draws, flips, climbs, witnesses, statements."""

from dataclasses import replace

import pytest

from dualarm_repro.errors import InputError
from dualarm_repro.ledger import Bounded, Generally, NoOriginal, Result, evaluate, settle, study
from dualarm_repro.ledger.robustness import NOT_COMPUTABLE, study_of
from dualarm_repro.ledger.settled import robustness_of_draws

from .toy import YAML, toy_registry

#: The area is below two where the width is below sqrt(2 / 0.75) (round) or sqrt(2) (square).
EDGE = (2 / 0.75) ** 0.5
SHARE = 0.5 * (EDGE + 2**0.5) / 4


@pytest.fixture
def make(tmp_path, monkeypatch):
    monkeypatch.setattr(study, "data_path", lambda *parts: tmp_path.joinpath("data", *parts))
    monkeypatch.chdir(tmp_path)  # where unfinished runs are kept

    def registry(text=YAML, rules=None, compute=None, item="toy.claim_area"):
        toy = toy_registry(tmp_path, text)
        checker = toy.checkers[item]
        changes = {"rules": tuple(rules)} if rules else {}
        if compute:
            changes["compute"] = compute
        toy.checkers[item] = replace(checker, **changes)
        return toy

    return registry


def settled(toy, item="toy.claim_area", run=True):
    if run:
        study_of(toy, item).run()
    verdicts = {}
    return settle(toy, evaluate(toy, item), lambda other: verdicts.get(other, "reproduced"))


def test_share_flip_and_influence(make):
    found = settled(make())
    assert found.verdict == "reproduced-under-assumption"
    robust = found.robustness
    assert robust["samples"] == 64
    # 64 draws that fill the range evenly: within three of them
    assert robust["holds"] == robust["meets_print"]["share"] == pytest.approx(SHARE, abs=0.05)
    assert robust["interval"][0] < SHARE < robust["interval"][1]
    assert robust["flip"]["assumption"] == "width"
    # the nearest of 64 draws beyond the edge: their spacing
    assert robust["flip"]["value"] == pytest.approx(EDGE, abs=0.05)
    assert robust["flip"]["verdict"] == "not-reproduced"
    assert list(robust["influence"]) == ["width"]
    assert found.witnesses[0]["choice"] == "nominal"
    assert found.draws == "up to date"


def test_draws_of_other_code_are_not_used(make):
    toy = make()
    settled(toy)
    toy.checkers["toy.claim_area"] = replace(toy.checkers["toy.claim_area"], samples=63)
    found = settled(toy, run=False)
    assert found.robustness is None
    assert found.draws.startswith("stale")


def test_one_run_is_possible_if_any_choice_meets_print(make):
    found = settled(make(rules=[Bounded("area", "area above two", low=2.0)]))
    assert found.verdict == "reproduced-under-assumption"
    (witness,) = found.witnesses
    assert witness["choice"].startswith("draw")
    assert witness["judged"]["area"] >= 2.0
    assert witness["values"]["width"] > 2**0.5


def test_not_found_tells_the_nearest_miss(make):
    found = settled(make(rules=[Bounded("area", "area above thirty", low=30.0)]))
    assert found.verdict == "not-reproduced"
    assert found.robustness["meets_print"]["share"] == 0.0
    assert not found.search["directed"]
    assert found.search["evaluations"] == 64, "the draws, and no climb"
    assert 0.4 < found.search["nearest"]["miss"] < 0.6
    # the draw nearest to the end of the range, not the end itself
    assert found.search["nearest"]["values"]["width"] == pytest.approx(4.0, abs=0.2)


def test_a_directed_search_finds_what_draws_miss(make):
    text = YAML.replace(
        "    needs: area\n", "    needs: area\n    search: {starts: 2, evaluations: 60}\n"
    )
    narrow = [Bounded("area", "area", low=15.83, high=15.87)]
    assert settled(make(rules=narrow)).verdict == "not-reproduced"
    found = settled(make(text, rules=narrow))
    assert found.verdict == "reproduced-under-assumption"
    assert found.witnesses[0]["choice"].startswith("search")


def test_generality_is_undecidable_where_choices_disagree(make):
    text = YAML.replace("    needs: area\n", "    needs: area\n    scope: general\n")
    found = settled(make(text))
    assert found.verdict == "undecidable"
    assert {w["verdict"] for w in found.witnesses} == {
        "reproduced-under-assumption",
        "not-reproduced",
    }
    always = settled(make(text, rules=[Bounded("area", "area", high=20.0)]))
    assert always.verdict == "reproduced-under-assumption"
    never = settled(make(text, rules=[Bounded("area", "area", high=-1.0)]))
    assert never.verdict == "not-reproduced"


def test_an_open_statistic_brings_its_own_witnesses(make):
    given = [{"choice": "cell 1", "verdict": "holds", "values": {}},
             {"choice": "cell 2", "verdict": "fails", "values": {}}]  # fmt: skip

    def compute(assumed):
        return Result({"share": {"count": 9, "of": 10}}, caption="", witnesses=given)

    toy = make(rules=[Generally("share", "s", at_least=0.9)], compute=compute,
               item="toy.claim_count")  # fmt: skip
    found = settled(toy, "toy.claim_count", run=False)
    assert found.verdict == "undecidable"
    assert found.witnesses == given


def test_what_cannot_be_computed_does_not_meet_print(make):
    plain = make().checkers["toy.claim_area"].compute

    def refusing(assumed):
        if assumed["width"] > 1.2:
            raise InputError("toy", "width", assumed["width"], "at most 1.2")
        return plain(assumed)

    robust = settled(make(compute=refusing)).robustness
    assert robust["holds"] < 0.5
    assert robust["flip"]["verdict"] == NOT_COMPUTABLE
    # the nearest of the draws beyond the edge: their spacing
    assert robust["flip"]["value"] == pytest.approx(1.2, abs=0.05)
    assert robust["not_computable"] > 0


@pytest.mark.parametrize(
    ("statement", "verdict", "by"),
    [
        ("not-reproduced", "not-reproduced", "toy.claim_area"),
        ("undecidable", "undecidable", "toy.claim_area"),
        ("reproduced", "reproduced", "toy.claim_area"),
        ("adopted", "regenerated", None),
    ],
)
def test_a_statement_that_decides_takes_precedence(make, statement, verdict, by):
    text = YAML.replace("needs: count}", "needs: count, statements: [toy.claim_area]}")
    toy = make(text, rules=[NoOriginal("drawing", "the drawing")], item="toy.claim_count")
    found = settle(toy, evaluate(toy, "toy.claim_count"), lambda item: statement)
    assert (found.verdict, found.decided_by) == (verdict, by)


def test_every_assumption_is_tried_for_an_effect(make):
    toy = make(compute=lambda assumed: Result({"area": 1.0 + 0 * assumed["width"]}, caption=""))
    table = study_of(toy, "toy.claim_area").run()
    changes = table[table["kind"] == "change"].set_index("assumption")["moves"]
    assert changes.to_dict() == {"width": "nothing", "shape": "nothing"}
    moving = study_of(make(), "toy.claim_area").run()
    changes = moving[moving["kind"] == "change"].set_index("assumption")["moves"]
    assert changes.to_dict() == {"width": "the nominal values", "shape": "the nominal values"}


def test_an_assumption_that_matters_elsewhere_only_is_found(make):
    def compute(assumed):
        wide = assumed["width"] if assumed["shape"] == "square" else 1.0
        return Result({"area": wide}, caption="")

    table = study_of(make(compute=compute), "toy.claim_area").run()
    moves = table[table["kind"] == "change"].set_index("assumption")["moves"]
    assert moves["width"].startswith("draw")


def test_a_value_without_a_range_is_probed(make):
    text = YAML.replace(", range: [0.0, 4.0]", "").replace(", choices: [round, square]", "")
    toy = make(text)
    table = study_of(toy, "toy.claim_area").run()
    assert table["moves"].tolist() == ["the nominal values", "nothing"]
    found = settled(toy, run=False)
    assert (found.draws, found.robustness) == ("none", None)


def test_drawing_anew(make):
    toy = make()
    few = robustness_of_draws(toy, "toy.claim_area", 16)
    assert few["samples"] == 16
    # 16 draws: within three of them
    assert few["holds"] == pytest.approx(SHARE, abs=0.2)
    assert robustness_of_draws(toy, "toy.claim_count", 16) is None
    with pytest.raises(InputError, match="samples"):
        robustness_of_draws(toy, "toy.claim_area", 0)
