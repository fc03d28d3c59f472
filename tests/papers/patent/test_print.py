"""What is printed decides: another formula, order or number changes the verdict."""

from dataclasses import replace

import pytest

from dualarm_repro.ledger import REGISTRY, Verdict, evaluate
from dualarm_repro.ledger.formula import parse
from dualarm_repro.ledger.verdict import decide
from dualarm_repro.papers import load

load()
FORMULAS = [
    name
    for name, item in REGISTRY.items.items()
    if name.startswith("patent.") and isinstance(item.printed, dict) and "formula" in item.printed
]


def with_printed(monkeypatch, item_id, printed):
    """Verdict on the item if the document printed something else."""
    real = REGISTRY.printed
    monkeypatch.setattr(
        REGISTRY, "printed", lambda name: printed if name == item_id else real(name)
    )
    evaluation = evaluate(REGISTRY, item_id)
    evidence = replace(evaluation.evidence, printed=printed)
    return decide(evaluation.checker.rules, evidence, assumed=bool(evaluation.item.assumptions))


def test_there_are_printed_formulas():
    assert {"patent.eq_forward", "patent.eq_matrix", "patent.eq_error"} <= set(FORMULAS)


@pytest.mark.parametrize(
    ("item_id", "formula"),
    [
        ("patent.eq_forward", "f(theta) = 2 r"),
        ("patent.eq_forward", "f(theta) = -r"),
        ("patent.eq_matrix", "E y = 2 e"),
        ("patent.eq_matrix", "E y = E y"),
        ("patent.eq_matrix", "E e = y"),
        ("patent.eq_error", "xi(t) = E y + e"),
        ("patent.eq_error", "xi(t) = 1.1 E y - e"),
    ],
)
def test_another_formula_is_not_reproduced(monkeypatch, item_id, formula):
    assert evaluate(REGISTRY, item_id).verdict is Verdict.REPRODUCED
    parse(formula)
    assert with_printed(monkeypatch, item_id, {"formula": formula}) is Verdict.NOT_REPRODUCED


def test_another_order_of_the_steps_is_not_that_of_a_run(monkeypatch):
    printed = REGISTRY.printed("patent.fig01")
    first, second = printed["steps"]
    swapped = {**printed, "steps": [first[::-1], second]}
    assert with_printed(monkeypatch, "patent.fig01", swapped) is Verdict.NOT_REPRODUCED


def test_a_step_more_in_print_is_one_that_is_not_run(monkeypatch):
    printed = REGISTRY.printed("patent.fig01")
    more = {**printed, "steps": [printed["steps"][0], [*printed["steps"][1], "rest"]]}
    real = REGISTRY.printed
    monkeypatch.setattr(
        REGISTRY, "printed", lambda name: more if name == "patent.fig01" else real(name)
    )
    assert evaluate(REGISTRY, "patent.fig03").verdict is Verdict.NOT_REPRODUCED


@pytest.mark.parametrize(
    ("key", "value"), [("method", "1-7"), ("claims", "11"), ("device", "8"), ("medium", "9")]
)
def test_other_numbers_of_claims_do_not_fit_the_steps(monkeypatch, key, value):
    printed = {**REGISTRY.printed("patent.claim_claims10"), key: value}
    verdict = with_printed(monkeypatch, "patent.claim_claims10", printed)
    assert verdict is Verdict.NOT_REPRODUCED


@pytest.mark.parametrize(
    "item_id",
    [n for n, i in REGISTRY.items.items() if n.startswith("patent.") and "formula" in i.missing],
)
def test_every_lost_formula_is_regenerated(item_id):
    assert evaluate(REGISTRY, item_id).verdict is Verdict.REGENERATED
