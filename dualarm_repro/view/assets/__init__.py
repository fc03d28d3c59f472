"""Scripts and styles of what moves on a page; a built book keeps them below ``_static``."""

from __future__ import annotations

from pathlib import Path

ASSETS = Path(__file__).resolve().parent
#: Class of the figure that needs a script or style, to its place below ``_static``.
SCRIPTS = {"ledger-scene": "moving/scene.js", "ledger-slice": "moving/slice.js"}
STYLES = {"ledger-scene": "moving/scene.css", "ledger-slice": "moving/slice.css"}
