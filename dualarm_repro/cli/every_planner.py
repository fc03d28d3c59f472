"""`methods` and `plan` with every planner: baselines and those of other packages too, or all."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import nullcontext
from functools import wraps
from typing import Any

import typer

from . import NOT_USABLE, output, planners, progress
from .ahead import compiling_ahead

#: Instead of a method: compare them all.
ALL = "all"


def _enlisting(command: Callable[..., None]) -> Callable[..., None]:
    """The command, after every planner has been put on the list; one of the documents, asked for
    by its name, needs none of the others."""

    @wraps(command)
    def enlisted(*given: Any, **named: Any) -> None:
        with progress.waiting("loading the planners"):
            from ..planning.methods import METHODS

            if named.get("method") not in METHODS:
                from ..baselines.registry import enlist

                enlist()
        command(*given, **named)

    return enlisted


methods = _enlisting(planners.methods)


@wraps(planners.plan)
def _plan(*given: Any, **named: Any) -> None:
    if named.get("method") != ALL:
        planners.plan(*given, **named)
        return
    scene = named["scene"]
    with progress.waiting(f"planning {scene.name} by every method"):
        from ..planning.checks.truth import Verdict
        from ..view.plan_report import compare_methods

        table = compare_methods(scene, named["allow_collision"]).reset_index().astype(str)
    if named.get("as_json"):
        output.print_json(table.to_dict("records"))
    else:
        output.print_table(tuple(table.columns), table.itertuples(index=False, name=None))
    if not (table["outcome"] == f"arrived, {Verdict.FREE}").any():
        raise typer.Exit(NOT_USABLE)


_enlisted = _enlisting(_plan)


@wraps(planners.plan)
def plan(*given: Any, **named: Any) -> None:
    """Plan, as :func:`.planners.plan`; a second process compiles while the planners are loaded."""
    with nullcontext() if named["method"] == ALL else compiling_ahead(named["scene"]):
        _enlisted(*given, **named)
