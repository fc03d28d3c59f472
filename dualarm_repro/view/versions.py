"""What the numbers of the book were computed with."""

from __future__ import annotations

from html import escape

from ..ledger.fingerprint import fingerprint, versions
from .page import Page


def versions_page() -> Page:
    """Versions of Python and of the numeric libraries, and the hash of library and data."""
    rows = "".join(
        f"<tr><td>{escape(name)}</td><td>{escape(number)}</td></tr>"
        for name, number in versions().items()
    )
    return Page(
        f'<table class="ledger-versions"><tr><th>library</th><th>version</th></tr>{rows}</table>'
        f"<p>Fingerprint of library, data and versions: <code>{fingerprint()}</code></p>"
    )
