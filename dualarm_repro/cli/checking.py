"""`verify`, `robustness` and `study`: whether what is stored still holds, and how firmly."""

from __future__ import annotations

from difflib import get_close_matches
from fnmatch import fnmatchcase
from typing import Annotated

import typer

from ..errors import InputError, UnknownNameError
from . import completion, output, progress
from .arguments import AsJson, Jobs, OneId, Scheduler, SomeIds
from .examples import examples

#: More draws than anybody waits for.
_MOST_DRAWS = 65536


@examples(
    "dualarm verify",
    "dualarm verify xue.eq01 xue.tab01 --json",
    "dualarm verify --jobs 2",
)
def verify(
    ids: SomeIds = None,
    update: Annotated[bool, typer.Option("--update", help="rewrite the reference instead")] = False,
    jobs: Jobs = 1,
    scheduler: Scheduler = None,
    as_json: AsJson = False,
) -> None:
    """Recompute items and compare them with the reference.

    Nothing that was kept is used; the reference lies in data/results. Exit code 1 on any drift.
    """
    from ..ledger import reference
    from ..papers import load

    registry = load()
    chosen = ids or list(registry.items)
    for item_id in chosen:
        registry.item(item_id)
    report = reference.verify(
        registry,
        chosen,
        update=update,
        jobs=jobs,
        progress=progress.watched(),
        scheduler=scheduler,
    )
    if as_json:
        output.print_json(report)
    else:
        for verdict, count in report["verdicts"].items():
            print(f"{count:5d} {verdict}")
        for entry in report["drifted"]:
            print(f"{entry['id']} drifted: {'; '.join(entry['differences'])}")
        print(f"{report['checked']} checked, {len(report['drifted'])} drifted")
        print(f"{len(report['compared'])} values compared with a bound or tolerance (see --json)")
    if report["drifted"]:
        raise typer.Exit(1)


@examples(
    "dualarm robustness xue.tab02",
    "dualarm robustness xue.claim_overlap --samples 64 --json",
)
def robustness(
    item_id: OneId,
    samples: Annotated[
        int | None,
        typer.Option(min=1, max=_MOST_DRAWS, help="draw anew, so many; default the stored draws"),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Say how firmly a verdict holds, and what flips it.

    The assumptions of the item are drawn over their plausible values; without --samples the stored
    draws answer.
    """
    from ..ledger.record import record
    from ..papers import load

    registry = load()
    with progress.waiting(f"computing {item_id}"):
        made = record(registry, item_id)
    found = made["robustness"]
    if samples is not None:
        from ..ledger.settled import robustness_of_draws

        with progress.waiting(f"sampling the assumptions of {item_id}"):
            found = robustness_of_draws(registry, item_id, samples)
    if as_json:
        output.print_json({"id": item_id, "robustness": found})
    else:
        from ..view.terminal import robustness_line

        print(f"{item_id}: {robustness_line({**made, 'robustness': found, 'draws': 'none'})}")


@examples(
    "dualarm study",
    "dualarm study xue_lottery --jobs 2",
    "dualarm study 'robustness/xue.*' --stale",
    "dualarm study --stale --scheduler tcp://localhost:8786",
)
def study(
    ctx: typer.Context,
    names: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="[NAME...]",
            help="names, or patterns such as 'robustness/xue.*'",
            autocompletion=completion.studies,
        ),
    ] = None,
    jobs: Jobs = 1,
    scheduler: Scheduler = None,
    stale: Annotated[
        bool, typer.Option("--stale", help="only those that are not up to date")
    ] = False,
    as_json: AsJson = False,
) -> None:
    """Recompute stored studies, or list how they stand.

    With names, patterns or --stale they are computed whole, and go on where they were stopped;
    without, each is listed with whether it is up to date.
    """
    computes = bool(names) or stale
    given = {name: ctx.params[name] for name in ("scheduler", "jobs") if _typed(ctx, name)}
    for option, value in given.items():
        if not computes:
            expected = "a NAME or --stale beside it: a list of the studies computes nothing"
            raise InputError("study", f"--{option}", value, expected)
    from ..arena.study import ARENA
    from ..ledger.spot import stored_studies
    from ..papers import load

    with progress.waiting("reading the stored studies"):
        known = {**stored_studies(load()), ARENA.name: ARENA}
        for name in names or []:
            if not any(fnmatchcase(one, name) for one in known):
                near = get_close_matches(name, known, n=3, cutoff=0.3) or list(known)[:3]
                such = f" such as {', '.join(near)}" if near else ", but none is stored"
                raise UnknownNameError(
                    "study", "NAME", name, f"a study{such} (see `dualarm study`)"
                )
        chosen = [
            (entry, entry.status())
            for name, entry in known.items()
            if not names or any(fnmatchcase(name, pattern) for pattern in names)
        ]
    report = []
    for entry, status in chosen:
        if stale and status == "up to date":
            continue
        if computes:
            table = entry.run(jobs, progress.watched(), scheduler=scheduler)
            report.append({"name": entry.name, "cells": len(table)})
            line = f"{entry.name}: {len(table)} cells stored"
        else:
            report.append({"name": entry.name, "status": status, "title": entry.title})
            line = f"{entry.name}: {status} - {entry.title}"
        if not as_json:
            print(line, flush=True)
    if as_json:
        output.print_json(report)


def _typed(ctx: typer.Context, name: str) -> bool:
    """Whether an option stands on the command line."""
    source = ctx.get_parameter_source(name)
    return source is not None and source.name == "COMMANDLINE"
