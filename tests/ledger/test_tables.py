"""Tables of the ledger, statements of the book, tallies, and proofs that formulas are compared."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualarm_repro.errors import DataFileError
from dualarm_repro.ledger import Generally, Result, evaluate, witnesses
from dualarm_repro.ledger.comparison import Comparison, is_number
from dualarm_repro.ledger.export import data_table
from dualarm_repro.ledger.formula import parse
from dualarm_repro.ledger.headlines import Statement, headlines, pointer_part, rounded, statements
from dualarm_repro.ledger.influence import first_order
from dualarm_repro.ledger.ledger_table import ledger_table
from dualarm_repro.ledger.meaning import MEANING
from dualarm_repro.ledger.trust.counts import Tally
from dualarm_repro.ledger.trust.nonsense import agreeing, moved, nonsense, other_cell, other_digit
from dualarm_repro.ledger.verdict import Verdict

from .toy import toy_registry


def test_a_record_is_a_row_and_what_it_lacks_is_empty():
    full = {
        "id": "toy.a", "title": "A", "verdict": "reproduced", "printed": {"n": "3"},
        "obtained": {"n": [1, 2.5]}, "assumptions": [{"id": "w"}, {"id": "s"}],
        "missing": ["a file"], "robustness": {"holds": 0.5, "interval": [0.4, 0.6], "samples": 64},
    }  # fmt: skip
    table = ledger_table([full, {"id": "toy.b"}])
    assert table["id"].tolist() == ["toy.a", "toy.b"]
    first, second = table.iloc[0], table.iloc[1]
    assert first["printed"] == '{"n": "3"}'
    assert first["obtained"] == '{"n": [1, 2.5]}'
    assert first["assumptions"] == "w\ns"
    assert first["missing"] == "a file"
    assert (first["holds"], first["holds_low"], first["holds_high"]) == (0.5, 0.4, 0.6)
    assert first["samples"] == 64
    assert second.drop("id").isna().all()
    assert str(table["samples"].dtype) == "Int64"


def test_no_record_is_a_table_of_no_rows_with_all_columns():
    empty = ledger_table([])
    assert len(empty) == 0
    assert list(empty.columns) == list(ledger_table([{"id": "toy.b"}]).columns)


@pytest.mark.parametrize(
    ("value", "digits", "text"),
    [
        (0.123456, 4, "0.1235"),
        (1234.5678, 3, "1230"),
        (-0.0009996, 3, "-0.00100"),
        (2.0, 4, "2.000"),
        (17, 1, "17"),
        (1e-7, 2, "0.00000010"),
        (9.99, 2, "10"),
    ],
)
def test_numbers_are_stated_with_their_significant_digits(value, digits, text):
    assert rounded(value, digits) == text


@settings(max_examples=40)
@given(value=st.floats(1e-6, 1e6), digits=st.integers(1, 6))
def test_what_is_stated_is_within_half_a_unit_of_its_last_digit(value, digits):
    stated = float(rounded(value, digits))
    assert abs(stated - value) <= 0.5 * 10 ** (np.floor(np.log10(value)) - digits + 1) * (1 + 1e-9)


def test_pointers_escape_what_means_something_in_them():
    assert pointer_part("a/b~c") == "a~1b~0c"
    assert Statement("t", "toy.a", ("x/y", 3), "1").pointer == "/x~1y/3"


HEADLINE = "headlines:\n  - {text: t, item: xue.tab01, path: [a], digits: 4}\n"


@pytest.mark.parametrize(
    ("old", "new", "field"),
    [
        ("text: t, ", "", "headlines.0.text"),
        ("path: [a]", "path: []", "headlines.0.path"),
        ("digits: 4", "digits: 7", "headlines.0.digits"),
        ("digits: 4", "number: 4", "headlines.0.number"),
        (HEADLINE, "headlines: []\n", "headlines"),
    ],
)
def test_a_malformed_headline_is_named(tmp_path, old, new, field):
    path = tmp_path / "headlines.yaml"
    path.write_text(HEADLINE)
    assert headlines(path)[0].digits == 4
    path.write_text(HEADLINE.replace(old, new))
    with pytest.raises(DataFileError, match=field):
        headlines(path)


@pytest.mark.parametrize("item", ["xue.tab01", "xue.nothing"])
def test_a_headline_leads_to_a_number_of_the_reference_results(tmp_path, item):
    path = tmp_path / "headlines.yaml"
    path.write_text(HEADLINE.replace("xue.tab01", item).replace("[a]", "[no_such_value]"))
    with pytest.raises(DataFileError, match=rf"headlines\.0 = '{item}: no_such_value'.*a number"):
        statements(path)


def test_every_verdict_has_a_meaning_in_a_sentence_of_its_own():
    assert set(MEANING) == set(Verdict)
    assert len(set(MEANING.values())) == len(Verdict)
    passed = {verdict for verdict in Verdict if verdict.meets_print}
    assert {Verdict.UNDECIDABLE, Verdict.NOT_ATTEMPTED, Verdict.INCONSISTENT}.isdisjoint(passed)
    assert {Verdict.REPRODUCED, Verdict.ADOPTED, Verdict.REGENERATED} <= passed


def test_obtained_values_are_a_table_unless_the_result_has_its_own(tmp_path):
    toy = toy_registry(tmp_path)
    evaluation = evaluate(toy, "toy.claim_area")
    table = data_table(evaluation, {"obtained": {"a": {"b": [1, 2]}, "c": "x"}})
    assert table.to_numpy().tolist() == [["a.b.0", 1], ["a.b.1", 2], ["c", "x"]]
    own = pd.DataFrame({"x": [1.0]})
    checker = toy.checkers["toy.claim_area"]
    made = type(checker)(
        lambda assumed: Result({"area": assumed["width"]}, caption="c", table=own),
        checker.rules,
        checker.page,
    )
    toy._checkers["toy.claim_area"] = made
    assert data_table(evaluate(toy, "toy.claim_area"), {"obtained": {}}) is own


def test_a_figure_needs_words_for_who_cannot_see_it():
    with pytest.raises(ValueError, match="alt text"):
        Result({}, caption="c", figure=lambda: None)


@pytest.mark.parametrize(
    ("path", "leaf", "covered"),
    [
        ("rows.*.slope", ("rows", 3, "slope"), True),
        ("rows.*.slope", ("rows", 3, "slope", "x"), True),
        ("rows.*.slope", ("rows", "slope"), False),
        ("row*.1", ("rows", 1), True),
        ("rows.1", ("rows", 10), False),
        ("*", ("anything",), True),
    ],
)
def test_paths_cover_what_is_below_them(path, leaf, covered):
    assert Comparison(path, "reason").covers(leaf) is covered


def test_only_numbers_are_compared_by_size():
    way = Comparison("a", "spread", relative=0.1, absolute=0.5)
    assert way.same(10.0, 10.9)
    assert way.same(0.0, 0.4)
    assert not way.same(10.0, 12.0)
    assert not way.same(True, 1)
    assert not way.same("1", "1")
    assert way.how == "within 0.1 relative (spread)"
    assert Comparison("a", "r", absolute=1e-6).how == "within 1e-06 (r)"
    assert [is_number(v) for v in (1, 1.5, True, None, "1")] == [True, True, False, False, False]


def test_influence_needs_more_than_chance_and_bins_that_are_even():
    rng = np.random.default_rng(3)
    values = rng.uniform(size=400)
    half = (values < 0.5) & (rng.random(400) < 0.9)
    strong = first_order(values.tolist(), half.tolist(), 1)
    assert 0.3 < strong < 0.95
    shuffled = rng.permutation(half)
    found = first_order(values.tolist(), shuffled.tolist(), 1)
    assert found is None or found < 0.1 * strong
    # Monotone maps of the values leave the bins as they are.
    assert first_order(np.exp(9 * values).tolist(), half.tolist(), 1) == pytest.approx(strong)


def test_tallies_add_up():
    one = Tally.of([("a", True), ("b", False)], ["c"])
    assert (one.tried, one.killed, one.violations, one.open) == (2, 1, ("b",), ("c",))
    both = one + Tally.of([("d", False)])
    assert (both.tried, both.killed, both.violations) == (3, 1, ("b", "d"))
    assert both.open == ("c",)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a + b = c", ["a - b = c", "a + b = 2*c"]),
        ("J^2*x", ["J^3*x"]),
        ("x", ["2*x"]),
    ],
)
def test_nonsense_swaps_signs_raises_powers_and_doubles_sides(text, expected):
    assert nonsense(text) == expected
    for other in nonsense(text):
        assert parse(other).sides != parse(text).sides


@pytest.mark.parametrize(
    ("text", "digit", "cell"),
    [("0", "1", "1"), ("0.120", "0.121", "0"), ("-1.5e-3", "-0.0014", "0"), ("s1", None, "0")],
)
def test_other_digits_and_cells(text, digit, cell):
    assert other_digit(text) == digit
    assert other_cell(text) == cell


def test_prints_that_agree_or_are_moved():
    assert [agreeing(v) for v in (0.1, 3, "left", float("nan"), None, "")] == [
        "0.1", "3", "left", None, None, None
    ]  # fmt: skip
    assert float(moved("1.50", 0.25)) == 1.75
    assert float(other_digit("pi/2")) == pytest.approx(0.75 * np.pi)


@pytest.mark.parametrize(
    ("count", "choices"),
    [
        ((9, 10), ["cell 4", "cell 9"]),  # the statement is open: one cell for each side
        ((100, 100), []),
        ((1, 10), []),
    ],
)
def test_cells_are_witnesses_only_of_what_they_leave_open(tmp_path, monkeypatch, count, choices):
    toy = toy_registry(tmp_path)
    checker = toy.checkers["toy.claim_count"]
    rules = (Generally("share", "most", at_least=0.9, margin=0.1),)
    toy._checkers["toy.claim_count"] = replace(checker, rules=rules)
    monkeypatch.setattr(witnesses, "REGISTRY", toy)
    table = pd.DataFrame({"k": [1, 2, 3], "x": [0.5, 1.5, 2.5]}, index=[4, 7, 9])
    holds = pd.Series([True, True, False], index=table.index)
    obtained = {"share": dict(zip(("count", "of"), count, strict=True))}
    found = witnesses.cell_witnesses("toy.claim_count", obtained, table, holds, ["k"])
    assert [one["choice"] for one in found] == choices
    if choices:
        assert [one["values"] for one in found] == [{"k": 1}, {"k": 3}]
        assert [one["verdict"] for one in found] == ["holds", "fails"]
        assert not isinstance(found[0]["values"]["k"], np.generic)
