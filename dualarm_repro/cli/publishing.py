"""`cite`, `export` and `new-document`: what leaves the ledger, and what joins it."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from . import output, progress
from .arguments import AsJson, OneId, Out
from .examples import examples


class CitationFormat(StrEnum):
    """Formats of a citation."""

    BIBTEX = "bibtex"
    CSL_JSON = "csl-json"


@examples(
    "dualarm cite xue.tab01",
    "dualarm cite xue.tab01 --json",
    "dualarm cite xue.tab01 >> references.bib",
)
def cite(
    item_id: OneId,
    form: Annotated[CitationFormat, typer.Option("--format")] = CitationFormat.BIBTEX,
    as_json: Annotated[bool, typer.Option("--json", help="the same as --format csl-json")] = False,
) -> None:
    """Cite one item and the document it reproduces."""
    from ..ledger.cite import cite as citation
    from ..ledger.record import record_or_reason
    from ..papers import load

    registry = load()
    with progress.waiting(f"computing {item_id}"):
        made = record_or_reason(registry, item_id)
    if reason := made.get("unavailable"):
        output.warn(f"cited without a verdict: {reason}")
    form = CitationFormat.CSL_JSON if as_json else form
    found = citation(registry, item_id, str(form), made["verdict"] or "not available")
    if isinstance(found, str):
        print(found, end="")
    else:
        output.print_json(found)


@examples("dualarm export --out ledger", "dualarm export --json")
def export_ledger(out: Out = Path("out"), as_json: AsJson = False) -> None:
    """Write the whole ledger as files.

    JSON, CSV, Parquet, citations, schemas, claims, and a zip of all.
    """
    from ..ledger import record
    from ..ledger.file_set import write_together
    from ..ledger.headlines import statements
    from ..ledger.project import project
    from ..ledger.publication import publish
    from ..papers import load
    from ..view.schemas import schemas

    registry, stated = load(), statements()
    ids = list(registry.items)
    records = [record(registry, item_id) for item_id in progress.each(ids, "reading the ledger")]
    documents = [paper.document for paper in registry.papers.values()]
    with progress.waiting("writing the ledger"):
        about = (project(), documents, schemas(), stated)
        files = write_together(out, lambda staged: publish(records, staged, *about))
    _print_files(files, as_json)


@examples("dualarm new-document smith --title 'Two arms in a cell'")
def add_document(
    name: Annotated[str, typer.Argument(metavar="ID", help="id of the document, e.g. smith")],
    title: Annotated[str | None, typer.Option(help="its title in English")] = None,
    root: Annotated[
        Path | None,
        typer.Option(metavar="DIR", help="the clone to write in; default the one around here"),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Add a document to a clone.

    Writes ledger, room, pages, citation, and one example item to replace.
    """
    from ..new_document import new_document

    with progress.waiting(f"computing the example of {name}"):
        files = new_document(name, title, root)
    if as_json:
        _print_files(files, as_json)
        return
    for path in files:
        print(f"written: {path}")
    print(f"next: dualarm show {name}.example, then fill in data/papers/{name}.yaml")


def _print_files(files: list[Path], as_json: bool) -> None:
    if as_json:
        output.print_json({"files": [str(path) for path in files]})
    else:
        output.print_written(files)
