r"""Printed formulas as MathML, which browsers typeset without a script.

The ledger holds a formula as one line in the notation of the document, see ``ledger/formula.py``:
``U_rep = k_r/2*(1/d - 1/d_0)^2 if d <= d_0, 0 if d > d_0``. Order and grouping stay as printed; a
quotient takes the factors right beside its stroke.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from html import escape

_TOKEN = re.compile(
    r"\s*(?:(?P<number>\d+(?:\.\d+)?)|(?P<name>[A-Za-z]\w*?(?:_dot)?(?:_\{[^}]*\})?(?:\((?:i|j|k)\))?"
    r"(?![\w{]))|(?P<sign>\|\||<=|>=|[-+*/^=<>(),|{}]))"
)
_GREEK = {
    "alpha": "α", "beta": "β", "gamma": "γ", "delta": "δ", "epsilon": "ε", "zeta": "ζ", "eta": "η",
    "theta": "θ", "kappa": "κ", "lambda": "λ", "mu": "μ", "xi": "ξ", "pi": "π", "rho": "ρ",
    "sigma": "σ", "tau": "τ", "phi": "φ", "omega": "ω", "grad": "∇",
}  # fmt: skip
_UPRIGHT = {"sin", "cos", "tan", "exp", "ln", "det", "min", "max", "Rank"}
_RELATIONS = {"=": "=", "<=": "≤", ">=": "≥", "<": "&lt;", ">": "&gt;", "in": "∈"}
_SUM = re.compile(r"\s*sum_\{(\w+)=(\w+)\}\^\{?(\w+)\}?")


def formula(text: str) -> str:
    """A formula as a displayed ``<math>`` element; what is no formula stays a line of code."""
    try:
        body = _Parser(text).whole()
    except ValueError:
        return f"<code>{escape(text)}</code>"
    return _math(body, text, display=True)


def symbol(name: str) -> str:
    """A name or value such as ``theta_{gi}``, ``-pi/2`` or ``d_i/mm`` inside a line of text."""
    try:
        return _math(_Parser(name, flat=True).whole(), name)
    except ValueError:
        return f"<code>{escape(name)}</code>"


def matrix(rows: Sequence[Sequence[str]]) -> str:
    """A printed matrix of formulas and numbers."""
    cells = "".join(
        "<mtr>" + "".join(f"<mtd>{_Parser(cell).whole()}</mtd>" for cell in row) + "</mtr>"
        for row in rows
    )
    text = "; ".join(", ".join(row) for row in rows)
    return _math(f'<mtable class="ledger-matrix">{cells}</mtable>', text, display=True)


def is_formula(text: str) -> bool:
    """Whether a text is a formula of the notation, and more than one word."""
    if not re.search(r"[=<>*/^]|\bin\b", text) or re.search(r"[a-z]{4,} [a-z]{2,} ", text):
        return False
    try:
        _Parser(text).whole()
    except ValueError:
        return False
    return True


def _math(body: str, text: str, display: bool = False) -> str:
    """The element, with the notation of the ledger for search and for readers without MathML."""
    how = ' display="block"' if display else ""
    return (
        f"<math{how}><semantics><mrow>{body}</mrow>"
        f'<annotation encoding="text/plain">{escape(text)}</annotation></semantics></math>'
    )


def _row(*parts: str) -> str:
    return f"<mrow>{''.join(parts)}</mrow>"


class _Parser:
    """Recursive descent over the tokens of one formula; ``flat`` keeps quotients on the line."""

    def __init__(self, text: str, flat: bool = False) -> None:
        self._flat = flat
        self._tokens: list[tuple[str, str]] = []
        place = 0
        text = text.strip()
        while place < len(text):
            if found := _SUM.match(text, place):
                self._tokens.append(("total", found[0]))
            elif not (found := _TOKEN.match(text, place)):
                raise ValueError(text)
            else:
                self._tokens.append((str(found.lastgroup), found[str(found.lastgroup)]))
            place = found.end()
        self._bars = 0

    def whole(self) -> str:
        """The formula, to its end.

        Raises
        ------
        ValueError
            The text is no formula.
        """
        found = self._relation()
        if self._is("if"):
            found = self._cases(found)
        if self._tokens:
            raise ValueError(self._tokens[0][1])
        return found

    def _is(self, *texts: str) -> bool:
        return bool(self._tokens) and self._tokens[0][1] in texts

    def _take(self, text: str | None = None) -> tuple[str, str]:
        if not self._tokens or (text is not None and self._tokens[0][1] != text):
            raise ValueError(text or "end")
        return self._tokens.pop(0)

    def _relation(self) -> str:
        parts = [self._sum()]
        while self._is(*_RELATIONS):
            sign = _RELATIONS[self._take()[1]]
            parts += [f"<mo>{sign}</mo>", self._sum()]
        return _row(*parts)

    def _cases(self, first: str) -> str:
        head, _, value = first.rpartition("<mo>=</mo>")
        head = f"{head}<mo>=</mo>" if head else "<mrow>"
        rows, value = [], f"<mrow>{value}"
        while True:
            self._take("if")
            rows.append((value, self._relation()))
            if not self._is(","):
                break
            self._take(",")
            value = self._sum()
        body = "".join(
            f"<mtr><mtd>{one}</mtd><mtd><mtext>if&#160;</mtext>{when}</mtd></mtr>"
            for one, when in rows
        )
        return f'{head}<mtable class="ledger-cases">{body}</mtable></mrow>'

    def _sum(self) -> str:
        parts = []
        if self._is("-"):
            self._take()
            parts.append("<mo>−</mo>")
        parts.append(self._product())
        while self._is("+", "-"):
            sign = self._take()[1].replace("-", "−")
            parts += [f"<mo>{sign}</mo>", self._product()]
        return _row(*parts)

    def _product(self) -> str:
        factors = [self._power()]
        while self._tokens:
            if self._is("/"):
                self._take()
                if self._flat:
                    factors.append(f"{factors.pop()}<mo>/</mo>{self._power()}")
                    continue
                factors.append(f"<mfrac>{_bare(factors.pop())}{_bare(self._power())}</mfrac>")
            elif self._is("*"):
                self._take()
                factors.append(self._power())
            elif self._starts_factor():
                factors.append(self._power())
            else:
                break
        return _row("<mo>&#8290;</mo>".join(factors))

    def _starts_factor(self) -> bool:
        kind, text = self._tokens[0]
        if kind == "name":
            return text not in ("if", "in")
        return (
            kind in ("number", "total") or text == "(" or (text in ("|", "||") and not self._bars)
        )

    def _power(self) -> str:
        base = self._atom()
        while self._is("^"):
            self._take()
            if self._is("*"):
                self._take()
                raised = "<mo>*</mo>"
            elif self._is("-"):
                self._take()
                raised = _row("<mo>−</mo>", self._atom())
            elif self._is("{"):
                self._take()
                raised = self._sum()
                self._take("}")
            else:
                raised = self._atom(plain=True)
            base = f"<msup>{base}{raised}</msup>"
            if self._is("(") and raised == "<mi>T</mi>":
                base = _row(base, self._arguments())
        return base

    def _atom(self, plain: bool = False) -> str:
        kind, text = self._take()
        if kind == "number":
            return f"<mn>{text}</mn>"
        if kind == "total":
            index, first, last = _SUM.fullmatch(text).groups()  # type: ignore[union-attr]
            low = _row(_name(index), "<mo>=</mo>", f"<mn>{first}</mn>")
            total = f"<munderover><mo>∑</mo>{low}<mn>{last}</mn></munderover>"
            return _row(total, self._product())
        if text == "(":
            inner = self._relation()
            self._take(")")
            return f'<mrow class="paren"><mo>(</mo>{inner}<mo>)</mo></mrow>'
        if text in ("|", "||"):
            self._bars += 1
            inner = self._sum()
            self._take(text)
            self._bars -= 1
            bar = "‖" if text == "||" else "|"
            return f"<mrow><mo>{bar}</mo>{inner}<mo>{bar}</mo></mrow>"
        if kind != "name" or text in ("if", "in"):
            raise ValueError(text)
        if text == "sqrt" and self._is("("):
            self._take("(")
            inner = self._sum()
            self._take(")")
            return f"<msqrt>{inner}</msqrt>"
        if self._is("(") and not plain:
            return _row(_name(text), "<mo>&#8289;</mo>", self._arguments())
        return _name(text)

    def _arguments(self) -> str:
        self._take("(")
        parts = [self._relation()]
        while self._is(","):
            self._take(",")
            parts.append(self._relation())
        self._take(")")
        return f"<mrow><mo>(</mo>{'<mo>,</mo>'.join(parts)}<mo>)</mo></mrow>"


def _bare(part: str) -> str:
    """Numerator or denominator without the parentheses that only group it."""
    start, end = '<mrow class="paren"><mo>(</mo>', "<mo>)</mo></mrow>"
    return part[len(start) : -len(end)] if part.startswith(start) else part


def _name(text: str) -> str:
    """A name with its subscript, its dot and Greek letters."""
    text, of, index = text.partition("(")
    text, dot, _ = text.partition("_dot")
    stem, _, below = text.partition("_")
    found = re.fullmatch(r"([A-Za-z]+)(\d+)", stem)
    if found and not below:
        stem, below = found[1], found[2]
    base = _letter(stem)
    if dot:
        base = f"<mover>{base}<mo>˙</mo></mover>"
    below = below.strip("{}") + (f", {index.rstrip(')')}" if of else "")
    return f"<msub>{base}<mrow>{_below(below)}</mrow></msub>" if below else base


def _below(text: str) -> str:
    parts = re.findall(r"\d+|[A-Za-z]+|[-+,]", text)
    made = [f"<mo>{p}</mo>".replace("-", "−") if p in "-+," else _letter(p, below=True)
            for p in parts]  # fmt: skip
    return "".join(made)


def _letter(text: str, below: bool = False) -> str:
    if text.isdigit():
        return f"<mn>{text}</mn>"
    if text in _GREEK:
        return f"<mi>{_GREEK[text]}</mi>"
    if re.fullmatch(r"d[dX]", text):  # a derivative
        return f"<mrow><mi>d</mi><mi>{text[1]}</mi></mrow>"
    upright = text in _UPRIGHT or len(text) > 3 or (below and len(text) > 2)
    return f'<mi mathvariant="normal">{text}</mi>' if upright else f"<mi>{text}</mi>"
