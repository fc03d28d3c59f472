"""Evaluation, records, robustness and mutation on a toy document."""

import json
from dataclasses import replace

import pytest

from dualarm_repro.errors import InputError, LedgerError, UnknownNameError
from dualarm_repro.ledger import Is, Result, Verdict, evaluate, record, robustness
from dualarm_repro.ledger.mutation import insensitive

from .toy import toy_registry


@pytest.fixture
def toy(tmp_path):
    return toy_registry(tmp_path)


def test_verdicts(toy):
    assert evaluate(toy, "toy.claim_area").verdict is Verdict.UNDER_ASSUMPTION
    assert evaluate(toy, "toy.claim_area", {"width": 3.0}).verdict is Verdict.NOT_REPRODUCED
    assert evaluate(toy, "toy.claim_count").verdict is Verdict.REPRODUCED
    assert evaluate(toy, "toy.fig01").verdict is Verdict.NOT_ATTEMPTED


def test_unknown_id_names_the_nearest(toy):
    with pytest.raises(UnknownNameError, match=r"toy\.claim_area"):
        evaluate(toy, "toy.claim_aera")


def test_assumptions_are_declared_exactly(tmp_path):
    toy = toy_registry(tmp_path)
    checker = toy.checkers["toy.claim_count"]
    toy.checkers["toy.claim_count"] = type(checker)(
        lambda assumed: Result({"n": 3 * assumed["width"]}, caption=""), checker.rules, "toy/page"
    )
    with pytest.raises(LedgerError, match=r"declares the assumptions \[\], but reads \['width'\]"):
        evaluate(toy, "toy.claim_count")


def test_one_checker_per_item_and_one_that_can_fail(toy):
    with pytest.raises(LedgerError, match="second checker"):
        toy.checks("toy.claim_count", [Is(key="n", label="n", value=3)], page="p")
    with pytest.raises(LedgerError, match="cannot fail"):
        toy.checks("toy.fig01", [], page="p")


def test_record_is_json_and_says_everything(toy):
    made = record(toy, "toy.claim_area")
    assert json.loads(json.dumps(made)) == made
    assert made["verdict"] == "reproduced-under-assumption"
    assert [entry["id"] for entry in made["assumptions"]] == ["width", "shape"]
    assert made["errata"][0]["proof"]["holds"] is True
    assert made["checks"][0]["obtained"] == 0.75
    assert record(toy, "toy.fig01")["pending"] == "not drawn yet"


def test_record_cache_is_used_and_bypassed(toy, tmp_path, monkeypatch):
    monkeypatch.setenv("DUALARM_CACHE", str(tmp_path / "cache"))
    made = record(toy, "toy.claim_count")
    path = next((tmp_path / "cache").rglob("toy.claim_count.json"))
    assert json.loads(path.read_text()) == made
    path.write_text(json.dumps({**made, "title": "from the cache"}))
    assert record(toy, "toy.claim_count")["title"] == "from the cache"
    monkeypatch.setenv("DUALARM_CACHE", "off")
    assert record(toy, "toy.claim_count")["title"] == "The count"


def test_robustness_finds_the_flip(toy):
    found = robustness(toy, "toy.claim_area")
    # The verdict holds below sqrt(2 / 0.75) for round shapes, below sqrt(2) for square ones.
    share = 0.5 * ((2 / 0.75) ** 0.5 + 2**0.5) / 4
    assert found.samples == 64
    assert found.holds == pytest.approx(share, abs=0.05)
    assert found.interval[0] < share < found.interval[1]
    assert found.flip.assumption == "width"
    assert found.flip.value == pytest.approx((2 / 0.75) ** 0.5, abs=1e-3)
    assert found.flip.verdict == "not-reproduced"
    assert robustness(toy, "toy.claim_area") == found


def test_robustness_without_anything_to_vary(toy):
    assert robustness(toy, "toy.claim_count") is None
    assert robustness(toy, "toy.fig01") is None
    with pytest.raises(InputError, match="samples"):
        robustness(toy, "toy.claim_area", 0)


def test_mutation_accepts_honest_checkers(toy):
    assert insensitive(evaluate(toy, "toy.claim_area")) == []
    assert insensitive(evaluate(toy, "toy.claim_count")) == []
    assert insensitive(evaluate(toy, "toy.claim_area", {"width": 3.0})) == []


def test_mutation_catches_a_checker_that_cannot_fail(tmp_path):
    class Deaf(Is):
        def holds(self, evidence):
            return True

    toy = toy_registry(tmp_path)
    checker = toy.checkers["toy.claim_count"]
    rules = (Deaf(key="n", label="deaf", value=3),)
    toy.checkers["toy.claim_count"] = type(checker)(checker.compute, rules, "toy/page")
    assert insensitive(evaluate(toy, "toy.claim_count")) == ["deaf", "verdict on deaf"]


def test_draws_that_cannot_be_computed_do_not_keep_the_verdict(toy):
    compute = toy.checkers["toy.claim_area"].compute

    def refusing(assumed):
        if assumed["width"] > 1.2:
            raise InputError("toy", "width", assumed["width"], "at most 1.2")
        return compute(assumed)

    toy.checkers["toy.claim_area"] = replace(toy.checkers["toy.claim_area"], compute=refusing)
    found = robustness(toy, "toy.claim_area")
    assert found.holds < 0.5
    assert found.flip.verdict == "not-computable"
    assert found.flip.value == pytest.approx(1.2, abs=1e-2)
