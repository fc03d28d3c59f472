"""Chinese on the pages of the book: a summary of each part, and the verdicts by name."""

from __future__ import annotations

from functools import cache, partial
from pathlib import Path
from typing import Any

from markupsafe import Markup
from pydantic import Field

from ..datafiles import StrictModel, Text, read_yaml
from ..errors import UnknownNameError
from ..ledger import Registry
from ..ledger.verdict import Verdict
from .page import Page
from .rendering import render
from .sentences import close_up, fill
from .tally import tally

_FILE = Path(__file__).with_name("chinese.yaml")


class ChineseFile(StrictModel):
    """Content of ``chinese.yaml``."""

    parts: dict[str, Text] = Field(description="summary of each part of the book")
    summary: Text = Field(description="how many items of a document have which verdict")
    verdicts: dict[Verdict, tuple[Text, Text]] = Field(description="name and meaning of each")


def summary_page(part: str, registry: Registry | None = None, root: str = "") -> Page:
    """The Chinese summary at the head of a part of the book.

    Parameters
    ----------
    part
        A document, ``"foundations"``, ``"ledger"`` or ``"use"``.
    registry
        For those that count items: the ledger and the documents.
    root
        Way from the page up to the top of the book.

    Raises
    ------
    UnknownNameError
        No summary of that name.
    LedgerError
        It counts items, and there is no registry.
    """
    return Page(render("chinese_summary", text=Markup(summary(part, registry, root))))


def summary(part: str, registry: Registry | None = None, root: str = "") -> str:
    """The same as HTML without a frame."""
    parts = words().parts
    if part not in parts:
        raise UnknownNameError(_FILE.name, "part", part, f"one of {', '.join(parts)}")
    values: dict[str, Any] = {"link": partial(_link, root)}
    if registry is not None:
        values["total"] = len(registry.items)
        if part in registry.papers:
            counts = tally(registry, part)
            values["verdicts"] = fill(words().summary, f"{_FILE.name}, summary", **counts)
    return close_up(fill(parts[part], f"{_FILE.name}, {part}", **values))


def verdicts_page(registry: Registry) -> Page:
    """All verdicts with their Chinese names and meanings, and how many items have each."""
    counted = tally(registry)["by_verdict"]
    return Page(render("chinese_verdicts", verdicts=words().verdicts, counted=counted))


@cache
def words() -> ChineseFile:
    """The words of ``chinese.yaml``.

    Raises
    ------
    DataFileError
        With the first offending field, its value and what was expected.
    """
    return ChineseFile.checked(_FILE, read_yaml(_FILE))


def _link(root: str, page: str, text: str) -> Markup:
    return Markup('<a href="{}{}.html">{}</a>').format(root, page, text)
