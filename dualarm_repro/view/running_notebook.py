"""What a page of the book gets from the book, for a notebook that runs elsewhere: style and viewer.

The build of the book says by an environment variable that its pages bring both. Anywhere else, in
JupyterLab for instance, every output carries them, and takes its colours from Jupyter.
"""

from __future__ import annotations

import os
from functools import cache
from pathlib import Path

from ..datafiles import data_root
from .static_meshcat import with_viewer

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


def shown(html: str) -> str:
    """HTML as an output of a cell: as it is in the book, with style and viewer elsewhere."""
    if IN_BOOK in os.environ:
        return html
    return f"<style>{_style()}</style>{with_viewer(html)}"


@cache
def _style() -> str:
    """The style sheet of cards and tables: in a wheel beside this file, in a clone the book's."""
    installed = Path(__file__).with_name("ledger.css")
    path = installed if installed.is_file() else data_root().parent / "book/_static/ledger.css"
    return _COLOURS + path.read_text(encoding="utf-8")
