"""Command line: print, compute, verify, export and cite the items of the ledger."""

from __future__ import annotations

import os
import sys
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from typer.exceptions import TyperException

from .errors import DualArmError, InputError, LedgerError, UnknownNameError
from .ledger.schema import Kind

if TYPE_CHECKING:
    from rich.console import Console

    from .ledger import Registry

app = typer.Typer(
    add_completion=False,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
    help="Reproduced figures, tables, equations and claims of documents on dual-arm robots.",
)

Ids = Annotated[list[str], typer.Argument(metavar="ID...", help="item ids, e.g. xue.fig05")]
OneId = Annotated[str, typer.Argument(metavar="ID", help="item id, e.g. xue.tab01")]
Jobs = Annotated[int, typer.Option(min=1, help="worker processes on this machine")]
Scheduler = Annotated[
    str | None, typer.Option(metavar="ADDRESS", help="a Dask scheduler whose workers compute")
]
AsJson = Annotated[bool, typer.Option("--json", help="machine-readable output")]
#: Rows of a table that `run` prints.
_ROWS = 12


class CitationFormat(StrEnum):
    """Formats of a citation."""

    BIBTEX = "bibtex"
    CSL_JSON = "csl-json"


@app.command("list")
def list_items(
    paper: Annotated[str | None, typer.Option(help="one document, by its id")] = None,
    kind: Annotated[Kind | None, typer.Option(help="one kind of item")] = None,
    as_json: AsJson = False,
) -> None:
    """List the items with their verdicts."""
    registry = _registry()
    if paper is not None and paper not in registry.papers:
        expected = f"one of {', '.join(registry.papers)}"
        raise UnknownNameError("list", "--paper", paper, expected)
    ids = [
        item_id
        for item_id, item in registry.items.items()
        if paper in (None, item_id.partition(".")[0]) and kind in (None, item.kind)
    ]
    records = [_record(registry, item_id) for item_id in _progress(ids)]
    if as_json:
        _print_json(records)
        return
    from rich.table import Table

    from .view.terminal import verdict_text

    table = Table("id", "kind", "verdict", "title", box=None)
    for made in records:
        table.add_row(made["id"], made["kind"], verdict_text(made), made["title"])
    _console().print(table)


@app.command()
def show(
    item_id: OneId,
    as_json: AsJson = False,
    url: Annotated[
        bool, typer.Option("--url", help="only the address of its page in the book")
    ] = False,
) -> None:
    """Show one item: printed, obtained, verdict, witnesses, assumptions, errata, robustness."""
    registry = _registry()
    if url:
        from .view.item_files import where

        registry.item(item_id)
        print(where(item_id))
        return
    made = _record(registry, item_id)
    if as_json:
        _print_json(made)
    else:
        _describe(made)


@app.command()
def run(
    ids: Ids,
    out: Annotated[Path, typer.Option(help="folder for the files")] = Path("out"),
) -> None:
    """Compute items and write ID.json, ID.csv, ID.svg, ID.png and, where there is one, ID.html."""
    from .ledger.export import export
    from .ledger.record import located, make
    from .view.card import card_figure

    registry = _registry()
    for item_id in ids:
        registry.item(item_id)
    for item_id in _progress(ids):
        entry, evaluation = make(registry, item_id)
        made = located(entry["record"])
        files = export(evaluation, made, out, card_figure)
        _describe(made)
        if evaluation.result and (table := evaluation.result.table) is not None:
            print(table.head(_ROWS).to_string(index=False))
            if len(table) > _ROWS:
                print(f"... {len(table)} rows, all in {item_id}.csv")
        _console().print("written: " + ", ".join(str(path) for path in files), soft_wrap=True)


@app.command()
def verify(
    ids: Annotated[list[str] | None, typer.Argument(metavar="[ID...]")] = None,
    update: Annotated[bool, typer.Option(help="rewrite the reference instead")] = False,
    jobs: Jobs = 1,
    scheduler: Scheduler = None,
    as_json: AsJson = False,
) -> None:
    """Recompute items from nothing and compare them with data/results; exit 1 on any drift."""
    from .ledger import reference

    registry = _registry()
    chosen = ids or list(registry.items)
    for item_id in chosen:
        registry.item(item_id)
    report = reference.verify(
        registry,
        chosen,
        update=update,
        jobs=jobs,
        progress=sys.stderr.isatty(),
        scheduler=scheduler,
    )
    if as_json:
        _print_json(report)
    else:
        for verdict, count in report["verdicts"].items():
            print(f"{count:5d} {verdict}")
        for entry in report["drifted"]:
            print(f"{entry['id']} drifted: {'; '.join(entry['differences'])}")
        print(f"{report['checked']} checked, {len(report['drifted'])} drifted")
        print(f"{len(report['compared'])} values compared with a bound or tolerance (see --json)")
    if report["drifted"]:
        raise typer.Exit(1)


@app.command("sensitivity", hidden=True)  # what the command was called before
@app.command()
def robustness(
    item_id: OneId,
    samples: Annotated[
        int | None, typer.Option(help="draw anew, so many; default the stored draws")
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Sample the assumptions of an item: how often print is met, and what flips the verdict."""
    if samples is not None and samples < 1:
        raise InputError("robustness", "--samples", samples, "a positive number")
    registry = _registry()
    made = _record(registry, item_id)
    found = made["robustness"]
    if samples is not None:
        from .ledger.settled import robustness_of_draws

        with _console(stderr=True).status(f"sampling the assumptions of {item_id}"):
            found = robustness_of_draws(registry, item_id, samples)
    if as_json:
        _print_json({"id": item_id, "robustness": found})
    else:
        from .view.terminal import robustness_line

        print(f"{item_id}: {robustness_line(found, made['verdict'])}")


@app.command()
def methods(as_json: AsJson = False) -> None:
    """List the planners that `plan` knows."""
    from .planning.methods import METHODS, settings_schema

    if as_json:
        _print_json(
            [
                {"name": name, "description": m.description, "settings": settings_schema(name)}
                for name, m in METHODS.items()
            ]
        )
        return
    from rich.table import Table

    table = Table("method", "description", box=None)
    for name, entry in METHODS.items():
        table.add_row(name, entry.description)
    _console().print(table)


@app.command()
def plan(
    scene: Annotated[Path, typer.Argument(metavar="SCENE.yaml", help="scene or task file")],
    method: Annotated[str, typer.Option(help="name of a planner, see `dualarm methods`")],
    out: Annotated[Path, typer.Option(help="folder for the files")] = Path("out"),
) -> None:
    """Plan the tasks of your own arms: writes STEM.json, STEM_ARM.csv and STEM.html (3-D)."""
    from .ledger.files import write_text
    from .planning.methods import plan_file
    from .view.plan_report import plan_scene, plan_summary

    found = plan_file(scene, method)
    summary = {"scene": scene.name, "method": method, **plan_summary(found)}
    files = [write_text(out / f"{scene.stem}.json", _json(summary))]
    for name, one in found.plans.items():
        files.append(write_text(out / f"{scene.stem}_{name}.csv", one.to_frame().to_csv()))
    html = plan_scene(found, f"{scene.stem} by {method}").html()
    files.append(write_text(out / f"{scene.stem}.html", html))
    for name, entry in summary["arms"].items():
        print(f"{name}: {entry['reason']} after {entry['steps']} steps")
        if missed := entry["out_of_reach_m"]:
            print(f"  goal out of reach by {missed:.4f} m: planned to the nearest posture")
        if entry["certificate"]:
            certificate = entry["certificate"]
            print(f"  {', '.join(f'{key} {value}' for key, value in certificate.items())}")
    links = summary["links"]
    print(f"closest bodies: {' - '.join(links['pair'])} {links['minimum_distance_m']:.4f} m")
    _console().print("written: " + ", ".join(str(path) for path in files), soft_wrap=True)


@app.command()
def study(
    names: Annotated[
        list[str] | None,
        typer.Argument(metavar="[NAME...]", help="names, or patterns such as 'robustness/xue.*'"),
    ] = None,
    jobs: Jobs = 1,
    scheduler: Scheduler = None,
    stale: Annotated[bool, typer.Option(help="only those that are not up to date")] = False,
) -> None:
    """Recompute stored studies whole; without a name, list them and whether they are up to date."""
    from fnmatch import fnmatchcase

    from .ledger.spot import stored_studies

    known = stored_studies(_registry())
    for name in names or []:
        if not any(fnmatchcase(one, name) for one in known):
            expected = f"one of {', '.join(known) or 'none stored yet'}"
            raise UnknownNameError("study", "NAME", name, expected)
    chosen = [
        entry
        for name, entry in known.items()
        if (not names or any(fnmatchcase(name, pattern) for pattern in names))
        and not (stale and entry.status() == "up to date")
    ]
    for entry in chosen:
        if names or stale:
            table = entry.run(jobs, sys.stderr.isatty(), scheduler=scheduler)
            print(f"{entry.name}: {len(table)} cells stored", flush=True)
        else:
            print(f"{entry.name}: {entry.status()} - {entry.title}")


@app.command()
def cite(
    item_id: OneId,
    form: Annotated[CitationFormat, typer.Option("--format")] = CitationFormat.BIBTEX,
) -> None:
    """Print a citation of one item and of the document it reproduces."""
    from .ledger.cite import cite as citation

    registry = _registry()
    verdict = _record(registry, item_id)["verdict"]
    found = citation(registry, item_id, str(form), verdict)
    if isinstance(found, str):
        print(found, end="")
    else:
        _print_json(found)


@app.command("export")
def export_ledger(
    out: Annotated[Path, typer.Option(help="folder for the files")] = Path("out"),
) -> None:
    """Write the whole ledger: JSON, CSV, Parquet, citations, schemas, claims, and a zip of all."""
    from .ledger.headlines import statements
    from .ledger.project import project
    from .ledger.publication import publish
    from .view.schemas import schemas

    registry, stated = _registry(), statements()
    records = [_record(registry, item_id) for item_id in _progress(list(registry.items))]
    documents = [paper.document for paper in registry.papers.values()]
    files = publish(records, out, project(), documents, schemas(), stated)
    _console().print("written: " + ", ".join(str(path) for path in files), soft_wrap=True)


@app.command("new-document")
def add_document(
    name: Annotated[str, typer.Argument(metavar="ID", help="id of the document, e.g. smith")],
    title: Annotated[str | None, typer.Option(help="its title in English")] = None,
    root: Annotated[
        Path | None, typer.Option(help="the clone to write in; default the one around here")
    ] = None,
) -> None:
    """Add a document to a clone: ledger, room, pages, citation, and one example item to replace."""
    from .new_document import new_document

    with _console(stderr=True).status(f"computing the example of {name}"):
        files = new_document(name, title, root)
    for path in files:
        print(f"written: {path}")
    print(f"next: dualarm show {name}.example, then fill in data/papers/{name}.yaml")


def main() -> None:
    """Entry point: bad input is one line on stderr and exit code 2, a failed check exit code 1."""
    if len(sys.argv) == 1:
        app(["--help"], standalone_mode=False)
        sys.exit(2)
    try:
        sys.exit(app(standalone_mode=False))
    except TyperException as error:
        _fail(error.format_message())
    except LedgerError as error:
        _fail(str(error), code=1)
    except DualArmError as error:
        _fail(str(error))
    except (typer.Abort, KeyboardInterrupt):
        sys.exit(130)
    except BrokenPipeError:  # the reader of a pipe went away
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(0)


def _fail(message: str, code: int = 2) -> None:
    print(f"dualarm: {' '.join(message.split())}", file=sys.stderr)
    sys.exit(code)


def _registry() -> Registry:
    from .papers import load

    return load()


def _record(registry: Registry, item_id: str) -> dict[str, Any]:
    from .ledger import record

    return record(registry, item_id)


def _progress(ids: list[str]) -> Any:
    """Progress on a terminal, silence elsewhere."""
    if not sys.stderr.isatty() or len(ids) < 2:
        return ids
    from tqdm import tqdm

    return tqdm(ids, leave=False)


def _console(stderr: bool = False) -> Console:
    from rich.console import Console

    width = None if (sys.stderr if stderr else sys.stdout).isatty() else 160
    return Console(width=width, highlight=False, markup=False, stderr=stderr)


def _describe(made: dict[str, Any]) -> None:
    from .view.terminal import describe

    print("\n".join(describe(made)))


def _json(value: Any) -> str:
    from .ledger.files import to_json

    return to_json(value)


def _print_json(value: Any) -> None:
    print(_json(value), end="")


if __name__ == "__main__":
    main()
