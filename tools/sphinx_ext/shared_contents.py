"""Sphinx extension: the table of contents beside pages that are in none is made once.

Pages of items and of highlighted sources are in no table of contents, so none of its entries is
marked in theirs, and it reads the same in all that lie as deep. Sphinx would copy the whole tree,
every documented function included, for each of these several hundred pages.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

from sphinx.application import Sphinx

#: Contents by the depth of a page and the way the theme asks for them.
Kept = dict[tuple[Any, ...], str]


def share(
    kept: Kept, app: Sphinx, pagename: str, templatename: str, context: dict[str, Any], tree: Any
) -> None:
    """Let a page that is no source of the book take the contents of one that lies as deep."""
    if pagename in app.env.all_docs or "toctree" not in context:
        return
    context["toctree"] = partial(_contents, kept, pagename.count("/"), context["toctree"])


def _contents(kept: Kept, depth: int, make: Callable[..., str], **how: Any) -> str:
    key = (depth, *sorted(how.items()))
    if key not in kept:
        kept[key] = make(**how)
    return kept[key]


def setup(app: Sphinx) -> dict[str, Any]:
    """Entry point of Sphinx."""
    app.connect("html-page-context", partial(share, {}), priority=100)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
