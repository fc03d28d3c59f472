"""`list` and `show`: what the ledger knows."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated, Any

import typer

from ..errors import LedgerError, UnknownNameError
from . import completion, output, progress
from .arguments import AsJson, Kind, OneId
from .examples import examples


@examples(
    "dualarm list",
    "dualarm list --paper xue --kind equation",
    "dualarm list --json > items.json",
)
def list_items(
    paper: Annotated[
        str | None,
        typer.Option(
            metavar="ID", help="one document, by its id", autocompletion=completion.papers
        ),
    ] = None,
    kind: Annotated[Kind | None, typer.Option(help="one kind of item")] = None,
    as_json: AsJson = False,
) -> None:
    """List the items with their verdicts."""
    from ..ledger.record import record_or_reason
    from ..papers import load

    registry = load()
    if paper is not None and paper not in registry.documents:
        expected = f"one of {', '.join(registry.documents)}"
        raise UnknownNameError("list", "--paper", paper, expected)
    ids = [
        item_id
        for item_id, item in registry.items.items()
        if paper in (None, item_id.partition(".")[0]) and kind in (None, item.kind)
    ]
    records = [
        record_or_reason(registry, item_id) for item_id in progress.each(ids, "reading the ledger")
    ]
    if as_json:
        output.print_json(records)
    else:
        _print_list(records)
    _say_unavailable(records)


@examples("dualarm show xue.tab01", "dualarm show xue.tab02 --json", "dualarm show xue.tab02 --url")
def show(
    item_id: OneId,
    as_json: AsJson = False,
    url: Annotated[
        bool, typer.Option("--url", help="only the address of its page in the book")
    ] = False,
) -> None:
    """Show what one item prints, what we obtain, and why.

    After the verdict and the checks behind it come the assumptions with their other plausible
    values, errata, witnesses, what is not printed, how firmly the verdict holds, and the code.
    """
    from ..ledger.record import record_or_reason
    from ..papers import load

    registry = load()
    if url:
        from ..view.item_files import where

        registry.item(item_id)
        print(where(item_id))
        return
    with progress.waiting(f"computing {item_id}"):
        made = record_or_reason(registry, item_id)
    if as_json:
        output.print_json(made)
    else:
        describe(made)
    if reason := made.get("unavailable"):
        raise LedgerError(f"{item_id}: no verdict: {reason}")


def describe(made: dict[str, Any]) -> None:
    """A record in panels on a terminal, in lines in a pipe."""
    if output.on_terminal():
        from ..view.terminal_panels import panels

        output.console().print(panels(made))
        return
    from ..view.terminal import describe as lines

    print("\n".join(lines(made)))


def _print_list(records: list[dict[str, Any]]) -> None:
    from ..view.terminal import verdict_style, verdict_text

    rows = [(made["id"], made["kind"], verdict_text(made), made["title"]) for made in records]
    styles = [verdict_style(made["verdict"]) for made in records]
    output.print_table(("id", "kind", "verdict", "title"), rows, styles, styled=2)


def _say_unavailable(records: Iterable[dict[str, Any]]) -> None:
    """One line for each reason why items have no verdict."""
    reasons: dict[str, list[str]] = {}
    for made in records:
        if reason := made.get("unavailable"):
            reasons.setdefault(reason, []).append(made["id"])
    for reason, ids in reasons.items():
        output.warn(f"no verdict for {', '.join(ids)}: {reason}")
