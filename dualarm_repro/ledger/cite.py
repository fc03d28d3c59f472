"""Citations of a reproduced result and of the document it reproduces: BibTeX and CSL-JSON."""

from __future__ import annotations

import re
from importlib.metadata import version
from typing import Any

from ..errors import UnknownNameError
from .registry import Registry
from .schema import Document

FORMATS = ("bibtex", "csl-json")
PROJECT = "dualarm_repro"
AUTHORS = "The dualarm_repro developers"
YEAR = "2026"
_CSL_TYPE = {
    "article": "article-journal",
    "inproceedings": "paper-conference",
    "patent": "patent",
    "misc": "document",
}


def cite(registry: Registry, item_id: str, form: str, verdict: str) -> Any:
    """Citation of one item: BibTeX text, or a list of two CSL-JSON entries.

    The first entry is the reproduced result with its verdict and the version of this package, the
    second the document. Fields that the document does not print are left out, never guessed.

    Raises
    ------
    UnknownNameError
        No such item or format.
    """
    if form not in FORMATS:
        raise UnknownNameError("cite", "--format", form, f"one of {', '.join(FORMATS)}")
    item, document = registry.item(item_id), registry.paper_of(item_id).document
    key = re.sub(r"\W+", "_", f"{PROJECT}_{item_id}")
    title = f"{item_id}: {item.title}"
    note = (
        f"Verdict: {verdict}. Reproduces {item.kind} {item_id.partition('.')[2]} of {document.id}"
    )
    number = version(PROJECT)
    if form == "csl-json":
        result = {
            "id": key,
            "type": "software",
            "title": title,
            "author": [{"literal": AUTHORS}],
            "container-title": PROJECT,
            "version": number,
            "issued": {"date-parts": [[int(YEAR)]]},
            "note": note,
        }
        return [result, csl(document)]
    fields = {
        "author": f"{{{AUTHORS}}}",
        "title": f"{{{_escape(title)}}}",
        "howpublished": f"{{{_escape(PROJECT)}, version {number}}}",
        "year": f"{{{YEAR}}}",
        "note": f"{{{_escape(note)}}}",
    }
    return _entry("misc", key, fields) + "\n" + bibtex(document)


def bibtex(document: Document) -> str:
    """BibTeX entry of a document."""
    kind = "misc" if document.type == "patent" else document.type
    venue = "booktitle" if kind == "inproceedings" else "journal"
    fields = {
        "author": " and ".join(document.authors),
        "title": f"{{{_escape(document.title)}}}",
        venue: _escape(document.journal or ""),
        "institution": _escape(document.affiliation or ""),
        "year": document.year or "",
        "note": _escape(document.note or ""),
    }
    return _entry(kind, document.id, {k: f"{{{v}}}" for k, v in fields.items() if v})


def csl(document: Document) -> dict[str, Any]:
    """CSL-JSON entry of a document."""
    people = [name.partition(",") for name in document.authors]
    entry: dict[str, Any] = {
        "id": document.id,
        "type": _CSL_TYPE[document.type],
        "title": document.title,
        "author": [{"family": f.strip(), "given": g.strip()} for f, _, g in people],
    }
    if document.journal:
        entry["container-title"] = document.journal
    if document.year and document.year.isdigit():
        entry["issued"] = {"date-parts": [[int(document.year)]]}
    if document.note:
        entry["note"] = document.note
    return {field: value for field, value in entry.items() if value}


def _entry(kind: str, key: str, fields: dict[str, str]) -> str:
    lines = ",\n".join(f"  {name} = {value}" for name, value in fields.items())
    return f"@{kind}{{{key},\n{lines}\n}}\n"


def _escape(text: str) -> str:
    return re.sub(r"([&%$#_])", r"\\\1", text)
