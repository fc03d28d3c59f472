"""What is printed is shown whole, in the card and on a terminal, and every formula is typeset."""

import pytest
from bs4 import BeautifulSoup

from dualarm_repro.ledger import Registry
from dualarm_repro.ledger.printed import leaves
from dualarm_repro.view.mathml import formula, is_formula, matrix, symbol
from dualarm_repro.view.names import phrase
from dualarm_repro.view.printed_view import parts, printed_html, printed_lines, printed_words


def as_record(registry: Registry, item_id: str) -> dict:
    item = registry.item(item_id)
    return {"id": item_id, "printed": item.printed, "unit": item.unit, "kind": str(item.kind)}


def text_of(html: str) -> str:
    return " ".join(BeautifulSoup(html, "html.parser").get_text(" ").split())


def lacking(made: dict, shown: str) -> list[str]:
    return [leaf for _, leaf in leaves(made["printed"] or {}) if str(leaf) not in shown]


def test_every_printed_leaf_is_shown(registry):
    for item_id in registry.items:
        made = as_record(registry, item_id)
        assert lacking(made, text_of(printed_html(made))) == [], item_id
        assert lacking(made, "\n".join(printed_lines(made))) == [], item_id
        assert printed_words(made), item_id


def test_a_leaf_that_is_left_out_is_noticed(registry):
    made = as_record(registry, "xue.tab02")
    assert lacking(made, text_of(printed_html(made)).replace("0.53", "")) == ["0.53"]


@pytest.mark.parametrize("kind", ["figure", "equation", "table", "claim"])
def test_what_our_copy_lacks_is_called_that(kind):
    (part,) = parts({"printed": None, "unit": None, "kind": kind})
    assert part.kind == "lost"
    assert part.content in text_of(printed_html({"printed": None, "unit": None, "kind": kind}))


def test_print_has_its_own_form(registry):
    kinds = {
        item_id: [part.kind for part in parts(as_record(registry, item_id))]
        for item_id in ("xue.tab01", "xue.tab02", "xue.eq08", "pan.eq17", "xue.claim_mirror",
                        "qiu.claim_bases", "pan.fig11")
    }  # fmt: skip
    assert kinds == {
        "xue.tab01": ["table"], "xue.tab02": ["table"], "xue.eq08": ["formula", "matrix"],
        "pan.eq17": ["formula"], "xue.claim_mirror": ["words"],
        "qiu.claim_bases": ["values", "values"], "pan.fig11": ["list", "list", "list"],
    }  # fmt: skip


def test_a_printed_table_keeps_heads_and_rows(registry):
    soup = BeautifulSoup(printed_html(as_record(registry, "xue.tab02")), "html.parser")
    rows = [[cell.get_text() for cell in row(["th", "td"])] for row in soup("tr")]
    assert rows == [
        ["", "trials", "trapped", "mean time"],
        ["traditional", "10", "0", "0.53"],
        ["improved", "10", "8", "0.41"],
    ]


def test_units_stand_where_they_belong(registry):
    (joints, tip) = parts(as_record(registry, "qiu.claim_start"))
    assert joints.content == "(0, 0, 0, 0, 0, 0)"
    assert tip.content == "(0.350, 0.380, 0.620) m"


def typeset(html: str):
    return BeautifulSoup(html, "html.parser").math


def test_every_printed_formula_is_typeset(registry):
    for item_id, item in registry.items.items():
        printed = item.printed or {}
        texts = printed.get("formula", []) if isinstance(printed, dict) else []
        for text in [texts] if isinstance(texts, str) else texts:
            assert typeset(formula(text)), item_id


def test_quotients_take_what_is_beside_the_stroke():
    math = typeset(formula("F = k_r*(1/d - 1/d_0)*1/d^2*dd/dX"))
    for note in math("annotation"):
        note.extract()
    tops = [fraction.find_all(recursive=False)[0].get_text() for fraction in math("mfrac")]
    assert tops == ["1", "1", "1", "dd"]
    assert [m.get_text() for m in math("msup")] == ["d2"]


def test_notation_of_the_ledger_is_read():
    cases = typeset(formula("U = a if d <= d_0, 0 if d > d_0"))
    assert len(cases("mtr")) == 2
    assert "≤" in cases.get_text()
    total = typeset(formula("U^* = sum_{i=1}^{5} U_rep(i)"))
    assert [part.get_text() for part in total.munderover.find_all(recursive=False)] == [
        "∑", "i=1", "5"]  # fmt: skip
    assert typeset(formula("x_dot = J(q)*q_dot")).mover.get_text() == "x˙"
    assert "/" in typeset(symbol("-pi/2")).get_text()
    assert len(typeset(matrix([["1", "a_{i-1}"], ["0", "1"]]))("mtd")) == 4


def test_what_is_no_formula_stays_as_it_is():
    assert formula("a + (") == "<code>a + (</code>"
    assert symbol("<b>") == "<code>&lt;b&gt;</code>"
    assert not is_formula("theta* is the integral of the first n entries of y*")
    assert not is_formula("motion ends at total potential 0")


@pytest.mark.parametrize(
    ("key", "words"),
    [("mean_time", "mean time"), ("alpha0", "α₀"), ("base1", "base 1"), ("k_a", "k_a"),
     ("tcp", "tool centre point"), ("theta", "θ")],
)  # fmt: skip
def test_keys_become_words(key, words):
    assert phrase(key) == words
