"""The commands, put together when somebody calls one."""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated, Any

import typer
from typer.main import get_command

from . import arena, checking, every_planner, items, publishing, running, scenes, timing
from .examples import Command, Group

#: Every command by its name, in the order of the help.
COMMANDS: dict[str, Callable[..., Any]] = {
    "list": items.list_items,
    "show": items.show,
    "run": running.run,
    "verify": checking.verify,
    "robustness": checking.robustness,
    "study": checking.study,
    "methods": every_planner.methods,
    "plan": every_planner.plan,
    "check": scenes.check,
    "view": scenes.view,
    "time": timing.time,
    "arena": arena.arena,
    "cite": publishing.cite,
    "export": publishing.export_ledger,
    "new-document": publishing.add_document,
}
#: What a command was called before.
_FORMER: dict[str, Callable[..., Any]] = {"sensitivity": checking.robustness}


def application(rich: bool) -> Any:
    """The command that runs all others.

    Parameters
    ----------
    rich
        Whether help is drawn in panels, as on a terminal, or plain.
    """
    made = typer.Typer(
        name="dualarm",
        cls=Group,
        rich_markup_mode="rich" if rich else None,
        pretty_exceptions_enable=False,
        context_settings={"help_option_names": ["-h", "--help"]},
        help="Reproduced figures, tables, equations and claims of documents on dual-arm robots.",
    )
    made.callback()(_options)
    for name, function in COMMANDS.items():
        made.command(name, cls=Command)(function)
    for name, function in _FORMER.items():
        made.command(name, cls=Command, hidden=True)(function)
    return get_command(made)


def _version(wanted: bool) -> None:
    if wanted:
        from .. import __version__

        print(f"dualarm {__version__}")
        raise typer.Exit


def _options(
    version: Annotated[
        bool,
        typer.Option("--version", callback=_version, is_eager=True, help="print the version"),
    ] = False,
) -> None:
    pass
