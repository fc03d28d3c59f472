"""Rules and lines of a card in words: no raw truth values, few digits, units where they belong."""

import pytest
import yaml

from dualarm_repro.errors import LedgerError
from dualarm_repro.ledger import record
from dualarm_repro.ledger.printed import leaves
from dualarm_repro.view import lines
from dualarm_repro.view.numbers import beside, number, words
from dualarm_repro.view.rule_sentences import rule_sentence, split_unit
from dualarm_repro.view.wording import obtained_line, printed_line, summary_lines, verdict_line

from .full_record import FULL, ROBUST


def check(label, expected, obtained, role="supports", outcome="holds"):
    return {"label": label, "role": role, "expected": expected, "obtained": obtained,
            "holds": outcome == "holds", "outcome": outcome}  # fmt: skip


@pytest.mark.parametrize(
    ("value", "text"),
    [(0.0, "0"), (0.0251234, "0.0251"), (1250.4, "1250"), (6.66e-16, "6.7 × 10⁻¹⁶"), (1e-9, "10⁻⁹"),
     (7, "7"), (-0.5, "-0.5"), (float("inf"), "infinite"), (0.99996, "1"), (2.5e7, "2.5 × 10⁷")],
)  # fmt: skip
def test_numbers_have_few_digits(value, text):
    assert number(value) == text


@pytest.mark.parametrize(
    ("value", "text"),
    [(True, "yes"), (None, "none"), ("sum_over_bars", "sum over bars"), ([1.0, 1e-17], "(1, 0)"),
     ({"count": 3, "of": 4}, "3 of 4 (75 %)"), ([-1.23456, 3.1], "(-1.235, 3.1)"),
     ({"value": 0.5, "low": 0.25, "high": 0.75}, "0.5 (95 % interval 0.25 to 0.75)")],
)  # fmt: skip
def test_values_in_words(value, text):
    assert words(value) == text


def test_a_value_beside_print_has_one_digit_more():
    assert beside(0.41049, "0.41") == "0.410"
    assert beside(8, "8") == "8"


@pytest.mark.parametrize(
    ("made", "sentence"),
    [
        (check("every point is reached", "True", True), "Every point is reached: yes."),
        (check("every point is reached", "True", False, outcome="fails"),
         "Every point is reached: no, not yes."),
        (check("both sides are equal", "False", False, "contradicts"),
         "Both sides are equal: no, by which print contradicts itself."),
        (check("the tip misses by [m]", "at most 1e-09", 4.4e-16),
         "The tip misses by zero up to round-off (4.4 × 10⁻¹⁶ m); at most 10⁻⁹ m is allowed."),
        (check("runs that fail", "at most 0", 0), "Runs that fail: none."),
        (check("runs that fail", "at most 0", 3, outcome="fails"),
         "Runs that fail: 3; none is allowed."),
        (check("gap [m]", "at least 0.01", 0.5), "Gap: 0.5 m; at least 0.01 m is needed."),
        (check("time", "printed 0.41", 0.5301, outcome="fails"), "Time: 0.530; print has 0.41."),
        (check("share", "at least 0.9 of the population; fails below 0.1, else open",
               {"count": 1, "of": 2}, outcome="open"),
         "Share: 1 of 2 (50 %); at least 90 % of all cases is needed, and below 10 % it fails."),
        (check("the drawing", "the drawing: no original in the source at hand", None),
         "There is no original to compare with: the drawing."),
    ],
)  # fmt: skip
def test_rules_are_sentences(made, sentence):
    assert rule_sentence(made) == sentence


def test_a_unit_leaves_the_label():
    assert split_unit("earlier by [s], at least one step") == ("earlier by, at least one step", "s")
    assert split_unit("J = [[I, r]]") == ("J = [[I, r]]", "")


@pytest.mark.parametrize("item_id", ["xue.tab01", "xue.eq01", "qiu.claim_bases", "xue.fig02"])
def test_no_raw_truth_values_and_keys(registry, item_id):
    made = record(registry, item_id)
    told = " ".join([*summary_lines(made).values(), *map(rule_sentence, made["checks"])])
    for raw in ("True", "False", "true", "false", "None", "{", "['"):
        assert raw not in told, told


def test_the_worded_lines_name_items_and_values(registry):
    worded = yaml.safe_load(lines._FILE.read_text(encoding="utf-8"))
    assert set(worded) <= set(registry.items)
    for item_id, texts in worded.items():
        assert set(texts) <= {"printed", "obtained", "beside"}
        ways = {
            ".".join(map(str, path)) for path, _ in leaves(registry.item(item_id).printed or {})
        }
        assert set(texts.get("beside", {})) <= ways
        made = {"id": item_id, "printed": registry.item(item_id).printed, "obtained": None,
                "robustness": None, "checks": []}  # fmt: skip
        assert ("printed" in texts) == (lines.line(made, "printed") is not None)


def test_a_worded_line_is_filled_from_the_record(registry, monkeypatch):
    made = record(registry, "xue.tab01")
    texts = {"printed": "{{ printed.d[3] }} m", "obtained": "{{ obtained.goal_distance | number }}"}
    monkeypatch.setattr(lines, "_worded", lambda: {"xue.tab01": texts})
    assert printed_line(made) == "1.225 m"
    assert obtained_line(made) == "0.611"
    monkeypatch.setattr(lines, "_worded", lambda: {"xue.tab01": {"obtained": "{{ obtained.no }}"}})
    with pytest.raises(LedgerError, match=r"xue\.tab01"):
        obtained_line(made)


def test_a_line_without_a_number_needs_every_rule_to_hold(registry):
    made = record(registry, "xue.tab01")
    assert "one row too high" in obtained_line(made)
    failed = [{**made["checks"][0], "holds": False, "outcome": "fails"}, *made["checks"][1:]]
    assert "is that of matrices" in obtained_line({**made, "checks": failed})


def test_the_verdict_says_its_share():
    made = {**FULL, "robustness": ROBUST, "decided_by": None}
    assert verdict_line(made) == (
        "possible, by a stored witness; print is met in 5 % of 32 plausible choices of what is not "
        "printed (95 % interval 1 to 16 %)"
    )
    assert verdict_line({**made, "verdict": "reproduced", "robustness": None}) == "print is met"
    assert "by the statement toy.claim" in verdict_line({**made, "decided_by": "toy.claim"})
