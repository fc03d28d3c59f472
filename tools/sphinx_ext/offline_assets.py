"""Sphinx extension: MathJax and all scripts go into the book, so it needs no network."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path
from shutil import copy2
from typing import Any

from sphinx.application import Sphinx

from dualarm_repro.view.assets import ASSETS, SCRIPTS, STYLES
from dualarm_repro.view.static_meshcat import VIEWER, viewer_script

#: One file with every TeX extension and no fonts, so that nothing is fetched later.
MATHJAX = "mathjax/tex-svg-full.js"


def assets() -> dict[str, Path]:
    """Path below ``_static`` of every copied file, with the installed file it comes from."""
    mathjax = Path(find_spec("sphinx-mathjax-offline").origin).parent / "static" / MATHJAX
    names = [*SCRIPTS.values(), *STYLES.values()]
    ours = {name: ASSETS / Path(name).name for name in names}
    return {MATHJAX: mathjax, VIEWER: viewer_script(), **ours}


def copy_assets(app: Sphinx) -> None:
    """Copy the files when an HTML build begins."""
    if app.builder.format != "html":
        return
    for name, source in assets().items():
        target = Path(app.outdir) / "_static" / name
        target.parent.mkdir(parents=True, exist_ok=True)
        copy2(source, target)


def add_to_page(
    app: Sphinx, pagename: str, templatename: str, context: dict[str, Any], doctree: Any
) -> None:
    """Let a page load the scripts and styles of what it shows, and nothing else."""
    body = context.get("body") or ""
    for mark in SCRIPTS:
        if f'class="{mark}"' in body:
            app.add_js_file(SCRIPTS[mark], loading_method="defer")
            app.add_css_file(STYLES[mark])


def setup(app: Sphinx) -> dict[str, Any]:
    """Entry point of Sphinx."""
    app.connect("builder-inited", copy_assets)
    app.connect("html-page-context", add_to_page)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
