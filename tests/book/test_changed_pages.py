"""A rebuild leaves the same book as a fresh build, and reads only what a change can reach."""

import json

import changed_pages
import pytest
from sphinx.application import Sphinx
from sphinx.util.docutils import docutils_namespace

PAGES = {
    "index.md": "# Top\n\n```{toctree}\na\nb\n```\n",
    "a.md": "# First\n\nSee {doc}`b`.\n\n```{index} entry of the first\n```\n",
    "b.md": "# Second\n\nNothing.\n",
}


class Book:
    """A small book that can be built again and again."""

    def __init__(self, folder):
        self.folder, self.read = folder, []
        self.keys, self.common = folder / "keys.json", folder / "common.py"
        (folder / "src").mkdir()
        (folder / "library").mkdir()
        for name, text in PAGES.items():
            self.write(name, text)
        self.common.write_text("")
        self.know(a="1", b="1")

    def write(self, name, text):
        (self.folder / "src" / name).write_text(text)

    def know(self, **keys):
        found = {str(self.folder / "src" / f"{name}.md"): key for name, key in keys.items()}
        self.keys.write_text(json.dumps(found))

    def build(self, out="out", *, warns=False):
        """Build, and give the names of the pages that were read."""
        read, source = [], str(self.folder / "src")
        known = changed_pages.ChangedPages(self.keys, [self.common], self.folder / "library")
        with docutils_namespace():
            app = Sphinx(
                srcdir=source,
                confdir=None,
                outdir=str(self.folder / out),
                doctreedir=str(self.folder / f"{out}-trees"),
                buildername="html",
                confoverrides={
                    "extensions": ["myst_parser"],
                    "html_theme": "basic",
                    "source_suffix": {".md": "markdown"},  # else the default is changed for all
                },
                status=None,
                warning=None,
            )
            changed_pages.connect(app, known)
            known.begin(app)  # the builder is there already
            app.connect("env-before-read-docs", lambda app, env, names: read.extend(names))
            app.build()
        assert bool(app._warncount) == warns
        return set(read)

    def html(self, out="out"):
        """Text of what was built, by name."""
        found = (path for path in sorted((self.folder / out).glob("*.html")))
        return {path.name: path.read_text() for path in found} | {
            "search": json.dumps(_search(self.folder / out), sort_keys=True)
        }


def _search(folder):
    text = (folder / "searchindex.js").read_text()
    found = json.loads(text[text.index("(") + 1 : text.rindex(")")])
    return {key: found[key] for key in ("docnames", "titles", "indexentries", "alltitles")}


@pytest.fixture
def book(tmp_path):
    made = Book(tmp_path)
    assert made.build() == {"index", "a", "b"}
    return made


def test_without_a_change_only_the_root_is_read(book):
    assert book.build() == {"index"}


def test_a_change_of_the_text_is_seen(book):
    book.write("b.md", "# Second\n\nSomething.\n")
    assert book.build() == {"index", "b"}
    assert "Something" in book.html()["b.html"]


def test_a_page_that_computes_something_else_is_read(book):
    book.know(a="1", b="2")
    assert book.build() == {"index", "b"}
    assert book.build() == {"index"}


def test_a_title_that_changed_is_told_to_all_pages(book):
    book.write("b.md", "# Another\n\nNothing.\n")
    book.build()
    assert "Another" in book.html()["a.html"]
    book.build("fresh")
    assert book.html() == book.html("fresh")


def test_the_search_keeps_what_is_not_read_again(book):
    assert "entry of the first" in book.html()["search"]
    book.write("b.md", "# Second\n\nSomething.\n")
    book.build()
    book.build("fresh")
    assert book.html() == book.html("fresh")


@pytest.mark.parametrize("what", ["common", "library", "keys"])
def test_what_concerns_all_pages_makes_all_be_read(book, what):
    if what == "common":
        book.common.write_text("changed = True")
    elif what == "library":
        (book.folder / "library" / "new.py").write_text("")
    else:
        book.keys.unlink()
    assert book.build() == {"index", "a", "b"}


def test_a_page_of_what_no_longer_exists_goes(book):
    left = book.folder / "out" / "left.html"
    left.write_text("of a module that is gone")
    book.build()
    assert left.exists()
    (book.folder / "library" / "new.py").write_text("")
    book.build()
    assert not left.exists()
    book.build("fresh")
    assert book.html() == book.html("fresh")


def test_a_warning_comes_again_until_it_is_mended(book):
    book.write("b.md", "# Second\n\n{doc}`nowhere`\n")
    book.build(warns=True)
    assert book.build(warns=True) == {"index", "a", "b"}
    book.write("b.md", "# Second\n\nNothing.\n")
    book.build()
    assert book.build() == {"index"}
