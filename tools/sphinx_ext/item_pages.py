"""Sphinx extension: a page for every item of the ledger, with its files beside it.

The pages are no sources of the book, so nothing has to be listed; they are found by the search, and
by the cards, tables and the command line, which link to them.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from html import escape
from itertools import chain
from pathlib import Path
from typing import Any

from docutils import nodes
from docutils.utils import new_document
from sphinx.application import Sphinx

from dualarm_repro.ledger import Registry, record
from dualarm_repro.ledger.project import project
from dualarm_repro.papers import load
from dualarm_repro.view.item_files import FOLDER, links, write_files
from dualarm_repro.view.page import own_page, pictures
from dualarm_repro.view.printed_view import printed_lines
from dualarm_repro.view.structured_data import script, structured_data
from dualarm_repro.view.wording import summary_lines

#: Numbers that the search knows as words, as book/_static/search_numbers.js asks for them.
_NUMBER = re.compile(r"\d+[.,]\d+|\d{3,}")
Page = tuple[str, dict[str, Any], str]


def item_pages(registry: Registry, item_ids: Iterable[str], html: Path) -> Iterator[Page]:
    """Write the files of items and give name, content and template of each page."""
    for item_id in item_ids:
        made, drawn = record(registry, item_id), pictures(registry, item_id)
        write_files(made, drawn, html)
        document = registry.paper_of(item_id).document
        data = structured_data(made, document, project(), links(made, drawn, "../"))
        title = f"{item_id}: {made['title']}"
        body = f"<h1>{escape(title)}</h1>{own_page(registry, item_id)}"
        yield (
            f"{FOLDER}/{item_id}",
            {"title": title, "body": body, "metatags": script(data)},
            "page.html",
        )


def searchable(made: dict[str, Any]) -> nodes.document:
    """What the search knows of an item: title, place, print, what is obtained and decided."""
    tree = new_document(made["id"])
    section = nodes.section(ids=["card"])
    section += nodes.title(text=f"{made['id']}: {made['title']}")
    told = [*summary_lines(made).values(), *printed_lines(made), made["caption"] or ""]
    texts = [made["id"], made["place"], *told, *made["missing"]]
    for text in [*texts, " ".join(dict.fromkeys(chain.from_iterable(map(number_words, texts))))]:
        section += nodes.paragraph(text=text)
    tree += section
    return tree


def number_words(text: str) -> list[str]:
    """The numbers of a text as words, since the search skips what consists of digits."""
    return [f"number_{re.sub('[.,]', '_', found)}" for found in _NUMBER.findall(text)]


def collect(app: Sphinx) -> Iterator[Page]:
    """Give Sphinx the pages when it has written its own."""
    registry = load()
    chosen = list(app.config.item_pages) or list(registry.items)
    yield from item_pages(registry, chosen, Path(app.outdir))
    if app.builder.search:
        feed(app.builder.indexer, [record(registry, item_id) for item_id in chosen])


def feed(indexer: Any, records: Iterable[dict[str, Any]]) -> None:
    """Let the search know the pages of items; the index is then cut to the sources and these."""
    names = set()
    for made in records:
        name = f"{FOLDER}/{made['id']}"
        indexer.feed(name, f"{name}.html", f"{made['id']}: {made['title']}", searchable(made))
        names.add(name)
    prune = indexer.prune
    indexer.prune = lambda sources: prune({*sources, *names})


def setup(app: Sphinx) -> dict[str, Any]:
    """Entry point of Sphinx."""
    app.add_config_value("item_pages", [], "html")
    app.connect("html-collect-pages", collect)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
