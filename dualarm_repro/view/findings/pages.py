"""Findings as pages of the book show them."""

from __future__ import annotations

from collections.abc import Iterable

from ...ledger import Registry
from ..item_files import address
from ..page import Page
from ..rendering import render
from .support import Told, findings_of, leading

#: Words around the findings, by language.
_WORDS = {
    "en": {
        "lapsed": "No longer supported.",
        "lapsed_text": "The records do not bear out any more what was said here under the heading",
        "failing": "Not true any more:",
        "see": "What they show now:",
        "under": "Assumed:",
        "colon": ": ",
    },
    "zh": {
        "lapsed": "此结论不再成立。",
        "lapsed_text": "账目已不再支持以下标题所述的内容",
        "failing": "不再成立的条件：",
        "see": "现有结果：",
        "under": "假设：",
        "colon": "：",
    },
}
_TAGS = {"en": "en", "zh": "zh-Hans"}


def findings_page(
    registry: Registry, paper: str, language: str = "en", root: str | None = None
) -> Page:
    """The findings on a document, each with its numbers, its assumptions and its items.

    Parameters
    ----------
    root
        Way from the page up to the top of the book; default that of the page of a document.
    """
    found = findings_of(registry, paper, language)
    return _page(found, language, "../" if root is None else root)


def leading_page(registry: Registry, language: str = "en") -> Page:
    """The findings that lead, for a page at the top of the book."""
    return _page(leading(registry, language), language, "")


def _page(found: Iterable[Told], language: str, root: str) -> Page:
    html = render(
        "findings",
        found=list(found),
        said=_WORDS[language],
        tag=_TAGS[language],
        own=lambda item_id: root + address(item_id),
    )
    return Page(html)
