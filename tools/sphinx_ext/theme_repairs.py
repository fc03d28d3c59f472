"""Sphinx extension: mends what the theme writes into every page and a reader stumbles over.

Read from files, a preloaded font is a request to another origin, which a browser refuses.
The chevrons that unfold the contents have no name, and a list of references is called a list though
its entries are not called entries of one.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from sphinx.application import Sphinx

_FONT = re.compile(r'\s*<link rel="preload" as="font"[^>]*>')
_CHEVRON = re.compile(r'<summary>(<span class="toctree-toggle")')
_REFERENCES = '<div role="list" class="citation-list">'
_NAMED = r'<summary aria-label="Pages below">\1'


def repaired(html: str) -> str:
    """A page without preloaded fonts, with names for the chevrons, and no list without entries."""
    named = _CHEVRON.sub(_NAMED, _FONT.sub("", html))
    return named.replace(_REFERENCES, '<div class="citation-list">')


def repair(app: Sphinx, error: Exception | None) -> None:
    """Repair every page of a finished HTML build."""
    if error or app.builder.format != "html":
        return
    for path in Path(app.outdir).rglob("*.html"):
        text = path.read_text(encoding="utf-8")
        if (better := repaired(text)) != text:
            path.write_text(better, encoding="utf-8")


def setup(app: Sphinx) -> dict[str, Any]:
    """Entry point of Sphinx."""
    app.connect("build-finished", repair)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
