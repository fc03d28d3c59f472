"""What a cell of a chapter ends in: a figure with its finding, or its numbers beside the ledger."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import pandas as pd

from ..ledger import REGISTRY
from ..ledger.files import through_json
from ..ledger.record import record
from .card import figure_html
from .page import Page

_ROUND_OFF = 1e-12


def shown(figure: Any, finding: str, alt: str) -> Page:
    """A figure drawn in a cell, with the finding as its caption and alternative text."""
    return Page(figure_html(figure, alt, finding))


def obtained(item_id: str) -> Any:
    """The values that the ledger obtained for an item, as its card judges them."""
    return record(REGISTRY, item_id)["obtained"]


def beside_ledger(item_id: str, computed: Mapping[str, Any]) -> pd.DataFrame:
    """Numbers of a cell beside those that the ledger obtained for an item.

    Parameters
    ----------
    computed
        By the key of the obtained value; dots lead into nested ones, as in ``"held.improved"``.

    Returns
    -------
    DataFrame
        Index: the keys; columns ``this page`` and the id of the item.
    """
    ledger = obtained(item_id)
    rows = {}
    for key, value in computed.items():
        rows[key] = {"this page": _told(value), item_id: _told(value_at(ledger, key))}
    return pd.DataFrame.from_dict(rows, orient="index")


def value_at(values: Any, key: str) -> Any:
    """The value under a key; dots lead into nested mappings.

    Raises
    ------
    KeyError
        No such value.
    """
    if key in values:
        return values[key]
    outer, dot, inner = key.partition(".")
    return value_at(values[outer], inner) if dot else values[key]


def _told(value: Any) -> Any:
    """A number or list as six digits show it."""
    plain = through_json({"value": value})["value"]
    if isinstance(plain, list):
        return ", ".join(str(_told(part)) for part in plain)
    if isinstance(plain, float):
        return "0" if abs(plain) < _ROUND_OFF else f"{plain:.6g}"
    return plain
