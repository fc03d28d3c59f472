"""Citations of a reproduced result and of the document it reproduces: BibTeX and CSL-JSON.

BibTeX is written by pybtex from plain text. Original titles and names stand beside the English
ones: in BibTeX as ``origtitle`` and ``nameaddon``, the fields biblatex has for them, in CSL-JSON as
``original-title`` and ``original-author``. What a document does not print is left out.
"""

from __future__ import annotations

import re
from typing import Any

from ..errors import UnknownNameError
from .project import Project, project
from .registry import Registry
from .schema import Document, Item

FORMATS = ("bibtex", "csl-json")
_CSL_TYPE = {
    "article": "article-journal",
    "inproceedings": "paper-conference",
    "patent": "patent",
    "misc": "document",
}
#: Where a type names its venue; without one BibTeX calls the entry incomplete.
_VENUE = {"article": "journal", "inproceedings": "booktitle"}
#: BibTeX names a language, CSL-JSON takes its tag.
_LANGUAGE = {"zh": "chinese"}
#: What has a meaning in TeX and pybtex leaves as it is; it escapes the other signs itself.
TEX = {
    "\\": r"\textbackslash{}",
    "{": r"\textbraceleft{}",
    "}": r"\textbraceright{}",
    "$": r"\$",
    "^": r"\textasciicircum{}",
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
    result = _Result(item_id, item, document.id, verdict, project())
    if form == "csl-json":
        return [result.csl(), csl(document)]
    return result.bibtex() + "\n" + bibtex(document)


class _Result:
    """One reproduced result, as a thing to cite."""

    def __init__(
        self, item_id: str, item: Item, paper: str, verdict: str, made_by: Project
    ) -> None:
        self.key = re.sub(r"\W+", "_", f"{made_by.name}_{item_id}")
        self.title = f"{item_id}: {item.title}"
        local = item_id.partition(".")[2]
        self.note = f"Verdict: {verdict}. Reproduces {item.kind} {local} of {paper}"
        self.project = made_by

    def bibtex(self) -> str:
        """BibTeX entry."""
        fields: dict[str, str | None] = {
            "title": self.title,
            "howpublished": f"{self.project.name}, version {self.project.version}",
            "year": self.project.year,
            "note": self.note,
        }
        return _entry("misc", self.key, self.project.authors, fields)

    def csl(self) -> dict[str, Any]:
        """CSL-JSON entry."""
        return {
            "id": self.key,
            "type": "software",
            "title": self.title,
            "author": [{"literal": name} for name in self.project.authors],
            "container-title": self.project.name,
            "version": self.project.version,
            "issued": {"date-parts": [[int(self.project.year)]]},
            "note": self.note,
        }


def bibtex(document: Document) -> str:
    """BibTeX entry of a document, ending with a newline."""
    venue = _VENUE.get(document.type)
    kind = "misc" if venue and not document.journal else document.type
    fields = {
        "title": document.title,
        "origtitle": document.title_original,
        "nameaddon": "; ".join(_together(name) for name in document.authors_original),
        venue or "howpublished": document.journal,
        "institution": document.affiliation,
        "year": document.year,
        "language": _LANGUAGE.get(document.language or "", document.language),
        "note": document.note,
    }
    return _entry(kind, document.id, document.authors, fields)


def csl(document: Document) -> dict[str, Any]:
    """CSL-JSON entry of a document."""
    entry: dict[str, Any] = {
        "id": document.id,
        "type": _CSL_TYPE[document.type],
        "title": document.title,
        "original-title": document.title_original,
        "author": [_csl_name(name) for name in document.authors],
        "original-author": [_csl_name(name) for name in document.authors_original],
        "container-title": document.journal,
        "language": document.language,
        "note": document.note,
    }
    if document.year and document.year.isdigit():
        entry["issued"] = {"date-parts": [[int(document.year)]]}
    return {field: value for field, value in entry.items() if value}


def _entry(kind: str, key: str, authors: Any, fields: dict[str, str | None]) -> str:
    from pybtex.database import BibliographyData, Entry, Person
    from pybtex.database.output.bibtex import Writer

    names = [_tex(name) if "," in name else f"{{{_tex(name)}}}" for name in authors]
    persons = {"author": [Person(name) for name in names]} if names else {}
    written = {name: _tex(value) for name, value in fields.items() if value}
    data = BibliographyData({key: Entry(kind, written, persons)})
    return str(Writer().to_string(data))  # `data.to_string` looks for a writer among all packages


def _tex(text: str) -> str:
    return "".join(TEX.get(sign, sign) for sign in text)


def _csl_name(name: str) -> dict[str, str]:
    family, comma, given = name.partition(",")
    return {"family": family.strip(), "given": given.strip()} if comma else {"literal": name}


def _together(name: str) -> str:
    """A name in the order it is written in East Asian scripts, without the comma of the ledger."""
    return "".join(part.strip() for part in name.split(","))
