"""What a page of the book gets from the book, for a notebook that runs elsewhere: its style.

The build of the book says by an environment variable that its pages bring it. Anywhere else, in
JupyterLab for instance, every output carries it, and takes its colours from Jupyter; of a 3-D scene
the still picture is shown there.
"""

from __future__ import annotations

import os
from functools import cache
from pathlib import Path

from ..datafiles import data_root
from .assets import ASSETS

#: Environment variable that is set while the book is built.
IN_BOOK = "DUALARM_IN_BOOK"
_COLOURS = """:root {
  --pst-color-border: var(--jp-border-color2, #ccc);
  --pst-color-surface: var(--jp-layout-color1, #fff);
  --pst-color-background: var(--jp-layout-color0, #fff);
  --pst-color-text-base: var(--jp-content-font-color1, #222);
  --pst-color-text-muted: var(--jp-content-font-color2, #555);
}
"""


def with_style(html: str) -> str:
    """HTML as an output of a cell: as it is in the book, with its style elsewhere."""
    if IN_BOOK in os.environ:
        return html
    return f"<style>{_style()}</style>{html}"


@cache
def _style() -> str:
    """Style sheets of cards and scenes; the former in a wheel beside this file, else the book's."""
    installed = Path(__file__).with_name("ledger.css")
    path = installed if installed.is_file() else data_root().parent / "book/_static/ledger.css"
    scenes = ASSETS / "scene.css"
    return _COLOURS + "".join(sheet.read_text(encoding="utf-8") for sheet in (path, scenes))
