"""Print the built book to one PDF with contents, page numbers and bookmarks, ``_build/book.pdf``.

The browser prints every page of the table of contents but those of the reference, folds open.
"""

from __future__ import annotations

import argparse
import asyncio
import sys
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path

import yaml
from browser.binding import Sheet, bind, contents_html, first_pages, numbers_html
from browser.chromium import NOT_RUN, WHY_NOT, browser, executable
from browser.paper import print_page
from bs4 import BeautifulSoup
from prerun import ROOT
from pypdf import PdfReader

#: Folder of pages that are looked up rather than read.
LEFT_OUT = "api/"
NOTE = (
    "All pages but the library reference and the pages of single items, which the built book holds."
)


def outline(book: Path) -> Iterator[tuple[str, str, int]]:
    """Name, part and depth of every page in ``_toc.yml``."""
    toc = yaml.safe_load((book / "_toc.yml").read_text(encoding="utf-8"))
    yield toc["root"], "", 0
    for part in toc["parts"]:
        for chapter in part["chapters"]:
            yield chapter["file"], part["caption"], 0
            for section in chapter.get("sections", []):
                yield section["file"], part["caption"], 1


def title_of(page: Path) -> str:
    """Heading of a built page."""
    heading = BeautifulSoup(page.read_text(encoding="utf-8"), "html.parser").select_one(
        "article h1"
    )
    if heading is None:
        return page.stem
    for mark in heading.select(".headerlink"):
        mark.decompose()
    return heading.get_text().strip()


async def make(html: Path, book: Path, title: str, target: Path, folder: Path) -> int:
    """Print and bind; the number of sheets of paper."""
    chosen = [e for e in outline(book) if not e[0].startswith(LEFT_OUT)]
    chosen = [e for e in chosen if (html / f"{e[0]}.html").is_file()]
    sheets = [
        Sheet(name, title_of(html / f"{name}.html"), part, level, folder / f"{number}.pdf")
        for number, (name, part, level) in enumerate(chosen)
    ]
    async with browser() as running:
        context = await running.new_context(viewport={"width": 900, "height": 1200})
        for sheet in sheets:
            await print_page(context, html / f"{sheet.name}.html", sheet.pdf)

        async def printed(text: str, name: str) -> Path:
            source, paper = folder / f"{name}.html", folder / f"{name}.pdf"
            source.write_text(text, encoding="utf-8")
            await print_page(context, source, paper)
            return paper

        before, length = 1, 0  # how long the contents are does not depend on the numbers in them
        while before != length:
            before = length or before
            first = first_pages(sheets, before)
            contents = await printed(contents_html(title, NOTE, sheets, first, html), "contents")
            length = len(PdfReader(contents).pages)
        count = length + sum(len(PdfReader(sheet.pdf).pages) for sheet in sheets)
        numbers = await printed(numbers_html(count), "numbers")
    return bind(contents, sheets, numbers, html, title, target)


def main(arguments: Sequence[str] | None = None) -> int:
    """Write the PDF; 3 if there is no browser or no book."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--html", type=Path, default=ROOT / "_build" / "html")
    parser.add_argument("--out", type=Path, default=ROOT / "_build" / "book.pdf")
    chosen = parser.parse_args(arguments)
    why = WHY_NOT if executable() is None else f"no book in {chosen.html}; make book builds it"
    if executable() is None or not (chosen.html / "index.html").is_file():
        print(f"pdf: NOT MADE, {why}", file=sys.stderr)
        return NOT_RUN
    title = yaml.safe_load((ROOT / "_config.yml").read_text(encoding="utf-8"))["title"]
    with tempfile.TemporaryDirectory() as name:
        pages = asyncio.run(make(chosen.html, ROOT / "book", title, chosen.out, Path(name)))
    print(f"pdf: {pages} pages, {chosen.out.stat().st_size / 1e6:.1f} MB, {chosen.out}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
