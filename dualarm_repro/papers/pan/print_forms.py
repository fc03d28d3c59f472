"""Printed equations of `pan` as numbers: residuals of formulas, matrices of blocks, sizes."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from operator import ge, gt, le, lt
from typing import Any

import numpy as np
import sympy as sp

from ...errors import DataFileError
from ...ledger import REGISTRY
from ...ledger.formula import parse

_RELATIONS: dict[str, Callable[[Any, Any], Any]] = {
    "<=": le, ">=": ge, "<": lt, ">": gt, "=": np.isclose,
}  # fmt: skip
_NO_VALUE = (DataFileError, ValueError, TypeError, IndexError, np.linalg.LinAlgError)


def printed_text(item_id: str, key: str = "formula") -> Any:
    """What an item prints under a key."""
    return REGISTRY.printed(item_id)[key]


def residual(text: str, given: Mapping[str, Any]) -> float:
    """Largest difference between the sides of a printed formula; infinite if it has no value.

    Parameters
    ----------
    given
        Values of the names, and of functions that are not in the notation of the ledger.
    """
    try:
        formula = parse(text, _functions(given))
        sides = [np.asarray(formula.value(k, given), float) for k in range(len(formula.sides))]
        gaps = [abs(_plain(sides[0]) - _plain(side)).max() for side in sides[1:]]
    except _NO_VALUE:
        return float("inf")
    return float(max(gaps)) if gaps and np.isfinite(gaps).all() else float("inf")


def worst(text: str, cases: Sequence[Mapping[str, Any]]) -> float:
    """The largest residual of a printed formula over several cases."""
    return max((residual(text, given) for given in cases), default=float("inf"))


def value(text: str, given: Mapping[str, Any]) -> Any:
    """Value of a printed expression.

    Raises
    ------
    DataFileError
        It is no expression, or holds a name that is not given.
    """
    return parse(text, _functions(given)).value(0, given)


def block_matrix(rows: Sequence[Sequence[str]], given: Mapping[str, np.ndarray]) -> np.ndarray:
    """A matrix printed in blocks; 0 stands for a block of zeros, 1 for the number.

    A block of zeros takes its size from its row and column, or is one number.

    Raises
    ------
    DataFileError
        The blocks do not fit each other, or one of them has no value.
    """
    blocks = [
        [np.atleast_1d(np.asarray(value(cell, given), float)) for cell in row] for row in rows
    ]
    blocks = [[b[:, np.newaxis] if b.ndim == 1 else b for b in row] for row in blocks]
    heights = [max(b.shape[0] for b in row) for row in blocks]
    widths = [max(row[k].shape[1] for row in blocks) for k in range(len(blocks[0]))]
    filled = [
        [
            np.zeros((height, width)) if not block.any() and block.size == 1 else block
            for block, width in zip(row, widths, strict=True)
        ]
        for row, height in zip(blocks, heights, strict=True)
    ]
    try:
        return np.block(filled)
    except ValueError as error:
        raise DataFileError(
            "printed matrix", "blocks", rows, f"blocks that fit ({error})"
        ) from None


def block_residual(
    rows: Sequence[Sequence[str]], given: Mapping[str, np.ndarray], expected: np.ndarray
) -> float:
    """Largest difference between a matrix printed in blocks and another; infinite if none fits."""
    try:
        found = block_matrix(rows, given)
    except _NO_VALUE:
        return float("inf")
    if found.shape != expected.shape:
        return float("inf")
    return float(abs(found - expected).max())


def holds(text: str, given: Mapping[str, Any]) -> bool:
    """Whether a printed relation, or a chain of them, is true of the values given.

    Raises
    ------
    DataFileError
        A side has no value, or there is no relation.
    """
    parts = re.split(r"(<=|>=|<|>|=)", text)
    if len(parts) < 3:
        raise DataFileError("printed relation", "text", text, "sides joined by a relation")
    sides = [value(part, given) for part in parts[::2]]
    return all(
        bool(np.all(_RELATIONS[sign](left, right)))
        for sign, left, right in zip(parts[1::2], sides, sides[1:], strict=False)
    )


def in_symbols(text: str, side: int = 0, **values: sp.Expr) -> sp.Expr:
    """One side of a printed formula with its names replaced by expressions that commute.

    Raises
    ------
    DataFileError
        It holds another name.
    """
    expression = parse(text).sides[side]
    names = {symbol: values.get(str(symbol)) for symbol in expression.free_symbols}
    if None in names.values():
        raise DataFileError("printed formula", "text", text, f"the names {', '.join(values)}")
    return expression.subs(names, simultaneous=True)


def _functions(given: Mapping[str, Any]) -> tuple[str, ...]:
    return tuple(name for name, entry in given.items() if callable(entry))


def _plain(array: np.ndarray) -> np.ndarray:
    """A row or column as a vector."""
    return array.ravel() if array.ndim == 2 and 1 in array.shape else array
