"""RO-Crate metadata of a folder of the project, made with ro-crate-py.

A crate names every file it describes, what it is and under which licence, who made it, and the
documents it reproduces.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import PurePosixPath
from typing import Any

from .descriptions import schema_org
from .files import to_json
from .project import Project
from .schema import Document

NAME = "ro-crate-metadata.json"
_SPDX = "https://spdx.org/licenses/"
_ENCODING = {
    ".bib": "application/x-bibtex",
    ".cff": "application/yaml",
    ".csv": "text/csv",
    ".json": "application/json",
    ".md": "text/markdown",
    ".parquet": "application/vnd.apache.parquet",
    ".toml": "application/toml",
    ".yaml": "application/yaml",
    ".zip": "application/zip",
}


@dataclass(frozen=True)
class Part:
    """One file of a crate: what it is, and whether it is code or data and text."""

    description: str
    code: bool = False


def crate(
    project: Project,
    documents: Iterable[Document],
    files: Mapping[str, Part],
    description: str | None = None,
) -> str:
    """Text of ``ro-crate-metadata.json``; the same bytes for the same input.

    Parameters
    ----------
    files
        Path below the folder, with ``/``: what the file is.
    description
        Of the folder; by default that of the project.
    """
    from rocrate.model import ContextEntity
    from rocrate.rocrate import ROCrate

    made = ROCrate()
    made.name = project.title
    made.description = description or f"{project.summary}."
    made.datePublished = project.year
    root = made.root_dataset
    root["version"] = project.version
    root["keywords"] = list(project.keywords)

    def entity(identifier: str, properties: dict[str, Any]) -> Any:
        plain = {key: value for key, value in properties.items() if value}
        return made.add(ContextEntity(made, identifier, properties=plain))

    licences = {
        name: entity(_SPDX + name, {"@type": "CreativeWork", "name": name})
        for name in (project.licence, project.text_licence)
    }
    makers = [
        entity(f"#{_slug(name)}", {"@type": "Organization", "name": name})
        for name in project.authors
    ]
    root["license"] = list(licences.values())
    root["author"] = makers
    root["citation"] = [_document(entity, document) for document in documents]
    for path in sorted(files):
        part = files[path]
        licence = project.licence if part.code else project.text_licence
        properties = {
            "name": PurePosixPath(path).name,
            "description": part.description,
            "license": licences[licence],
            "author": makers,
        }
        if encoding := _ENCODING.get(PurePosixPath(path).suffix):
            properties["encodingFormat"] = encoding
        made.add_file(dest_path=path, properties=properties)
    return to_json(_ordered(made.metadata.generate()))


def _document(entity: Any, document: Document) -> Any:
    """The document and its authors, as entities of their own."""
    properties = schema_org(document)
    people = properties.pop("author", [])
    properties["author"] = [
        entity(f"#{document.id}-author-{k}", {"name": _full_name(person), **person})
        for k, person in enumerate(people, 1)
    ]
    return entity(f"#{document.id}", properties)


def _full_name(person: dict[str, str]) -> str:
    return f"{person['givenName']} {person['familyName']}".strip()


def _slug(name: str) -> str:
    return "-".join(name.lower().split())


def _ordered(metadata: Any) -> Any:
    """Entities sorted by their identifier, the two that describe the crate first."""
    plain = json.loads(json.dumps(metadata))
    first = {NAME: 0, "./": 1}
    plain["@graph"].sort(key=lambda made: (first.get(made["@id"], 2), made["@id"]))
    return plain
