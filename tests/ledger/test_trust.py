"""Checkers that cannot fail are found, and honest ones are not; mutants are drawn and made."""

import ast
from dataclasses import replace

import pytest

from dualarm_repro.ledger import Bounded, Is, Result, Role, Rounds, evaluate, study
from dualarm_repro.ledger.formula import parse
from dualarm_repro.ledger.mutation import insensitive
from dualarm_repro.ledger.robustness import study_of
from dualarm_repro.ledger.trust import Tally, assumed, obtained, printed, tally
from dualarm_repro.ledger.trust.mutants import mutants, sample
from dualarm_repro.ledger.trust.nonsense import nonsense, other_cell, other_digit
from dualarm_repro.ledger.trust.report import report
from dualarm_repro.tracking import memo

from .toy import YAML, toy_registry

PRINTED = """  eq01:
    kind: equation
    place: "1"
    title: A circle
    printed: {formula: "A = p*r^2 + 0*r", matrix: [["r", "0"], ["0", "1"]], radius: "2.0"}
    needs: area
"""


@pytest.fixture
def toy(tmp_path, monkeypatch):
    monkeypatch.setattr(study, "data_path", lambda *parts: tmp_path.joinpath("data", *parts))
    return toy_registry(tmp_path, YAML + PRINTED)


@memo()
def _area(registry):
    text = registry.printed("toy.eq01")["formula"]
    return parse(text).value(1, {"p": 3.0, "r": 2.0})


def honest(registry, **options):
    """Judges formula, matrix and radius against values that are not read from print."""
    rules = [
        Rounds(key="radius", to="radius", label="radius", **options),
        Bounded(key="area", low=11.9, high=12.1, label="area"),
        Is(key="matrix", to="matrix", label="matrix"),
    ]

    @registry.checks("toy.eq01", rules, page="toy/page")
    def circle(assumed):
        matrix = [["r", "0"], ["0", "1"]]
        return Result(
            {"radius": 2.0, "area": float(_area(registry)), "matrix": matrix}, caption="c"
        )


@pytest.mark.parametrize("options", [{}, {"tolerance": 0.5, "reason": "drawn by hand"}])
def test_an_honest_checker_notices_every_change_of_print(toy, options):
    honest(toy, **options)
    found = printed(toy, "toy.eq01")
    # a power and a factor (the sign before a 0 says nothing), four cells, three digits and a radius
    assert (found.tried, found.violations, found.open) == (10, (), ())
    assert evaluate(toy, "toy.eq01").verdict == "reproduced"


def test_a_checker_that_ignores_print_is_caught(toy):
    @toy.checks("toy.eq01", [Bounded(key="area", high=13.0, label="area")], page="toy/page")
    def circle(assumed):
        return Result({"area": 12.0}, caption="c")

    found = printed(toy, "toy.eq01")
    assert found.tried == len(found.violations) == 6
    assert "toy.eq01: nothing judges radius 2.0" in found.open


def test_a_value_that_is_read_from_the_print_it_is_judged_by_is_caught(toy):
    @toy.checks("toy.eq01", [Rounds(key="r", to="radius", label="radius")], page="toy/page")
    def circle(assumed):
        return Result({"r": float(toy.printed("toy.eq01")["radius"])}, caption="c")

    assert "toy.eq01: radius: 2.0 -> 2.1" in printed(toy, "toy.eq01").violations


def test_a_rule_that_fails_holds_once_print_agrees(toy):
    @toy.checks("toy.eq01", [Rounds(key="r", to="radius", label="radius")], page="toy/page")
    def circle(assumed):
        return Result({"r": 2.7}, caption="c")

    found = printed(toy, "toy.eq01")
    assert not [line for line in found.violations if "radius" in line]
    toy.checkers["toy.eq01"] = replace(
        toy.checkers["toy.eq01"], compute=lambda assumed: Result({"r": None}, caption="c")
    )
    assert "toy.eq01: no print agrees with radius" in printed(toy, "toy.eq01").open


def test_another_print_lasts_as_long_as_its_context_and_no_memo_keeps_it(toy):
    assert _area(toy) == 12.0
    other = {**toy.printed("toy.eq01"), "formula": "A = p*r^3"}
    with toy.with_printed("toy.eq01", other):
        assert toy.item("toy.eq01").printed == other
        assert _area(toy) == 24.0
    assert _area(toy) == 12.0
    with pytest.raises(ZeroDivisionError), toy.with_printed("toy.eq01", other):
        raise ZeroDivisionError
    assert _area(toy) == 12.0


def test_an_assumption_that_moves_nothing_is_caught(toy):
    study_of(toy, "toy.claim_area").run()
    assert assumed(toy, "toy.claim_area").violations == ()
    checker = toy.checkers["toy.claim_area"]

    def deaf(assumed):
        return Result({"area": float(assumed["width"] + 0 * len(assumed["shape"]))}, caption="d")

    toy.checkers["toy.claim_area"] = replace(checker, compute=deaf)
    assert assumed(toy, "toy.claim_area").open  # another code, so that what is stored is stale
    study_of(toy, "toy.claim_area").run()
    found = assumed(toy, "toy.claim_area")
    assert found.violations == ("toy.claim_area: nothing judged moves with shape",)
    assert found.tried == 66


def test_what_is_not_stored_stays_open(toy):
    assert assumed(toy, "toy.claim_area") == Tally(open=("toy.claim_area: draws not stored",))
    assert assumed(toy, "toy.claim_count") == Tally()


def test_a_rule_that_cannot_fail_is_caught(toy):
    class Deaf(Bounded):
        def holds(self, evidence):
            return True

    honest(toy)
    assert obtained(toy, "toy.eq01") == Tally(6)
    rules = (Deaf(key="area", label="deaf", low=0.0),)
    toy.checkers["toy.eq01"] = replace(toy.checkers["toy.eq01"], rules=rules)
    assert "toy.eq01: deaf" in obtained(toy, "toy.eq01").violations
    assert tally(toy, "toy.fig01", "obtained") == Tally()


def test_what_a_contradiction_hides_is_tried_where_it_is_broken(toy):
    honest(toy)
    proof = Is(key="radius", value=2.0, role=Role.CONTRADICTS, label="proof")
    rules = (*toy.checkers["toy.eq01"].rules, proof)
    toy.checkers["toy.eq01"] = replace(toy.checkers["toy.eq01"], rules=rules)
    found = evaluate(toy, "toy.eq01")
    assert (found.verdict, insensitive(found)) == ("inconsistent-in-print", [])


@pytest.mark.parametrize(
    ("text", "others"),
    [
        ("U = k/2*(a - b)^2", ["U = k/2*(a + b)^2", "U = k/2*(a - b)^3", "U = 2*k/2*(a - b)^2"]),
        ("f(theta) = r", ["f(theta) = 2*r"]),
        ("max over c of M", ["2*max over c of M"]),
        ("S = sum_{i=1}^{5} U(i)", ["S = 2*sum_{i=1}^{5} U(i)"]),
    ],
)
def test_nonsense_parses_and_says_something_else(text, others):
    assert nonsense(text) == others


def test_other_numbers():
    assert [other_digit(t) for t in ("1.09", "-2", "3", "1.5e-3", "x")] == [
        "1.10", "-1", "4", "0.0016", None,
    ]  # fmt: skip
    assert other_digit("pi/2") != "pi/2"
    assert [other_cell(t) for t in ("0", "1", "cos(q)")] == ["1", "0", "0"]


SOURCE = '''"""Doc 3."""
K: int = 3
def f(x: "Array[4]", μ=1e-6):
    """Half of 2."""
    if x[0, 1] < 1.5 and μ == 2:
        raise ValueError(f"at most {7 + 1}")
    return "a" + str(x) if x else x[2 * K:] * (K + 0.0)
'''


def test_mutants_of_a_file(tmp_path):
    (tmp_path / "m.py").write_text(SOURCE, encoding="utf-8")
    found = [(m.line, m.old, m.new) for m in mutants(tmp_path, "m.py")]
    assert found == [
        (2, "3", "4"),
        (3, "1e-6", "0.001"),
        (5, "<", ">="),
        (5, "1.5", "3.0"),
        (5, "==", "!="),
        (5, "2", "3"),
        (7, "2", "3"),
        (7, "*", "/"),
        (7, "*", "/"),
        (7, "+", "-"),
        (7, "0.0", "0.01"),
    ]


def test_a_mutant_is_one_token_and_the_sample_is_that_of_its_seed(tmp_path):
    for name in ("a", "b"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "m.py").write_text(SOURCE, encoding="utf-8")
    drawn = sample(tmp_path, ["a", "b"], 4, seed=1)
    assert drawn == sample(tmp_path, ["a", "b"], 4, seed=1)
    assert drawn != sample(tmp_path, ["a", "b"], 4, seed=2)
    assert [m.file for m in drawn] == ["a/m.py"] * 4 + ["b/m.py"] * 4
    for mutant in drawn:
        changed = mutant.applied(SOURCE)
        ast.parse(changed)
        old, new = SOURCE.splitlines(), changed.splitlines()
        differing = [k for k in range(len(old)) if old[k] != new[k]]
        assert differing == [mutant.line - 1]
        start, end = mutant.column, mutant.column + len(mutant.old)
        row = old[mutant.line - 1]
        assert row[start:end] == mutant.old
        assert new[mutant.line - 1] == row[:start] + mutant.new + row[end:]


def test_report_counts_and_keeps_no_message():
    row = {"file": "f.py", "line": 1, "column": 4, "old": "1", "new": "2",
           "killed_by": None, "equivalent": None}  # fmt: skip
    rows = [
        row,
        row | {"killed_by": "item toy.x: /home/me"},
        row | {"killed_by": "time limit"},
        row | {"equivalent": "a buffer that is larger"},
    ]
    found = report({"printed": Tally(3, ("a: b",), ("c: d",))}, ["dualarm_repro/arms"], 1, rows)
    assert found["counts"] == {
        "printed": {"tried": 3, "killed": 2, "survived": 1, "open": 1},
        "method": {"tried": 3, "killed": 2, "survived": 1, "equivalent": 1, "ended_by_limit": 1},
    }
    assert found["mutants"][1]["killed_by"] == "item toy.x"
