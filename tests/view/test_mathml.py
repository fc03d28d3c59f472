"""Formulas as MathML: well-formed, worth what the text is worth, and read aloud as printed."""

import re
from fractions import Fraction
from html import unescape
from xml.etree import ElementTree

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from dualarm_repro.view.mathml import formula, is_formula, matrix, symbol

X, Y = Fraction(3, 7), Fraction(-2, 5)
_SIGNS = {"−": "-", "+": "+", "\u2062": "*", "(": "(", ")": ")"}


def tree(html):
    """The element, parsed as XML, which is stricter than a browser."""
    return ElementTree.fromstring(html.replace("&#160;", " "))


def body(html):
    return tree(html).find("semantics/mrow")


def text(html):
    return "".join(body(html).itertext())


def value(node):
    """An expression of Python that is worth what an element of MathML shows."""
    children = [value(child) for child in node]
    match node.tag:
        case "mn":
            return f"Fraction({node.text})"
        case "mi":
            return node.text
        case "mo":
            return _SIGNS[node.text]
        case "mfrac":
            return f"(({children[0]})/({children[1]}))"
        case "msup":
            return f"(({children[0]})**int({children[1]}))"
        case _:
            return f"({''.join(children)})"


def powers(base):
    return st.one_of(base, st.builds("{}^{}".format, base, st.integers(1, 3)))


def expressions():
    leaf = st.one_of(st.integers(1, 9).map(str), st.sampled_from("xy"))

    def larger(inner):
        factor = powers(st.one_of(leaf, inner.map("({})".format)))
        product = st.builds(
            lambda first, rest: first + "".join(sign + f for sign, f in rest),
            factor, st.lists(st.tuples(st.sampled_from("*/"), factor), max_size=3),
        )  # fmt: skip
        return st.builds(
            lambda minus, first, rest: minus + first + "".join(f" {s} {p}" for s, p in rest),
            st.sampled_from(["", "-"]), product,
            st.lists(st.tuples(st.sampled_from("+-"), product), max_size=2),
        )  # fmt: skip

    return st.recursive(leaf, larger, max_leaves=8)


@settings(max_examples=50)
@given(expressions())
def test_what_is_shown_is_worth_what_is_written(written):
    """Fractions, powers and products as laid out, against the arithmetic of Python."""
    plain = re.sub(r"\d+", lambda found: f"Fraction({found[0]})", written.replace("^", "**"))
    plain = re.sub(r"\*\*Fraction\((\d)\)", r"**\1", plain)
    names = {"Fraction": Fraction, "x": X, "y": Y, "int": int}
    try:
        expected = eval(plain, names)
    except ZeroDivisionError:
        assume(False)
    html = formula(written)
    assert eval(value(body(html)), names) == expected
    assert tree(html).find("semantics/annotation").text == written


@pytest.mark.parametrize(
    ("written", "shown"),
    [
        ("a + b - c", "a+b−c"),
        ("-a*b", "−a\u2062b"),
        ("2a b", "2\u2062a\u2062b"),
        ("d <= d_0", "d≤d0"),
        ("q in R^n", "q∈Rn"),
        ("theta_{gi} = 1.5", "θgi=1.5"),
        ("alpha_1 >= 0", "α1≥0"),
        ("|a - b|", "|a−b|"),
        ("||x||", "‖x‖"),
        ("f(x, y)", "f\u2061(x,y)"),
        ("d/d_{i-1}", "ddi−1"),
        ("J^T(q)", "JT(q)"),
        ("U^*", "U*"),
        ("x^{n+1}", "xn+1"),
        ("e^-x", "e−x"),
    ],
)
def test_signs_of_the_notation(written, shown):
    assert text(formula(written)) == shown
    assert not formula(written).startswith("<code>")


def test_parentheses_that_only_group_a_quotient_go_away():
    assert "(" not in text(formula("(a + b)/(c - d)"))
    assert text(formula("(a + b)*(c - d)")).count("(") == 2
    assert text(formula("f(a)/b")) == "f\u2061(a)b"


def test_roots_sums_and_dots():
    root = body(formula("sqrt(a^2 + b^2)")).find(".//msqrt")
    assert "".join(root.itertext()) == "a2+b2"
    total = body(formula("sum_{i=1}^n a_i")).find(".//munderover")
    assert ["".join(part.itertext()) for part in total] == ["∑", "i=1", "n"]
    dotted = body(formula("q_dot + 1")).find(".//mover")
    assert ["".join(part.itertext()) for part in dotted] == ["q", "˙"]
    indexed = body(formula("U_rep(i) + 1")).find(".//msub")
    assert ["".join(part.itertext()) for part in indexed] == ["U", "rep, i".replace(", ", ",")]


def test_cases_have_a_row_for_each_condition():
    html = formula("U = k*d^2 if d <= d_0, 0 if d > d_0")
    rows = body(html).findall(".//mtable/mtr")
    told = [["".join(cell.itertext()) for cell in row] for row in rows]
    assert told == [["k\u2062d2", "if d≤d0"], ["0", "if d>d0"]]
    assert text(html).startswith("U=")


def test_long_names_are_upright_and_letters_slanted():
    names = {
        node.text: node.get("mathvariant") for node in body(formula("det(J) + q + rank")).iter("mi")
    }
    assert names == {"det": "normal", "J": None, "q": None, "rank": "normal"}


def test_a_letter_with_a_number_has_an_index():
    low = body(formula("q1 + q2")).findall(".//msub")
    assert ["".join(node.itertext()) for node in low] == ["q1", "q2"]


@pytest.mark.parametrize(
    "wrong", ["a +", "(a", "a)", "= b", "a ** b", "a # b", "a, b", "|a", "if a"]
)
def test_what_is_no_formula_is_left_as_code(wrong):
    assert formula(wrong) == f"<code>{wrong}</code>"
    assert not is_formula(f"{wrong} =")


@pytest.mark.parametrize(
    ("line", "is_one"),
    [("a = b", True), ("q in R^6", True), ("a/b", True), ("plain words", False), ("theta", False),
     ("the value = is in words of many letters", False), ("a = (b", False)],
)  # fmt: skip
def test_formulas_are_told_from_words(line, is_one):
    assert is_formula(line) is is_one


def test_a_symbol_keeps_its_quotient_on_the_line():
    assert text(symbol("d_i/mm")) == "di/mm"
    assert body(symbol("a/b")).find(".//mfrac") is None
    assert body(formula("a/b")).find(".//mfrac") is not None
    assert "display" not in tree(symbol("a")).attrib
    assert tree(formula("a")).get("display") == "block"


def test_a_matrix_keeps_its_rows():
    html = matrix([["c_1", "-s_1", "0"], ["s_1", "c_1", "a/2"]])
    rows = tree(html).findall(".//mtable/mtr")
    assert [len(row) for row in rows] == [3, 3]
    assert "".join(rows[0][1].itertext()) == "−s1"
    assert rows[1][2].find(".//mfrac") is not None
    assert tree(html).find("semantics/annotation").text == "c_1, -s_1, 0; s_1, c_1, a/2"


def test_the_annotation_escapes_what_html_would_read():
    html = formula("a < b")
    assert '<annotation encoding="text/plain">a &lt; b</annotation>' in html
    assert unescape("&lt;") in text(html)
