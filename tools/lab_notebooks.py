"""Write every page with code as a notebook into a folder, for JupyterLab and for Binder.

    python tools/lab_notebooks.py FOLDER

A page of the built book comes with its outputs, any other without. A notebook that is there already
is left as it is, since a reader may have changed it.
"""

from __future__ import annotations

import shutil
import sys
from pathlib import Path

import nbformat
from prerun import ROOT, notebooks

sys.path.append(str(Path(__file__).with_name("sphinx_ext")))
from notebook_downloads import FOLDER, notebook


def write_notebooks(book: Path, html: Path, folder: Path) -> list[Path]:
    """Write the notebooks that are not there yet.

    Parameters
    ----------
    book
        Sources of the pages, with ``_toc.yml``.
    html
        The built book; it need not exist.
    """
    written = []
    for source in notebooks(book):
        page = source.relative_to(book).with_suffix("").as_posix()
        target, built = folder / f"{page}.ipynb", html / FOLDER / f"{page}.ipynb"
        if target.exists():
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        if built.is_file():
            shutil.copy2(built, target)
        else:
            nbformat.write(notebook(source.read_text(encoding="utf-8"), page, None), target)
        written.append(target)
    return written


def main() -> int:
    """Write the notebooks of the book into the folder that is named."""
    if len(sys.argv) != 2:
        print(f"usage: {Path(__file__).name} FOLDER", file=sys.stderr)
        return 2
    folder = Path(sys.argv[1])
    written = write_notebooks(ROOT / "book", ROOT / "_build" / "html", folder)
    print(f"{len(written)} notebooks written to {folder}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
