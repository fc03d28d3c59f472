"""Addresses and files of the page that every item has of its own in the book."""

from __future__ import annotations

import re
from base64 import b64decode
from collections.abc import Mapping, Sequence
from functools import partial
from html import unescape
from pathlib import Path
from typing import Any

from ..datafiles import data_root
from ..ledger.files import to_json, write

#: Folder of the pages below the top of the book.
FOLDER = "items"
#: What a file holds, by its suffix, in the order in which a card lists them.
KINDS = {
    "json": "the whole record",
    "csv": "the data behind the figure, or the obtained values",
    "svg": "the figure as a drawing",
    "png": "the figure as pixels",
    "scene.html": "the 3-D scene by itself",
}
_IMAGE = re.compile(r'src="data:image/(svg\+xml|png);base64,([^"]+)"')
_SCENE = """<!DOCTYPE html><html lang="en" data-content_root="../"><head><meta charset="utf-8">
<title>{title}</title><meta name="viewport" content="width=device-width">
<link rel="stylesheet" href="../_static/moving/scene.css"></head>
<body class="scene-alone">{body}<script src="../_static/moving/scene.js"></script></body></html>
"""


def address(item_id: str) -> str:
    """Address of the page of an item, from the top of the book."""
    return f"{FOLDER}/{item_id}.html"


def where(item_id: str, html: Path | None = None) -> str:
    """The page of an item as a reader can open it: in the built book, else from its top.

    Parameters
    ----------
    html
        The built book; default that of the clone.
    """
    page = (html or data_root().parent / "_build" / "html") / address(item_id)
    return page.resolve().as_uri() if page.is_file() else address(item_id)


def links(made: Mapping[str, Any], drawn: Mapping[str, Any], root: str) -> list[tuple[str, str]]:
    """Kind and address of each file of an item.

    Parameters
    ----------
    drawn
        Pictures and data of the item, see ``page.pictures``.
    root
        Way from the page up to the top of the book.
    """
    return [(kind, f"{root}{FOLDER}/{made['id']}.{kind}") for kind in _contents(made, drawn)]


def write_files(made: Mapping[str, Any], drawn: Mapping[str, Any], html: Path) -> list[Path]:
    """Write the files of an item into a built book.

    Raises
    ------
    OutputError
        The folder cannot be written.
    """
    written = []
    for kind, content in _contents(made, drawn).items():
        path = html / FOLDER / f"{made['id']}.{kind}"
        data = content if isinstance(content, bytes) else content.encode("utf-8")
        written.append(write(path, partial(Path.write_bytes, data=data)))
    return written


def beside_page(figure: str, files: Sequence[tuple[str, str]]) -> str:
    """A figure whose picture is the file beside the page instead of data within it."""
    found = _IMAGE.search(figure)
    if found is None:
        return figure
    kind = found[1].partition("+")[0]
    where = next(address for one, address in files if one == kind)
    return figure.replace(found[0], f'src="{where}"')


def _contents(made: Mapping[str, Any], drawn: Mapping[str, Any]) -> dict[str, str | bytes]:
    """What an item has as a file, by kind."""
    found: dict[str, str | bytes] = {"json": to_json(made)}
    if drawn.get("csv"):
        found["csv"] = drawn["csv"]
    if image := _IMAGE.search(drawn["figure"] or ""):
        found[image[1].partition("+")[0]] = b64decode(image[2])
    if drawn["scene"]:
        title = unescape(f"{made['id']}: {made['title']}")
        found["scene.html"] = _SCENE.format(title=title, body=drawn["scene"])
    return {kind: found[kind] for kind in KINDS if kind in found}
