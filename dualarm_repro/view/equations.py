"""Sympy results as displayed equations of a notebook page."""

from __future__ import annotations

from collections.abc import Mapping

import sympy as sp


class Equations:
    """Left-hand sides (LaTeX) and what they equal (sympy), aligned at the equals sign."""

    def __init__(self, sides: Mapping[str, sp.Basic | sp.MatrixBase]) -> None:
        self._sides = dict(sides)

    def _repr_latex_(self) -> str:
        lines = [f"{left} &= {latex(right)}" for left, right in self._sides.items()]
        body = r" \\[6pt] ".join(lines)
        return rf"$$\begin{{aligned}} {body} \end{{aligned}}$$"


def latex(expression: sp.Basic | sp.MatrixBase) -> str:
    r"""LaTeX in the shorthand of the field: c_{23} for cos(q_2 + q_3), 1.024 for 128/125."""
    short = {
        function: sp.Symbol(name)
        for function in expression.atoms(sp.sin, sp.cos)
        if (name := _shorthand(function))
    }
    expression = expression.xreplace(short)
    numbers = {number: _decimal(number) for number in expression.atoms(sp.Rational)}
    return sp.latex(expression.xreplace(numbers), mat_str="matrix", mat_delim="[")


def _shorthand(function: sp.Function) -> str | None:
    """``c_{23}`` when the argument is q_2 + q_3, None when it is anything else."""
    terms = sp.Add.make_args(function.args[0])
    indices = [term.name.removeprefix("q_") for term in terms if term.is_Symbol]
    if len(indices) < len(terms) or not all(index.isdigit() for index in indices):
        return None
    return f"{function.func.__name__[0]}_{{{''.join(sorted(indices))}}}"


def _decimal(number: sp.Rational) -> sp.Number:
    """A rational with a finite decimal expansion as that decimal; any other as it is."""
    text = f"{float(number):.12g}"
    if number.is_Integer or sp.Rational(text) != number:
        return number
    return sp.Float(text, len(text.lstrip("-0.").replace(".", "")))
