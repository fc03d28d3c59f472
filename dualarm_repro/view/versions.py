"""What the numbers of the book were computed with."""

from __future__ import annotations

from html import escape

from ..ledger.closure import closure_of_modules
from ..sources import graph
from .page import Page


def versions_page() -> Page:
    """Versions of Python and of every library that the code can reach, and the hash of the code."""
    found = closure_of_modules(tuple(sorted(graph().files)), drawn=True)
    rows = "".join(
        f"<tr><td>{escape(name)}</td><td>{escape(number)}</td></tr>"
        for name, number in found.versions.items()
    )
    return Page(
        '<details><summary>Versions</summary><table class="ledger-versions">'
        f"<tr><th>library</th><th>version</th></tr>{rows}</table></details>"
        f"<p>Hash of the code of the library: <code>{found.digest}</code></p>"
    )
