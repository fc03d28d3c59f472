"""Check a built book against the registry: pages, items, numbers, alt text, network, size.

Every function returns one line per violation, so that an empty list means that all is well.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable, Mapping
from functools import cache
from html import unescape
from pathlib import Path
from posixpath import dirname, join, normpath
from typing import Any

import external_loads
import pandas as pd
from lxml import html as markup
from lxml.cssselect import CSSSelector
from prerun import ROOT, notebooks, toc_pages

Pages = Mapping[str, markup.HtmlElement]
MEGABYTE = 1_000_000
#: A fifth of the book are the pages of the items, another fifth the highlighted sources.
LARGEST_BOOK, LARGEST_PAGE = 85 * MEGABYTE, 3 * MEGABYTE
LARGEST_SCENE = 300_000
_DONE = "✅"
_FAILURES = ("Traceback (most recent call last)", "not found")
#: Links that the library makes; Sphinx looks after those of the text.
_OUR_LINKS = ".cell_output a[href], .ledger-item a[href], .ledger-way a[href]"
#: Where an output may say so: verdicts in words, code such as `if not found:`, refused files.
_NO_FAILURE = ".ledger-legend, .ledger-line, .ledger-findings, .ledger-source, .refused-files"


def read_pages(html: Path) -> dict[str, markup.HtmlElement]:
    """Every HTML page of a built book by its name without suffix."""
    return {
        str(path.relative_to(html).with_suffix("")): markup.document_fromstring(
            path.read_text(encoding="utf-8")
        )
        for path in sorted(html.rglob("*.html"))
    }


#: A selector is compiled once, which takes longer than most of its uses.
_compiled = cache(CSSSelector)


def _select(element: markup.HtmlElement, selector: str) -> list[markup.HtmlElement]:
    return list(_compiled(selector)(element))


@cache
def _ids(page: markup.HtmlElement) -> tuple[str, ...]:
    return tuple(tag.get("id") for tag in page.iter() if tag.get("id") is not None)


def _block(pages: Pages, page: str, anchor: str) -> markup.HtmlElement | None:
    """The element of a page with an id."""
    return pages[page].get_element_by_id(anchor, None) if page in pages else None


def _words(element: markup.HtmlElement | None) -> str:
    """What a reader reads in an element, with single spaces."""
    texts = [] if element is None else element.xpath(".//text()")
    return " ".join(" ".join(texts).split())


def missing_pages(pages: Pages, expected: Iterable[str]) -> list[str]:
    """Pages of the table of contents that were not built."""
    return [f"{name}: listed in _toc.yml, not built" for name in expected if name not in pages]


def misplaced_items(pages: Pages, home: Mapping[str, str]) -> list[str]:
    """Items that do not stand exactly once, on the page their checker declares."""
    found: dict[str, list[str]] = {}
    for name, content in pages.items():
        for anchor in _ids(content):
            found.setdefault(anchor, []).append(name)
    return [
        f"{item_id}: declared for {page}, found on {', '.join(found.get(item_id, ['no page']))}"
        for item_id, page in home.items()
        if found.get(item_id) != [page]
    ]


def wrong_cards(
    pages: Pages, page: str, made: Mapping[str, Any], texts: Iterable[str]
) -> list[str]:
    """Cards whose verdict or numbers are not those of the record now computed.

    Parameters
    ----------
    texts
        Texts of the record that the card must show.
    """
    block = _block(pages, page, made["id"])
    if block is None:
        return [f"{page}: no card of {made['id']}"]
    lines = []
    if not _select(block, f".verdict-{made['verdict']}"):
        lines.append(f"{page}: the card of {made['id']} does not show {made['verdict']}")
    shown = _words(block)
    for text in texts:
        if " ".join(text.split()) not in shown:
            lines.append(f"{page}: the card of {made['id']} does not show {text!r}")
    return lines


def unprinted(pages: Pages, page: str, anchor: str, item_id: str, printed: Any) -> list[str]:
    """Printed words and digits that a card does not show.

    Parameters
    ----------
    printed
        The printed value of the item, of which every leaf has to be on its card.
    """
    from dualarm_repro.ledger.printed import leaves

    shown = _words(_block(pages, page, anchor))
    return [
        f"{page}: the card of {item_id} does not show the printed {leaf!r}"
        for _, leaf in leaves(printed or {})
        if " ".join(str(leaf).split()) not in shown
    ]


def wrong_counts(pages: Pages, page: str, counts: pd.DataFrame) -> list[str]:
    """A table of verdict counts that differs from the registry."""
    table = _block(pages, page, "verdict-counts")
    if table is None:
        return [f"{page}: no table of verdict counts"]
    rows = [[cell.text_content() for cell in row.iter("td")] for row in table.iter("tr")][1:]
    expected = [[str(value) for value in column] for _, column in counts.items()]
    return [] if rows == expected else [f"{page}: shows the counts {rows}, not {expected}"]


def broken_links(pages: Pages, html: Path) -> list[str]:
    """Links in the outputs of cells, which Sphinx does not check, to no page and no file."""
    ids = {name: set(_ids(content)) for name, content in pages.items()}
    lines = []
    for name, content in pages.items():
        for link in _select(content, _OUR_LINKS):
            address, _, anchor = link.get("href").partition("#")
            path = normpath(join(dirname(name), address)) if address else f"{name}.html"
            target = path.removesuffix(".html")
            if target not in pages and html.joinpath(path).is_file():
                continue
            chosen = "=" in anchor  # what a filter of the ledger is set to
            if target not in pages or (anchor and not chosen and anchor not in ids[target]):
                lines.append(f"{name}: the link {link.get('href')} leads nowhere")
    return lines


def images_without_alt(pages: Pages) -> list[str]:
    """Images that say nothing to a reader who cannot see them."""
    return [
        f"{name}: an image without alternative text ({image.get('src', '')[:60]})"
        for name, content in pages.items()
        for image in content.iter("img")
        if not image.get("alt", "").strip()
    ]


def faulty_scenes(pages: Pages) -> list[str]:
    """3-D scenes without a picture for paper and readers without scripts, or too large."""
    lines = []
    for name, content in pages.items():
        for scene in _select(content, "figure.ledger-scene"):
            size, stills = len(markup.tostring(scene)), _select(scene, "img.scene-still")
            if not stills or not stills[0].get("src", "").startswith("data:image/"):
                lines.append(f"{name}: a scene without a still picture")
            if size > LARGEST_SCENE:
                lines.append(f"{name}: a scene of {size} bytes, allowed are {LARGEST_SCENE}")
    return lines


def not_executed(pages: Pages, page: str, expected: Iterable[str]) -> list[str]:
    """Notebooks that the table of executions on ``page`` does not report as run to the end."""
    rows = _select(pages[page], "table tr") if page in pages else []
    cells = [[cell.text_content().strip() for cell in row.iter("td")] for row in rows]
    done = {row[0] for row in cells if row and row[-1] == _DONE}
    return [f"{name}: a notebook that was not executed" for name in expected if name not in done]


def failed_outputs(pages: Pages) -> list[str]:
    """Outputs that show a failure instead of a result, and messages of the builder."""
    lines = [
        f"{name}: an output shows {text!r}"
        for name, content in pages.items()
        for output in _select(content, ".cell_output")
        for text in _FAILURES
        if text in _said(output)
    ]
    return lines + [
        f"{name}: {message.text_content()!r}"
        for name, content in pages.items()
        for message in _select(content, ".system-message, .problematic")
    ]


def _said(output: Any) -> str:
    """Text of an output but for what may say "not found" without a failure."""
    text = output.text_content()
    for part in _select(output, _NO_FAILURE):
        text = text.replace(part.text_content(), "")
    return text


def network_use(pages: Pages, html: Path) -> list[str]:
    """Everything that reaches for another host."""
    lines = [
        f"{name}: loads or links {found}"
        for name, content in pages.items()
        for found in external_loads.in_page(content)
    ]
    return lines + list(external_loads.in_assets(html))


def machine_paths(html: Path, folders: Iterable[Path]) -> list[str]:
    """Pages and notebooks that name a folder of the machine they were built on."""
    lines = []
    for path in sorted([*html.rglob("*.html"), *html.rglob("*.ipynb")]):
        text = unescape(path.read_text(encoding="utf-8"))
        lines += [f"{path.relative_to(html)}: names {f}" for f in folders if str(f) in text]
    return lines


def over_budget(html: Path, book: int = LARGEST_BOOK, page: int = LARGEST_PAGE) -> list[str]:
    """A book or a page with more bytes than a reader should have to load."""
    sizes = {path: path.stat().st_size for path in html.rglob("*") if path.is_file()}
    lines = [
        f"{path.relative_to(html)}: {size / MEGABYTE:.1f} MB, allowed are {page / MEGABYTE:g}"
        for path, size in sizes.items()
        if path.suffix == ".html" and size > page
    ]
    total = sum(sizes.values())
    if total > book:
        lines.append(f"book: {total / MEGABYTE:.1f} MB, allowed are {book / MEGABYTE:g}")
    return lines


def violations(root: Path) -> list[str]:
    """Everything that is wrong with the book built below ``root``."""
    from dualarm_repro.ledger import record
    from dualarm_repro.papers import load
    from dualarm_repro.view.item_files import FOLDER
    from dualarm_repro.view.overview import verdict_counts
    from dualarm_repro.view.rule_sentences import rule_sentence

    registry, book, html = load(), root / "book", root / "_build" / "html"
    pages = read_pages(html)
    home = {item_id: checker.page for item_id, checker in registry.checkers.items()}
    own = [f"{FOLDER}/{item_id}" for item_id in home]
    lines = missing_pages(pages, ["index", *toc_pages(book), *own]) + misplaced_items(pages, home)
    for item_id, page in home.items():
        made = record(registry, item_id)
        sentences = [rule_sentence(check) for check in made["checks"]]
        lines += wrong_cards(pages, page, made, sentences)
        lines += unprinted(pages, page, item_id, item_id, made["printed"])
        lines += unprinted(pages, f"{FOLDER}/{item_id}", "card", item_id, made["printed"])
    for page in ("intro", "ledger"):
        lines += wrong_counts(pages, page, verdict_counts(registry))
    expected = [str(p.relative_to(book).with_suffix("")) for p in notebooks(book)]
    lines += not_executed(pages, "status", expected)
    lines += broken_links(pages, html) + images_without_alt(pages) + failed_outputs(pages)
    lines += faulty_scenes(pages) + network_use(pages, html)
    return lines + machine_paths(html, (root, Path.home())) + over_budget(html)


def main() -> int:
    """Print every violation; 1 if there is any."""
    found = violations(ROOT)
    for line in found:
        print(line, file=sys.stderr)
    print(f"book: {len(found)} violations")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
