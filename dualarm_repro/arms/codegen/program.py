"""Straight-line programs: sums and products without loops, in which no value is computed twice.

A product by 0, 1 or -1 and a sum with 0 leave no statement, a value that is asked for again is
the one there is (value numbering; J. Cocke and J. T. Schwartz, Programming Languages and Their
Compilers, 1970). Nothing is reassociated, so that every sum is rounded in the order it was
written.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from typing import NamedTuple


class Term(NamedTuple):
    """A value of a program with its sign: 0, 1 or -1 (no name) or a name, or minus a name."""

    sign: int
    name: str = ""

    def __neg__(self) -> Term:
        return Term(-self.sign, self.name)

    @property
    def size(self) -> str:
        """Without its sign, as an expression of Python."""
        return self.name or f"{abs(self.sign)}.0"

    @property
    def text(self) -> str:
        """As an expression of Python."""
        return f"-{self.size}" if self.sign < 0 else self.size


ZERO, ONE = Term(0), Term(1)
Vector = tuple[Term, ...]


class Program:
    """The statements of a straight-line program in the order in which they are computed.

    Attributes
    ----------
    statements : dict
        By name of the value its operation (``*``, ``+``, ``-`` or a function) and its operands.
    """

    def __init__(self) -> None:
        self.statements: dict[str, tuple[str, tuple[str, ...]]] = {}
        self._known: dict[tuple[str, ...], str] = {}

    def times(self, a: Term, b: Term) -> Term:
        """a b."""
        sign = a.sign * b.sign
        if not sign:
            return ZERO
        if not (a.name and b.name):
            return Term(sign, a.name or b.name)
        return Term(sign, self._value("*", *sorted((a.name, b.name))))

    def plus(self, a: Term, b: Term) -> Term:
        """a + b."""
        if not (a.sign and b.sign):
            return a if a.sign else b
        if a.name == b.name and a.sign == -b.sign:
            return ZERO
        if not (a.name or b.name):
            return Term(a.sign, "2.0")
        if a.sign == b.sign:
            return Term(a.sign, self._value("+", *sorted((a.size, b.size))))
        plus, minus = (x.size for x in ((a, b) if a.sign > 0 else (b, a)))
        if ("-", minus, plus) in self._known:
            return Term(-1, self._value("-", minus, plus))
        return Term(1, self._value("-", plus, minus))

    def inner(self, a: Sequence[Term], b: Sequence[Term]) -> Term:
        """a . b, summed from the first product on."""
        total = ZERO
        for x, y in zip(a, b, strict=True):
            total = self.plus(total, self.times(x, y))
        return total

    def cross(self, a: Sequence[Term], b: Sequence[Term]) -> Vector:
        """a x b."""
        return tuple(
            self.plus(self.times(a[i], b[j]), -self.times(a[j], b[i]))
            for i, j in ((1, 2), (2, 0), (0, 1))
        )

    def function(self, name: str, a: Term) -> Term:
        """name(a)."""
        return Term(1, self._value(name, a.text))

    def needed(self, results: Iterable[Term]) -> dict[str, tuple[str, tuple[str, ...]]]:
        """The statements that the results depend on, in order."""
        wanted = {term.name for term in results}
        for name in reversed(self.statements):
            if name in wanted:
                wanted.update(self.statements[name][1])
        return {name: made for name, made in self.statements.items() if name in wanted}

    def names(self, results: Sequence[Term]) -> set[str]:
        """Names of all that the results depend on, and their own."""
        found = {operand for _, made in self.needed(results).values() for operand in made}
        return found | {term.name for term in results}

    def lines(self, results: Sequence[Term]) -> tuple[list[str], list[str]]:
        """The needed statements as lines of Python, and the results as expressions.

        A product that is used once stands in the line that uses it.
        """
        needed = self.needed(results)
        uses = Counter(operand for _, operands in needed.values() for operand in operands)
        given = {term.name for term in results}
        inlined: dict[str, str] = {}
        lines = []
        for name, (operation, operands) in needed.items():
            texts = [inlined.get(operand, operand) for operand in operands]
            if operation == "*":
                text = " * ".join(f"({one})" if "*" in one else one for one in texts)
            elif operation in "+-":
                text = f" {operation} ".join(texts)
            else:
                text = f"{operation}({texts[0]})"
            if operation == "*" and uses[name] == 1 and name not in given:
                inlined[name] = text
            else:
                lines.append(f"{name} = {text}")
        return lines, [term.text for term in results]

    def _value(self, *key: str) -> str:
        if key not in self._known:
            self._known[key] = name = f"t{len(self._known)}"
            self.statements[name] = (key[0], key[1:])
        return self._known[key]
