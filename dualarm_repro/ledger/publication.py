"""The whole ledger as files: JSON, CSV, Parquet, citations, schemas, claims, and one zip of all.

The same records give the same bytes: rows and members are in order, and no file carries a date.
"""

from __future__ import annotations

import hashlib
import json
import zipfile
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from .claims import manifest
from .crate import NAME as CRATE
from .crate import Part, crate
from .descriptions import citation_cff, codemeta
from .files import to_json, write, write_text
from .headlines import Statement
from .ledger_table import ledger_table
from .project import Project
from .schema import Document

#: Files of an export, with what they are; the schemas are named after what they describe.
FILES = {
    "ledger.json": "Every record of the ledger, in the order of the documents",
    "ledger.csv": "One row an item; nested values are JSON texts",
    "ledger.parquet": "The same table as Parquet",
    "citations.bib": "The documents in BibTeX",
    "citations.json": "The documents in CSL-JSON",
    "CITATION.cff": "How to cite the project",
    "codemeta.json": "The project in the CodeMeta vocabulary",
    "repro.yaml": "Numbers of the book, for `claims verify` to look up in ledger.json",
}
SCHEMA = "schemas/{}.json"
CRATE_TEXT = "RO-Crate metadata: what each file is, who made it, under which licence"
ZIP, ZIP_TEXT = "ledger.zip", "All files in one"
_SCHEMA_TEXT = {
    "schemas/ledger.json": "JSON Schema of ledger.json",
    "schemas/paper.json": "JSON Schema of a document's file with its items (data/papers)",
    "schemas/record.json": "JSON Schema of the record of one item",
    "schemas/robot.json": "JSON Schema of a robot file (data/robots)",
    "schemas/scenario.json": "JSON Schema of a scenario of velocity control (data/scenes)",
    "schemas/scene.json": "JSON Schema of a scene file (data/scenes)",
    "schemas/task.json": "JSON Schema of a task file for `dualarm plan`",
}
#: The earliest date a zip can hold.
_DATE = (1980, 1, 1, 0, 0, 0)


def publish(
    records: Sequence[dict[str, Any]],
    folder: Path,
    project: Project,
    documents: Iterable[Document],
    schemas: Mapping[str, dict[str, Any]],
    statements: Iterable[Statement] = (),
) -> list[Path]:
    """Write every file of an export below ``folder``.

    Parameters
    ----------
    records
        Of all items, as :func:`..record.record` makes them.
    schemas
        Name to JSON Schema.
    statements
        Numbers that were stated before, to be looked up in ``ledger.json``.

    Returns
    -------
    list of Path
        The files written; the zip, which holds all others, is the last.

    Raises
    ------
    OutputError
        The folder cannot be written.
    """
    documents = list(documents)
    texts = _texts(records, project, documents, statements)
    texts |= {SCHEMA.format(name): to_json(schema) for name, schema in schemas.items()}
    parts = {name: Part(text) for name, text in names(schemas).items() if name not in (CRATE, ZIP)}
    about = f"The ledger of {project.name} {project.version}: {len(records)} items"
    texts[CRATE] = crate(project, documents, parts, about)
    table = ledger_table(records)
    written = {name: write_text(folder / name, text) for name, text in texts.items()}
    written["ledger.parquet"] = write(
        folder / "ledger.parquet",
        lambda path: table.to_parquet(path, index=False, compression="zstd"),
    )
    members = sorted(written)
    archive = write(folder / ZIP, lambda path: _pack(path, folder, members))
    return [*(written[name] for name in members), archive]


def names(schemas: Iterable[str]) -> dict[str, str]:
    """Name of every file of an export, with what it is.

    Parameters
    ----------
    schemas
        Names of the schemas.
    """
    described = {SCHEMA.format(name): f"JSON Schema of a {name}" for name in schemas}
    described = {name: _SCHEMA_TEXT.get(name, text) for name, text in described.items()}
    return {**FILES, **described, CRATE: CRATE_TEXT, ZIP: ZIP_TEXT}


def _texts(
    records: Sequence[dict[str, Any]],
    project: Project,
    documents: Sequence[Document],
    statements: Iterable[Statement],
) -> dict[str, str]:
    """Content of the text files but schemas and crate."""
    from .cite import bibtex, csl

    ledger = to_json(list(records))
    digest = hashlib.sha256(ledger.encode("utf-8")).hexdigest()
    place = {made["id"]: f"/{k}/obtained" for k, made in enumerate(json.loads(ledger))}
    return {
        "ledger.json": ledger,
        "ledger.csv": ledger_table(records).to_csv(index=False, lineterminator="\n"),
        "citations.bib": "\n".join(bibtex(document) for document in documents),
        "citations.json": to_json([csl(document) for document in documents]),
        "CITATION.cff": citation_cff(project, documents),
        "codemeta.json": codemeta(project, documents),
        "repro.yaml": manifest(
            [one for one in statements if one.item in place],
            {"ledger": ("ledger.json", digest)},
            lambda item: ("ledger", place[item]),
        ),
    }


def _pack(path: Path, folder: Path, members: Iterable[str]) -> None:
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name in members:
            member = zipfile.ZipInfo(name, _DATE)
            member.external_attr = 0o644 << 16
            member.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(member, folder.joinpath(name).read_bytes())
