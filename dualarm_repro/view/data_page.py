"""The page of the book that hands out the whole ledger as files."""

from __future__ import annotations

from html import escape

from ..ledger.publication import ZIP, names
from .page import Page
from .schemas import schemas

#: Where the build puts an export, from the top of the book.
FOLDER = "_static/ledger"


def data_page() -> Page:
    """A table of the files of an export, the zip first, with links that work offline."""
    files = names(schemas())
    rows = "".join(
        f'<tr><td><a href="{FOLDER}/{name}" download>{escape(name)}</a></td>'
        f"<td>{escape(text)}</td></tr>"
        for name, text in sorted(files.items(), key=lambda entry: entry[0] != ZIP)
    )
    head = "<tr><th>file</th><th>content</th></tr>"
    return Page(f'<table class="ledger-files">{head}{rows}</table>')
