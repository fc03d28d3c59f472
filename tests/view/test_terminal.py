"""Records on a terminal and in a pipe: all of print, beside what is obtained."""

import io

import pytest
from rich.console import Console

from dualarm_repro.ledger import record
from dualarm_repro.ledger.printed import leaves
from dualarm_repro.papers import load
from dualarm_repro.view.printed_beside import check_rows, in_words, printed_rows
from dualarm_repro.view.terminal import describe, verdict_style
from dualarm_repro.view.terminal_panels import panels

from .full_record import FULL

RECORD = {**FULL, "printed": {"a": "0.50"}, "unit": "m", "obtained": {"a": 0.5}, "caption": "<c>",
          "page": "toy/page", "draws": "none"}  # fmt: skip


def drawn(made, width=4000):
    stream = io.StringIO()
    Console(file=stream, width=width).print(panels(made))
    return stream.getvalue()


def test_every_printed_leaf_stands_in_the_lines_and_in_the_panels(registry):
    for item_id, item in registry.items.items():
        if item.printed is None:
            continue
        made = {**RECORD, "id": item_id, "printed": item.printed, "obtained": None, "checks": []}
        lines, panel = "\n".join(describe(made)), drawn(made)
        for path, leaf in leaves(item.printed):
            assert leaf in lines, (item_id, path)
            assert " ".join(leaf.split()) in " ".join(panel.split()), (item_id, path)


def test_print_stands_beside_what_is_obtained_under_the_same_name():
    made = {
        "printed": {
            "a": ["0.5", "1"],
            "deep": {"low_end": "2"},
            "rows": [["1", "2"], ["3"]],
            "n": "7",
        },
        "obtained": {"a": [0.5, 1.25], "deep": {"low_end": 2.0000001}, "rows": [[1, 2]], "n": True},
    }
    assert [row[:3] for row in printed_rows(made)] == [
        ("a", "0.5, 1", "0.5, 1.25"),
        ("deep, low end", "2", "2"),
        ("rows, 1", "1, 2", "1, 2"),
        ("rows, 2", "3", ""),
        ("n", "7", "yes"),
    ]
    assert printed_rows({"printed": "0.5", "obtained": None}) == [("value", "0.5", "", "")]
    assert printed_rows({"printed": None, "obtained": {}}) == []


def test_no_true_and_false_in_the_checks():
    check = {"label": "agrees", "expected": "False", "obtained": True, "outcome": "fails"}
    assert check_rows({"checks": [check]}) == [("agrees", "no", "yes", "fails")]


def test_nothing_is_markup_and_nothing_leaves_the_width(registry):
    made = {**RECORD, "title": "[red]no markup[/red] [1]", "caption": "see [12] and [bold]x"}
    assert "[red]no markup[/red] [1]" in drawn(made)
    assert "see [12] and [bold]x" in drawn(made)
    assert max(map(len, drawn(made, 60).splitlines())) <= 60


@pytest.mark.parametrize("item_id", ["xue.tab01", "xue.tab02", "qiu.tab02"])
def test_a_real_record_can_be_drawn(item_id):
    made = record(load(), item_id)
    text = drawn(made, 90)
    assert made["verdict"] in text
    assert f"dualarm run {item_id}" in text
    assert verdict_style(made["verdict"]) != "dim"


def test_names_pair_in_any_order_and_words_where_none_does():
    made = {
        "id": "toy.x",
        "pending": None,
        "kind": "table",
        "caption": None,
        "printed": {"old": {"trapped": "8", "mean_time": "0.41"}},
        "obtained": {"trapped": {"old": 7}},
        "checks": [],
    }
    assert [row.obtained for row in printed_rows(made)] == ["7", ""]
    assert in_words(made) is None  # no rule, nothing to say
    check = {"label": "runs held", "role": "supports", "expected": "printed 8", "obtained": 7,
             "outcome": "fails"}  # fmt: skip
    assert "7" in in_words({**made, "checks": [check]})
    both = {**made, "obtained": {"trapped": {"old": 7}, "mean_time": {"old": 2}}, "checks": [check]}
    assert in_words(both) is None


def test_table_2_has_something_beside_every_printed_value():
    made = record(load(), "xue.tab02")
    rows = {row.what: row.obtained for row in printed_rows(made)}
    assert all(rows.values())
    for method, count in made["obtained"]["missed"].items():
        assert rows[f"{method}, trapped"].startswith(f"{count} ")


@pytest.mark.parametrize("show", [lambda made: "\n".join(describe(made)), drawn])
def test_both_forms_show_the_words(show):
    made = {**RECORD, "printed": {"other": "0.50"}}
    assert "in words" in show(made)
    assert "in words" not in show(RECORD)
