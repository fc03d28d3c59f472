"""The documents: one room each, which registers its items with the ledger."""

from __future__ import annotations

from functools import cache
from importlib import import_module

from ..ledger import REGISTRY, Registry
from ..view.page import Page, present

#: One room per document, in the order of the listings.
ROOMS = ("xue", "qiu", "patent", "pan")


@cache
def load() -> Registry:
    """The registry with every document read and every checker registered."""
    REGISTRY.load()
    for room in ROOMS:
        import_module(f"{__name__}.{room}")
    return REGISTRY


def show(item_id: str) -> Page:
    """Everything the ledger knows about an item, for a cell of the book: ``show("xue.fig05")``.

    Raises
    ------
    UnknownNameError
        No such item.
    """
    return present(load(), item_id)
