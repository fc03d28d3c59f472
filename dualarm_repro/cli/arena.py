"""`arena`: every planner on the same tasks, one's own among them."""

from __future__ import annotations

from typing import Annotated, Any

import typer

from . import completion, output, progress
from .arguments import AsJson, Scheduler
from .examples import examples

#: As ``arena.cases.KINDS``, which is not imported to print a help; a test compares them.
KINDS = ("document", "random", "near contact", "one Panda")


@examples(
    "dualarm arena",
    "dualarm arena --jobs 2",
    "dualarm arena --method my-planner --kind random --most 6",
)
def arena(
    method: Annotated[
        list[str] | None,
        typer.Option(
            metavar="NAME",
            help="run only these, see `dualarm methods`, and store nothing",
            autocompletion=completion.methods,
        ),
    ] = None,
    kind: Annotated[
        str | None,
        typer.Option(metavar="KIND", help=f"with --method: one of {', '.join(KINDS)}"),
    ] = None,
    most: Annotated[
        int | None, typer.Option(min=1, help="with --method: only the first so many tasks")
    ] = None,
    jobs: Annotated[
        int | None, typer.Option(min=1, help="compute the stored arena with so many processes")
    ] = None,
    scheduler: Scheduler = None,
    as_json: AsJson = False,
) -> None:
    """Let planners meet on the same tasks, judged by the certified distance of whole links.

    Without options the stored results are told. With --jobs or --scheduler they are computed and
    stored anew in data/results/arena.parquet, and go on where they were stopped. With --method
    planners run now, those of other packages too, and nothing is stored.
    """
    from ..errors import InputError, LedgerError

    if kind is not None and kind not in KINDS:
        raise InputError("arena", "--kind", kind, f"one of {', '.join(KINDS)}")
    for option, value in (("--kind", kind), ("--most", most)):
        if value is not None and not method:
            raise InputError("arena", option, value, "a --method beside it")
    for option, value in (("--jobs", jobs), ("--scheduler", scheduler)):
        if value is not None and method:
            expected = "no --method beside it: chosen planners run here, one after the other"
            raise InputError("arena", option, value, expected)
    with progress.waiting("loading the arena"):
        from ..arena.contest import contest_now
        from ..arena.study import ARENA
        from ..arena.summary import contest
    if method:
        rows = contest_now(method, kind, most, progress.each)
    else:
        if jobs is not None or scheduler is not None:
            ARENA.run(jobs or 1, progress.watched(), scheduler=scheduler)
        if (status := ARENA.status()) != "up to date":
            raise LedgerError(f"arena: {status}; `dualarm arena --jobs 2` computes it")
        rows = contest(ARENA.load())
    _tell(rows, as_json)


def _tell(rows: Any, as_json: bool) -> None:
    from ..arena.summary import outcome_counts, success_table

    told = success_table(rows).join(outcome_counts(rows))
    if as_json:
        output.print_json([{"method": name, **row} for name, row in told.to_dict("index").items()])
        return
    lines = [
        (name, f"{row['share']:.2f} [{row['low']:.2f}, {row['high']:.2f}]", f"{row['claimed']:.2f}",
         str(int(row["tasks"])))
        for name, row in told.iterrows()
    ]  # fmt: skip
    output.print_table(("method", "certified success", "claimed", "tasks"), lines)
