"""Printed formulas as sympy expressions, and their values for given numbers, vectors and matrices.

The ledger holds a formula as one line of text in the notation of the document: ``|X - X_g|^2``,
``J^T``, ``sum_{i=1}^{6} ...``, ``A if d <= d_0, 0 if d > d_0``, several sides joined by ``=``. It
is parsed from there, so that a slip in the ledger or in print is a slip in what the code is
compared with.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from tokenize import TokenError
from typing import Any

import numpy as np
import sympy as sp
from sympy.parsing.sympy_parser import parse_expr

from ..errors import DataFileError

_SUM = re.compile(r"sum_\{(\w+)=(\d+)\}\^\{?(\w+)\}?\s*")
_MALFORMED = (TokenError, SyntaxError, TypeError, ValueError, AttributeError)
_RELATION = re.compile(r"(?<![<>!=])=(?!=)")
_KNOWN: dict[str, Any] = {
    "norm": sp.Function("norm"),
    "det": sp.Function("det"),
    "transpose": sp.Function("transpose"),
    "grad": sp.Function("grad"),
    "cases": sp.Function("cases"),
    "at_most": sp.Function("at_most"),
    "below": sp.Function("below"),
    "sqrt": sp.sqrt,
    "sin": sp.sin,
    "cos": sp.cos,
    "exp": sp.exp,
    "ln": sp.log,
    "pi": sp.pi,
}
_NUMERIC: dict[str, Callable[..., Any]] = {
    "norm": np.linalg.norm,
    "det": np.linalg.det,
    "transpose": np.transpose,
    "sin": np.sin,
    "cos": np.cos,
    "exp": np.exp,
    "log": np.log,
    "at_most": np.less_equal,
    "below": np.less,
}


@dataclass(frozen=True)
class Formula:
    """A printed formula.

    Attributes
    ----------
    text
        As the ledger has it.
    sides
        What stands between the signs of equality, in order. Names are non-commutative symbols, so
        that products of matrices keep their order.
    """

    text: str
    sides: tuple[sp.Expr, ...]

    def value(self, side: int, given: Mapping[str, Any]) -> Any:
        """Value of one side.

        Parameters
        ----------
        given
            By name: numbers, vectors (n,) or, if they are transposed in print, columns (n, 1),
            matrices (m, n), and functions such as ``grad``. A name that a sum numbers
            (``theta_i``) is the sequence of its values, counted from 1.

        Raises
        ------
        DataFileError
            The formula holds a name that is not given.
        """
        return _value(self.sides[side], given, self.text)

    def symbols(self) -> set[str]:
        """Names in the formula."""
        return {str(symbol) for side in self.sides for symbol in side.free_symbols}


def parse(text: str, functions: Iterable[str] = ()) -> Formula:
    """Parse a printed formula.

    Parameters
    ----------
    functions
        Names before parentheses that are functions, besides those of the notation; any other such
        name only lists what it depends on: ``J(q)`` is J.

    Raises
    ------
    DataFileError
        The text is no formula of this notation.
    """
    try:
        counted = _SUM.sub(lambda m: f"total_{m[1]}_{m[2]}_{m[3]}*", text)
        known = _KNOWN | {name: sp.Function(name) for name in functions}
        sides = tuple(_side(part, known) for part in _RELATION.split(counted))
    except (
        TokenError,
        SyntaxError,
        TypeError,
        ValueError,
        AttributeError,
        sp.SympifyError,
    ) as error:
        reason = " ".join(str(error).split()) or type(error).__name__
        raise DataFileError("printed formula", "text", text, f"a formula ({reason})") from None
    return Formula(text, sides)


def _side(text: str, known: Mapping[str, Any]) -> sp.Expr:
    text = text.strip()
    branches = re.findall(r"(.+?) if ([^,]+?)(?:,|$)", text)
    if not branches:
        return _plain(text, known)
    parts = [
        part
        for value, condition in branches
        for part in (_plain(value, known), _when(condition, known))
    ]
    return _KNOWN["cases"](*parts)


def _when(condition: str, known: Mapping[str, Any]) -> sp.Expr:
    for sign, name, swapped in (
        ("<=", "at_most", False),
        (">=", "at_most", True),
        ("<", "below", False),
        (">", "below", True),
    ):
        if sign in condition:
            left, right = (_plain(part, known) for part in condition.split(sign))
            return _KNOWN[name](*((right, left) if swapped else (left, right)))
    raise ValueError(f"{condition!r} is no comparison")


def _plain(text: str, known: Mapping[str, Any]) -> sp.Expr:
    text = re.sub(r"\blambda\b", "lambda_", text.strip())
    text = _norms(text)
    text = re.sub(r"\^\*", "_star", text)
    text = re.sub(r"_\{(\w+)\}", r"_\1", text)
    text = re.sub(r"(?<=\w)\((i|j|k)\)", r"_\1", text)
    text = re.sub(r"(\w+|\([^()]*\))\^T(\((?:[^()]*)\))?", r"transpose(\1)", text)
<<<<<<< HEAD
    functions = "|".join(known)
    text = re.sub(rf"\b(?!(?:{functions})\b)([A-Za-z]\w*)\(([\w, ]*)\)", r"\1", text)
=======
    functions = "|".join(_KNOWN)
    arguments = rf"\b(?!(?:{functions})\b)([A-Za-z]\w*)\(([\w, ]*)\)"
    while (shorter := re.sub(arguments, r"\1", text)) != text:
        text = shorter
    text = re.sub(r"\bgrad (\w+)", r"grad(\1)", text)
>>>>>>> qiu
    text = re.sub(r"(?<=[\w)]) (?=[A-Za-z(])", "*", text)
    text = text.replace("^", "**")
    names = set(re.findall(r"[A-Za-z_]\w*", text)) - known.keys()
    symbols = {name: sp.Symbol(name, commutative=False) for name in names}
    return parse_expr(text, local_dict={**known, **symbols}, evaluate=True)


def _norms(text: str) -> str:
    """``|a|`` becomes ``norm(a)``; bars do not nest in print."""
    parts = text.replace("||", "|").split("|")
    if len(parts) % 2 == 0:
        raise ValueError("an odd number of bars")
    return "".join(f"norm({part})" if number % 2 else part for number, part in enumerate(parts))


def _value(node: Any, given: Mapping[str, Any], text: str) -> Any:
    def of(part: Any) -> Any:
        return _value(part, given, text)

    if isinstance(node, sp.Symbol):
        if str(node) not in given:
            raise DataFileError("printed formula", "name", str(node), f"a name given for {text!r}")
        return given[str(node)]
    if node.is_Number or node.is_NumberSymbol:
        return float(node)
    if isinstance(node, sp.Add):
        return sum((of(part) for part in node.args[1:]), of(node.args[0]))
    if isinstance(node, sp.Mul):
        return _product(node, given, text)
    if isinstance(node, sp.Pow):
        base, exponent = of(node.base), of(node.exp)
        if np.ndim(base) == 2:
            return np.linalg.matrix_power(base, int(exponent))
        return base**exponent
    name = type(node).__name__
    if name == "cases":
        for value, condition in zip(node.args[::2], node.args[1::2], strict=True):
            if of(condition):
                return of(value)
        return float("nan")
    function = given.get(name, _NUMERIC.get(name))
    if function is None:
        raise DataFileError("printed formula", "function", name, f"one given for {text!r}")
    return function(*(of(part) for part in node.args))


def _product(node: sp.Mul, given: Mapping[str, Any], text: str) -> Any:
    """A product in the order of print; what follows a numbered sum is summed."""
    factors = list(node.args)
    for place, factor in enumerate(factors):
        if isinstance(factor, sp.Symbol) and str(factor).startswith("total_"):
            _, index, first, last = str(factor).split("_")
            end = int(last) if last.isdigit() else int(given[last])
            body = sp.Mul(*factors[place + 1 :])
            terms = [
                _value(body, _numbered(given, index, k), text) for k in range(int(first), end + 1)
            ]
            rest = [_value(one, given, text) for one in factors[:place]]
            return np.prod(rest) * sum(terms)
    found = _value(factors[0], given, text)
    for factor in factors[1:]:
        other = _value(factor, given, text)
        matrices = np.ndim(found) + np.ndim(other) > 2 and np.ndim(found) and np.ndim(other)
        found = found @ other if matrices else found * other
    return found


def _numbered(given: Mapping[str, Any], index: str, k: int) -> dict[str, Any]:
    """Names that end in the index of a sum, each with its k-th value."""
    return {
        name: value[k - 1] if name.endswith(index) and np.ndim(value) else value
        for name, value in given.items()
    }
