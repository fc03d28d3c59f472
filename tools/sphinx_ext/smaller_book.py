"""Sphinx extension: nothing is in the built book twice, and nothing that no browser loads.

A picture that a chapter carries within it and that is a file beside the page of its item becomes a
reference to that file. Maps of minified sources and fonts of an older format go.
"""

from __future__ import annotations

import re
from base64 import b64decode
from collections.abc import Mapping
from hashlib import sha256
from pathlib import Path
from typing import Any

from sphinx.application import Sphinx

from dualarm_repro.view.item_files import FOLDER

_PICTURE = re.compile(r'src="data:image/(?:svg\+xml|png);base64,([^"]+)"')
#: A style sheet names a newer format of the same font first.
_UNUSED = ("*.map", "webfonts/*.ttf")


def files_of_items(html: Path) -> dict[str, str]:
    """Hash of the content of each picture of an item, with its way from the top of the book."""
    paths = [*html.glob(f"{FOLDER}/*.svg"), *html.glob(f"{FOLDER}/*.png")]
    return {
        sha256(path.read_bytes()).hexdigest(): path.relative_to(html).as_posix() for path in paths
    }


def with_references(page: str, known: Mapping[str, str], root: str) -> str:
    """A page that refers to the pictures that are files.

    Parameters
    ----------
    root
        Way from the page up to the top of the book.
    """

    def reference(found: re.Match[str]) -> str:
        where = known.get(sha256(b64decode(found[1])).hexdigest())
        return f'src="{root}{where}"' if where else found[0]

    return _PICTURE.sub(reference, page)


def shrink(app: Sphinx, error: Exception | None) -> None:
    """Make a finished HTML build smaller."""
    if error or app.builder.format != "html":
        return
    html = Path(app.outdir)
    known = files_of_items(html)
    for name in app.env.found_docs:
        path = html / f"{name}.html"
        if path.is_file():
            text = path.read_text(encoding="utf-8")
            path.write_text(with_references(text, known, "../" * name.count("/")), "utf-8")
    for pattern in _UNUSED:
        for path in html.joinpath("_static").rglob(pattern):
            path.unlink()


def setup(app: Sphinx) -> dict[str, Any]:
    """Entry point of Sphinx."""
    app.connect("build-finished", shrink)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
