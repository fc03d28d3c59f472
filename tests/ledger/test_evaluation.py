"""Evaluation and mutation on a toy document."""

from dataclasses import replace

import pytest

from dualarm_repro.errors import LedgerError, UnknownNameError
from dualarm_repro.ledger import Is, Result, Verdict, evaluate
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


def test_an_assumption_that_is_read_is_declared(tmp_path):
    toy = toy_registry(tmp_path)
    checker = toy.checkers["toy.claim_count"]
    toy.checkers["toy.claim_count"] = replace(
        checker, compute=lambda assumed: Result({"n": 3 * assumed["width"]}, caption="")
    )
    with pytest.raises(LedgerError, match=r"reads the assumptions \['width'\], but declares them"):
        evaluate(toy, "toy.claim_count")


def test_one_checker_per_item_and_one_that_can_fail(toy):
    with pytest.raises(LedgerError, match="second checker"):
        toy.checks("toy.claim_count", [Is(key="n", label="n", value=3)], page="p")
    with pytest.raises(LedgerError, match="cannot fail"):
        toy.checks("toy.fig01", [], page="p")


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
    toy.checkers["toy.claim_count"] = replace(checker, rules=rules)
    assert insensitive(evaluate(toy, "toy.claim_count")) == ["deaf", "verdict on deaf"]
