"""Sphinx extension: every executed page can be downloaded as a notebook, and launched elsewhere.

The notebook is the source of the page with the outputs of its execution. Cards of items are left
out, since they are in the book already; running the cell shows them. ``launch_addresses`` maps
the name of a service to an address in which ``{page}`` stands for the page; there are none by
default, since the book then needs no other host.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import nbformat
from jupyter_cache import get_cache
from myst_nb.core.read import read_myst_markdown_notebook
from nbformat import NotebookNode
from sphinx.application import Sphinx
from sphinx.errors import ExtensionError

from dualarm_repro.ledger.project import project
from dualarm_repro.view.running_notebook import IN_BOOK

KERNEL = {"name": "python3", "display_name": "Python 3", "language": "python"}
FOLDER = "_sources"
_CARD = 'class="ledger-item"'
_LEFT_OUT = "<p><i>The cards of the items appear when this cell is run.</i></p>"
_HEADER = """*This notebook is the page `{page}` of the book of {name} {version}. It runs wherever
the package is installed, from a clone or a wheel; in a clone, `make lab` opens all pages in
JupyterLab. A cell that shows items computes them when it is first run, which takes up to some
minutes.*"""


def notebook(source: str, page: str, outputs: NotebookNode | None) -> NotebookNode:
    """A page as a notebook that any Jupyter runs.

    Parameters
    ----------
    source
        Text of the page in MyST Markdown.
    outputs
        The executed notebook of the same cells; None leaves them without output.
    """
    made = read_myst_markdown_notebook(source)
    done = [cell for cell in outputs.cells if cell.cell_type == "code"] if outputs else []
    code = [cell for cell in made.cells if cell.cell_type == "code"]
    if outputs is not None and [c.source for c in code] != [c.source for c in done]:
        raise ExtensionError(f"{page}: the executed cells are not those of the page")
    for cell, ran in zip(code, done, strict=False):
        cell.outputs = [_light(output) for output in ran.outputs]
        cell.execution_count = ran.execution_count
    told = project()
    text = _HEADER.format(page=page, name=told.name, version=told.version)
    made.cells.insert(0, nbformat.v4.new_markdown_cell(text))
    made.metadata = NotebookNode(kernelspec=KERNEL, language_info={"name": "python"})
    for number, cell in enumerate(made.cells):
        cell.id = f"cell-{number}"  # the same bytes for the same page
    return made


def _light(output: NotebookNode) -> NotebookNode:
    found = nbformat.from_dict(output)
    if _CARD in found.get("data", {}).get("text/html", ""):
        found.data["text/html"] = _LEFT_OUT
    return found


def executed(app: Sphinx, source: Path) -> NotebookNode | None:
    """The notebook of a page as the build executed it, from its cache."""
    folder = app.env.mystnb_config.execution_cache_path
    empty = read_myst_markdown_notebook(source.read_text(encoding="utf-8"))
    try:
        return get_cache(folder).merge_match_into_notebook(empty)[1]
    except KeyError:
        return None


def offer(app: Sphinx, pagename: str, template: str, context: dict[str, Any], tree: Any) -> None:
    """Write the notebook of a page and let the theme's download button know it."""
    ran = getattr(app.env, "nb_metadata", {}).get(pagename, {}).get("exec_data")
    if ran is None or app.builder.format != "html":
        return
    source = Path(app.env.doc2path(pagename))
    if source.suffix != ".md":
        return
    made = notebook(source.read_text(encoding="utf-8"), pagename, executed(app, source))
    nbformat.validate(made)
    path = Path(app.outdir, FOLDER, f"{pagename}.ipynb")
    path.parent.mkdir(parents=True, exist_ok=True)
    nbformat.write(made, path)
    context["ipynb_source"] = f"{pagename}.ipynb"


def launch(app: Sphinx, pagename: str, template: str, context: dict[str, Any], tree: Any) -> None:
    """Add a button for each service that runs the notebook of a page elsewhere."""
    buttons = [
        {
            "type": "link",
            "url": where.format(page=pagename),
            "text": name,
            "tooltip": f"Run this page on {name}",
            "icon": "fas fa-rocket",
            "label": f"launch-{name.lower()}-button",
        }
        for name, where in app.config.launch_addresses.items()
    ]
    if buttons and context.get("ipynb_source"):
        group = {
            "type": "group",
            "tooltip": "Run this page",
            "icon": "fas fa-rocket",
            "label": "launch-buttons",
        }
        context["header_buttons"].append(group | {"buttons": buttons})


def setup(app: Sphinx) -> dict[str, Any]:
    """Entry point of Sphinx: before the theme lays out its buttons, and after it."""
    os.environ[IN_BOOK] = "1"  # for kernels that Sphinx starts
    app.add_config_value("launch_addresses", {}, "html")
    app.connect("html-page-context", offer, priority=400)
    app.connect("html-page-context", launch, priority=600)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
