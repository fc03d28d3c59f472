"""Command line: print, compute, verify, export and cite the items of the ledger."""

from __future__ import annotations

import json
import os
import sys
from enum import StrEnum
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Console
from rich.table import Table
from tqdm import tqdm
from typer.exceptions import TyperException

from .errors import DualArmError, LedgerError, UnknownNameError
from .ledger import Registry
from .ledger.schema import Kind

app = typer.Typer(
    add_completion=False,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
    help="Reproduced figures, tables, equations and claims of four documents on dual-arm robots.",
)

Ids = Annotated[list[str], typer.Argument(metavar="ID...", help="item ids, e.g. xue.fig05")]
OneId = Annotated[str, typer.Argument(metavar="ID", help="item id, e.g. xue.tab01")]
AsJson = Annotated[bool, typer.Option("--json", help="machine-readable output")]
#: Draws of `sensitivity` for an item of which the book draws none.
_DRAWS = 16
#: Rows of a table that `run` prints.
_ROWS = 12


class CitationFormat(StrEnum):
    """Formats of a citation."""

    BIBTEX = "bibtex"
    CSL_JSON = "csl-json"


@app.command("list")
def list_items(
    paper: Annotated[str | None, typer.Option(help="one document: xue, qiu, patent, pan")] = None,
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
    table = Table("id", "kind", "verdict", "title", box=None)
    for made in records:
        table.add_row(made["id"], made["kind"], made["verdict"], made["title"])
    _console().print(table)


@app.command()
def show(item_id: OneId, as_json: AsJson = False) -> None:
    """Show one item: printed, obtained, verdict, assumptions, errata, robustness."""
    made = _record(_registry(), item_id)
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
    from .ledger import evaluate
    from .ledger.export import export
    from .ledger.record import compose
    from .view.card import card_figure

    registry = _registry()
    for item_id in ids:
        registry.item(item_id)
    for item_id in _progress(ids):
        evaluation = evaluate(registry, item_id)
        made = json.loads(_json(compose(registry, evaluation)))
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
    as_json: AsJson = False,
) -> None:
    """Recompute items from nothing and compare them with data/results; exit 1 on any drift."""
    from .ledger import reference

    registry = _registry()
    chosen = ids or list(registry.items)
    for item_id in chosen:
        registry.item(item_id)
    report = reference.verify(registry, _progress(chosen), update=update)
    if as_json:
        _print_json(report)
    else:
        for verdict, count in report["verdicts"].items():
            print(f"{count:5d} {verdict}")
        for entry in report["drifted"]:
            print(f"{entry['id']} drifted: {'; '.join(entry['differences'])}")
        print(f"{report['checked']} checked, {len(report['drifted'])} drifted")
    if report["drifted"]:
        raise typer.Exit(1)


@app.command()
def sensitivity(
    item_id: OneId,
    samples: Annotated[
        int | None,
        typer.Option(help="draws of the assumptions; default those of the book, or 16"),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Sample the assumptions of an item: how often its verdict holds, and what flips it."""
    from rich.console import Console

    from .ledger import robustness

    registry = _registry()
    with Console(stderr=True).status(f"sampling the assumptions of {item_id}"):
        found = robustness(registry, item_id, samples)
        if found is None and samples is None:  # too slow for the book, not for who asks
            found = robustness(registry, item_id, _DRAWS)
    plain = found.as_json() if found else None
    if as_json:
        _print_json({"id": item_id, "robustness": plain})
    else:
        print(f"{item_id}: {_robustness_line(plain)}")


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
    names: Annotated[list[str] | None, typer.Argument(metavar="[NAME...]")] = None,
    jobs: Annotated[int, typer.Option(min=1, help="worker processes")] = 1,
) -> None:
    """Recompute stored studies whole; without a name, list them and whether they are up to date."""
    registry = _registry()
    for name in names or []:
        if name not in registry.studies:
            expected = f"one of {', '.join(registry.studies) or 'none stored yet'}"
            raise UnknownNameError("study", "NAME", name, expected)
    for name in names or []:
        table = registry.studies[name].run(jobs, progress=sys.stderr.isatty())
        print(f"{name}: {len(table)} cells stored")
    if not names:
        for name, entry in registry.studies.items():
            print(f"{name}: {entry.status()} - {entry.title}")


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
    return tqdm(ids, leave=False, disable=not sys.stderr.isatty() or len(ids) < 2)


def _console() -> Console:
    return Console(width=None if sys.stdout.isatty() else 160, highlight=False, markup=False)


def _json(value: Any) -> str:
    from .ledger.files import to_json

    return to_json(value)


def _print_json(value: Any) -> None:
    print(_json(value), end="")


def _describe(made: dict[str, Any]) -> None:
    """Print a record for a reader."""
    print(f"{made['id']}  {made['title']}  [{made['kind']}, {made['place']}]")
    print(f"verdict: {made['verdict']}" + (f" ({made['change']})" if made["change"] else ""))
    if made["pending"]:
        print(f"pending: {made['pending']}")
    if made["caption"]:
        print(made["caption"])
    for check in made["checks"]:
        mark = "holds" if check["holds"] else "fails"
        found = json.dumps(check["obtained"], ensure_ascii=False)
        print(f"  {mark}: {check['label']}: obtained {found}, expected {check['expected']}")
    for name, value in (made["measured"] or {}).items():
        print(f"  measured: {name} = {value}")
    for entry in made["assumptions"]:
        print(f"  assumption {entry['id']}: {entry['statement']} ({entry['value']})")
    for entry in made["errata"]:
        proof = entry["proof"]
        proved = entry.get("no_proof") if proof is None else _proof_line(proof)
        print(f"  erratum {entry['id']}: {entry['problem']} [{proved}]")
    for datum in made["missing"]:
        print(f"  not printed: {datum}")
    print(f"  robustness: {_robustness_line(made['robustness'])}")


def _proof_line(proof: dict[str, Any]) -> str:
    return f"{'proved' if proof['holds'] else 'PROOF FAILS'}: {proof['statement']}"


def _robustness_line(found: dict[str, Any] | None) -> str:
    if found is None:
        return "rests on no sampled assumption"
    low, high = found["interval"]
    text = (
        f"verdict holds in {found['holds']:.1%} of {found['samples']} draws ({low:.1%}-{high:.1%})"
    )
    flip = found["flip"]
    if flip is None:
        return f"{text}; no single change within the plausible values flips it"
    return f"{text}; flips at {flip['assumption']} = {flip['value']} (nominal {flip['nominal']})"


if __name__ == "__main__":
    main()
