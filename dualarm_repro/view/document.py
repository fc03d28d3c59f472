"""Views of one document: what it is, its items and verdicts, its errata and their proofs."""

from __future__ import annotations

from html import escape

from ..errors import UnknownNameError
from ..ledger import Registry, record
from ..ledger.cite import bibtex
from ..ledger.record import erratum_record
from ..ledger.schema import PaperFile
from .card import erratum_html
from .item_files import address
from .item_table import item_table
from .page import Page
from .rendering import render


def document_page(registry: Registry, paper: str) -> Page:
    """Bibliographic record of a document, and what its source does not print of it."""
    document = _paper(registry, paper).document
    fields = {
        "Title": document.title,
        "Original title": document.title_original,
        "Authors": "; ".join(document.authors),
        "Affiliation": document.affiliation,
        "Published in": document.journal,
        "Year": document.year,
        "Note": document.note,
        "Not in the source": ", ".join(document.unknown),
    }
    rows = "".join(
        f"<dt>{name}</dt><dd>{escape(value)}</dd>" for name, value in fields.items() if value
    )
    return Page(f'<dl class="ledger-document" id="{paper}.document">{rows}</dl>')


def items_page(registry: Registry, paper: str) -> Page:
    """All items of a document with verdict and reason, for a page one folder below the top."""
    ids = (f"{paper}.{key}" for key in _paper(registry, paper).items)
    return Page(item_table(registry, ids, root="../"))


def sentences_page(registry: Registry, paper: str) -> Page:
    """Every sentence of a document that can be true or false, with the items that judge it and
    their verdicts."""
    sentences = _paper(registry, paper).sentences
    rows = [
        {
            "place": sentence.place,
            "says": sentence.says,
            "unjudged": sentence.unjudged,
            "judged": [("../" + address(name), record(registry, name)) for name in sentence.items],
        }
        for sentence in sentences
    ]
    judged = sum(bool(sentence.items) for sentence in sentences)
    return Page(render("sentences", rows=rows, judged=judged))


def errata_page(registry: Registry, paper: str) -> Page:
    """Errata of a document, those with a machine proof first; every proof runs now."""
    keys = [f"{paper}.{key}" for key in _paper(registry, paper).errata]
    entries = [erratum_record(registry, key) for key in keys]
    entries.sort(key=lambda entry: entry["proof"] is None)
    lines = "".join(f'<li id="{entry["id"]}">{erratum_html(entry)}</li>' for entry in entries)
    proved = sum(entry["proof"] is not None and entry["proof"]["holds"] for entry in entries)
    return Page(
        f'<div class="ledger-errata"><p>{len(entries)} errata, {proved} of them proved by '
        f"computation.</p><ul>{lines}</ul></div>"
    )


def bibliography_page(registry: Registry) -> Page:
    """BibTeX of every document."""
    entries = "\n".join(bibtex(paper.document) for paper in registry.papers.values())
    return Page(f'<pre class="ledger-bibtex">{escape(entries)}</pre>')


def _paper(registry: Registry, name: str) -> PaperFile:
    if name not in registry.papers:
        raise UnknownNameError("ledger", "document", name, f"one of {', '.join(registry.papers)}")
    return registry.papers[name]
