"""Pages become notebooks that any Jupyter runs, and the theme offers them."""

import json

import lab_notebooks
import nbformat
import notebook_downloads
import pytest
from bs4 import BeautifulSoup
from sphinx.application import Sphinx
from sphinx.errors import ExtensionError

PAGE = """---
file_format: mystnb
---

# A page

```{code-cell} ipython3
1 + 1
```
"""
CONF = """extensions = ["myst_nb", "notebook_downloads", "theme_repairs"]
html_theme = "sphinx_book_theme"
nb_execution_mode = "cache"
"""
LAUNCH = "launch_addresses = {'Binder': 'local/{page}.ipynb'}\n"


def ran(*html):
    outputs = [
        nbformat.v4.new_output("execute_result", {"text/html": text}, execution_count=1)
        for text in html
    ]
    cell = nbformat.v4.new_code_cell("1 + 1", outputs=outputs, execution_count=1)
    return nbformat.v4.new_notebook(cells=[cell])


def test_a_page_with_its_outputs():
    made = notebook_downloads.notebook(PAGE, "a/page", ran("<b>2</b>"))
    nbformat.validate(made)
    assert [cell.cell_type for cell in made.cells] == ["markdown", "markdown", "code"]
    assert "a/page" in made.cells[0].source
    assert made.cells[1].source == "# A page"
    assert made.cells[2].outputs[0].data["text/html"] == "<b>2</b>"
    assert made.metadata.kernelspec["name"] == "python3"
    again = notebook_downloads.notebook(PAGE, "a/page", ran("<b>2</b>"))
    assert nbformat.writes(again) == nbformat.writes(made)


def test_outputs_of_other_cells_are_refused():
    with pytest.raises(ExtensionError, match="page: the executed cells"):
        notebook_downloads.notebook(PAGE.replace("1 + 1", "1 + 2"), "page", ran("<b>2</b>"))


def build(tmp_path, conf):
    source, html = tmp_path / "source", tmp_path / "html"
    source.mkdir()
    (source / "conf.py").write_text(conf)
    (source / "index.md").write_text(PAGE)
    app = Sphinx(source, source, html, tmp_path / "trees", "html", status=None, warning=None)
    app.build()
    return html


@pytest.mark.parametrize("launch", [False, True])
def test_the_theme_offers_the_notebook(tmp_path, launch, monkeypatch):
    monkeypatch.setenv(notebook_downloads.IN_BOOK, "1")
    html = build(tmp_path, CONF + (LAUNCH if launch else ""))
    soup = BeautifulSoup((html / "index.html").read_text(), "html.parser")
    link = soup.find("a", href="_sources/index.ipynb")
    assert link
    assert "btn-download-notebook-button" in link["class"]
    made = json.loads((html / "_sources/index.ipynb").read_text())
    assert "".join(made["cells"][2]["outputs"][0]["data"]["text/plain"]) == "2"
    assert bool(soup.find("a", href="local/index.ipynb")) is launch
    assert 'rel="preload" as="font"' not in (html / "index.html").read_text()


def test_notebooks_for_the_lab(tmp_path):
    book, html, folder = tmp_path / "book", tmp_path / "html", tmp_path / "lab"
    (html / "_sources").mkdir(parents=True)
    book.mkdir()
    (book / "_toc.yml").write_text("root: intro\nchapters:\n- file: text\n- file: built\n")
    (book / "text.md").write_text("# No code\n")
    for name in ("intro", "built"):
        (book / f"{name}.md").write_text(PAGE)
    nbformat.write(ran("<b>2</b>"), html / "_sources/built.ipynb")
    written = lab_notebooks.write_notebooks(book, html, folder)
    assert [path.name for path in written] == ["intro.ipynb", "built.ipynb"]
    assert nbformat.read(folder / "built.ipynb", 4).cells[0].outputs
    assert not nbformat.read(folder / "intro.ipynb", 4).cells[2].outputs
    (folder / "intro.ipynb").write_text("changed by a reader")
    assert lab_notebooks.write_notebooks(book, html, folder) == []
    assert (folder / "intro.ipynb").read_text() == "changed by a reader"
