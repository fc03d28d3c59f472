"""The documents: one room each, which registers its items with the ledger."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..ledger import REGISTRY, Registry
from .nudge import nudge_arms

if TYPE_CHECKING:
    from ..view.page import Page

REGISTRY.nudge = nudge_arms


def load() -> Registry:
    """The registry; a document is read, and its room imported, when something asks for it."""
    return REGISTRY


def show(*item_ids: str) -> Page:
    """Everything the ledger knows about items, for a cell of the book: ``show("xue.fig05")``.

    Raises
    ------
    UnknownNameError
        No such item.
    """
    from ..view.page import Page, present

    return Page("".join(present(REGISTRY, item_id).html for item_id in item_ids))
