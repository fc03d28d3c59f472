"""The sources of the book against the registry, without building it."""

import re
from pathlib import Path

import offline_assets
import prerun
import pytest
import yaml
from pybtex.database import parse_file

from dualarm_repro.view.chinese import words

ROOT = Path(__file__).parents[2]
BOOK = ROOT / "book"
SHOW = re.compile(r"^show\(([^)]*)\)", re.MULTILINE)
#: Lines of a cell that a reader still takes in at a glance.
LONGEST_CELL = 20


def shown_on(page):
    """Items that the cells of a page show."""
    calls = SHOW.findall((BOOK / f"{page}.md").read_text(encoding="utf-8"))
    return re.findall(r'"([a-z]+\.[a-z0-9_]+)"', " ".join(calls))


def test_every_item_is_shown_once_on_the_page_it_declares(registry):
    shown = [(item_id, page) for page in prerun.toc_pages(BOOK) for item_id in shown_on(page)]
    assert len(set(shown)) == len(shown)
    assert set(shown) == {(item_id, checker.page) for item_id, checker in registry.checkers.items()}


def test_every_page_is_in_the_table_of_contents():
    pages = {str(path.relative_to(BOOK).with_suffix("")) for path in BOOK.rglob("*.md")}
    assert pages == set(prerun.toc_pages(BOOK))


def test_every_part_opens_with_a_chinese_summary(registry):
    """The first page of a part, and that of each document; one without words has none yet."""
    contents = yaml.safe_load((BOOK / "_toc.yml").read_text(encoding="utf-8"))
    first = {part["chapters"][0]["file"] for part in contents["parts"]}
    first |= {f"{name}/index" for name in registry.papers if name in words().parts}
    assert len(first) >= len(contents["parts"])
    for page in first:
        text = (BOOK / f"{page}.md").read_text(encoding="utf-8")
        called = re.findall(r'^summary_page\("(\w+)"', text, re.MULTILINE)
        assert len(called) == 1, page
        assert called[0] in words().parts
        before = text[: text.index("summary_page(")]
        assert "\n## " not in before, f"{page}: the summary stands at the head"


@pytest.mark.parametrize("term", ["双臂", "虚拟吸引点", "可操作度", "避障", "凸包", "势场"])
def test_the_chinese_entry_has_the_words_one_searches_for(term):
    assert term in (BOOK / "zh.md").read_text(encoding="utf-8")


def test_every_document_has_a_page_and_a_reference(registry):
    references = parse_file(BOOK / "references.bib").entries
    for name, paper in registry.papers.items():
        assert f"{name}/index" in prerun.toc_pages(BOOK)
        assert references[name].fields["title"] == paper.document.title
        people = [f"{p.last_names[0]}, {' '.join(p.first_names)}"
                  for p in references[name].persons.get("author", [])]  # fmt: skip
        assert people == paper.document.authors


def test_cells_are_short():
    for page in prerun.notebooks(BOOK):
        cells = re.findall(r"```\{code-cell\}.*?\n(.*?)```", page.read_text(encoding="utf-8"), re.S)
        assert cells, page
        for cell in cells:
            assert len(cell.strip().splitlines()) <= LONGEST_CELL, f"{page.name}: {cell}"


def test_offline_assets_are_installed():
    for name, source in offline_assets.assets().items():
        assert source.is_file(), name
    config = yaml.safe_load((ROOT / "_config.yml").read_text(encoding="utf-8"))
    assert config["sphinx"]["config"]["mathjax_path"] == offline_assets.MATHJAX


@pytest.mark.parametrize("name", ["README.md", "CONTRIBUTING.md", "CHANGELOG.md", "LICENSE"])
def test_named_files_exist(name):
    """Files and make targets that the text refers to are there."""
    text = (ROOT / name).read_text(encoding="utf-8")
    targets = re.findall(r"^([a-z]+):", (ROOT / "Makefile").read_text(encoding="utf-8"), re.M)
    for target in re.findall(r"`make ([a-z]+)`", text):
        assert target in targets, target
    for path in re.findall(r"\]\(([^)#:]+)\)", text):
        assert (ROOT / path).exists(), path
