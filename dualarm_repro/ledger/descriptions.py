"""Descriptions of the project that archives read: CITATION.cff, codemeta.json and .zenodo.json.

All come from one :class:`..project.Project` and the bibliographic records of the documents, so they
cannot disagree. A field that neither gives, such as a DOI, is in none of them.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import yaml

from .files import to_json
from .project import Project
from .schema import Document

_CFF_TYPE = {
    "article": "article",
    "inproceedings": "conference-paper",
    "patent": "patent",
    "misc": "generic",
}
_SCHEMA_TYPE = {"article": "ScholarlyArticle", "inproceedings": "ScholarlyArticle"}
_MESSAGE = "Cite this project for reproduced results, and the documents for what they say."
#: CITATION.cff wants a name where the source has none.
_NOBODY = "not named in the source"
_SPDX = "https://spdx.org/licenses/"
_CODEMETA = "https://doi.org/10.5063/schema/codemeta-2.0"
_HEAD = "# Written by `make metadata` from pyproject.toml and data/papers; do not edit.\n"


def citation_cff(project: Project, documents: Iterable[Document]) -> str:
    """Text of CITATION.cff, version 1.2.0 of the format."""
    content = {
        "cff-version": "1.2.0",
        "message": _MESSAGE,
        "type": "software",
        "title": project.title,
        "abstract": f"{project.summary}.",
        "version": project.version,
        "authors": [{"name": name} for name in project.authors],
        "license": [project.licence, project.text_licence],
        "keywords": list(project.keywords),
        "references": [_cff_reference(document) for document in documents],
    }
    dump: str = yaml.safe_dump(content, sort_keys=False, allow_unicode=True, width=100)
    return _HEAD + dump


def _cff_reference(document: Document) -> dict[str, Any]:
    people = [_parts(name) for name in document.authors]
    original = _original(document)
    entry = {
        "type": _CFF_TYPE[document.type],
        "title": document.title,
        "authors": [{"family-names": f, "given-names": g} for f, g in people]
        or [{"name": _NOBODY}],
        "languages": [document.language] if document.language else None,
        "journal": document.journal,
        "year": int(document.year) if document.year and document.year.isdigit() else None,
        "notes": " ".join(text for text in (original, document.note) if text),
    }
    return {field: value for field, value in entry.items() if value}


def _original(document: Document) -> str:
    """Title and names in the script of the source, in words: the format has no field for them."""
    title = document.title_original and f"Original title: {document.title_original}."
    names = ", ".join(original_names(document))
    return " ".join(text for text in (title, names and f"Authors: {names}.") if text)


def original_names(document: Document) -> list[str]:
    """Names of the authors in the script of the source, family name first, without a comma."""
    return ["".join(_parts(name)) for name in document.authors_original]


def codemeta(project: Project, documents: Iterable[Document]) -> str:
    """Text of codemeta.json, version 2.0 of the vocabulary."""
    content = {
        "@context": _CODEMETA,
        "@type": "SoftwareSourceCode",
        "identifier": project.name,
        "name": project.title,
        "description": f"{project.summary}.",
        "version": project.version,
        "author": [{"@type": "Organization", "name": name} for name in project.authors],
        "license": [_SPDX + project.licence, _SPDX + project.text_licence],
        "keywords": list(project.keywords),
        "copyrightYear": int(project.year),
        "programmingLanguage": "Python",
        "runtimePlatform": f"Python {project.python}",
        "citation": [schema_org(document) for document in documents],
    }
    return to_json(content)


def schema_org(document: Document) -> dict[str, Any]:
    """A document in the vocabulary of schema.org, names in both scripts."""
    originals = original_names(document) or [""] * len(document.authors)
    people = []
    for name, original in zip(document.authors, originals, strict=True):
        family, given = _parts(name)
        person = {"@type": "Person", "familyName": family, "givenName": given}
        people.append(person | ({"alternateName": original} if original else {}))
    entry = {
        "@type": _SCHEMA_TYPE.get(document.type, "CreativeWork"),
        "identifier": document.id,
        "name": document.title,
        "alternateName": document.title_original,
        "author": people,
        "inLanguage": document.language,
        "isPartOf": document.journal,
        "datePublished": document.year,
        "description": document.note,
    }
    return {field: value for field, value in entry.items() if value}


def zenodo(project: Project, documents: Iterable[Document]) -> str:
    """Text of .zenodo.json; the archive knows one licence, of the code; the other is a note."""
    content = {
        "upload_type": "software",
        "title": project.title,
        "description": f"{project.summary}.",
        "version": project.version,
        "creators": [{"name": name} for name in project.authors],
        "license": project.licence.lower(),
        "access_right": "open",
        "keywords": list(project.keywords),
        "language": "eng",
        "notes": f"Text and figures are under {project.text_licence}. {_MESSAGE}",
        "references": [_reference(document) for document in documents],
    }
    return to_json(content)


def _reference(document: Document) -> str:
    """A document in one line."""
    names = "; ".join(document.authors) or _NOBODY
    title = f"{document.title}."
    return " ".join(text for text in (f"{names}:", title, _original(document)) if text)


def _parts(name: str) -> tuple[str, str]:
    """Family name and given name."""
    family, _, given = name.partition(",")
    return family.strip(), given.strip()
