"""Meshcat without a server: the commands are collected and embedded in a page."""

from __future__ import annotations

from base64 import b64encode
from html import escape
from pathlib import Path
from typing import Any

import meshcat
import umsgpack

#: Where a built book keeps the one viewer script, below its ``_static`` folder.
VIEWER = "meshcat/main.min.js"

_BODY = """<!DOCTYPE html><html><head><meta charset="utf-8"><title>{title}</title>
<style>body {{ margin: 0 }} #pane {{ width: 100vw; height: 100vh; overflow: hidden }}</style></head>
<body><div id="pane"></div>{loader}<script>
function show() {{
  const viewer = new MeshCat.Viewer(document.getElementById("pane"));
  for (const text of {commands}) {{
    viewer.handle_command_bytearray(Uint8Array.from(atob(text), (c) => c.charCodeAt(0)));
  }}
}}
{start}</script></body></html>"""

_FROM_BOOK = """
const script = document.createElement("script");
script.src = parent.document.documentElement.dataset.content_root + "_static/{viewer}";
script.onload = show;
document.head.appendChild(script);
"""


class StaticWindow:
    """Stands in for the window of ``meshcat.Visualizer``: keeps the commands, starts no server."""

    def __init__(self) -> None:
        self._objects: list[bytes] = []
        self._animations: list[bytes] = []

    def send(self, command: Any) -> None:
        """Keep one command of meshcat; animations go last, after the objects they move."""
        data = command.lower()
        kept = self._animations if data["type"] == "set_animation" else self._objects
        kept.append(umsgpack.packb(data))

    def commands(self) -> list[str]:
        """All commands as base64 text."""
        return [b64encode(data).decode() for data in (*self._objects, *self._animations)]


def static_visualizer() -> meshcat.Visualizer:
    """A visualizer that takes every call of meshcat and draws nothing by itself."""
    return meshcat.Visualizer(window=StaticWindow())


def viewer_script() -> Path:
    """The viewer's JavaScript inside the installed meshcat package."""
    return Path(meshcat.__file__).parent / "viewer" / "dist" / "main.min.js"


def standalone_html(vis: meshcat.Visualizer, title: str) -> str:
    """One HTML file with viewer and scene that needs no network."""
    code = viewer_script().read_text(encoding="utf-8").replace("</script", "<\\/script")
    return _page(vis, title, f"<script>{code}</script>", "show();")


def page_iframe(vis: meshcat.Visualizer, title: str, height: int) -> str:
    """An iframe for a page of the book; it takes the viewer from the book's ``_static`` folder."""
    inner = _page(vis, title, "", _FROM_BOOK.format(viewer=VIEWER))
    return (
        f'<iframe class="ledger-scene" loading="lazy" title="{escape(title)}" '
        f'style="width: 100%; height: {height}px; border: 0" srcdoc="{escape(inner)}"></iframe>'
    )


def with_viewer(html: str) -> str:
    """HTML whose scenes carry the viewer, for a notebook that is not a page of the book."""
    from_book, pane = escape(_FROM_BOOK.format(viewer=VIEWER)), escape('<div id="pane"></div>')
    if from_book not in html:
        return html
    code = viewer_script().read_text(encoding="utf-8").replace("</script", "<\\/script")
    loaded = pane + escape(f"<script>{code}</script>")
    return html.replace(pane, loaded).replace(from_book, escape("show();"))


def _page(vis: meshcat.Visualizer, title: str, loader: str, start: str) -> str:
    commands = "[" + ",".join(f'"{text}"' for text in vis.window.commands()) + "]"
    return _BODY.format(title=escape(title), loader=loader, commands=commands, start=start)
