"""Arguments and options that several commands share."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

import typer

from . import completion

#: As ``ledger.schema.Kind``, which is not imported to print a help; a test compares them.
Kind = Literal["figure", "table", "equation", "claim"]

Ids = Annotated[
    list[str],
    typer.Argument(
        metavar="ID", help="item ids, e.g. xue.fig05", autocompletion=completion.item_ids
    ),
]
SomeIds = Annotated[
    list[str] | None,
    typer.Argument(
        metavar="ID",
        help="item ids; without one, all items",
        autocompletion=completion.item_ids,
    ),
]
OneId = Annotated[
    str,
    typer.Argument(
        metavar="ID", help="item id, e.g. xue.tab01", autocompletion=completion.item_ids
    ),
]
Jobs = Annotated[int, typer.Option(min=1, help="worker processes on this machine")]
Scheduler = Annotated[
    str | None, typer.Option(metavar="ADDRESS", help="a Dask scheduler whose workers compute")
]
AsJson = Annotated[bool, typer.Option("--json", help="machine-readable output")]
Out = Annotated[Path, typer.Option(metavar="DIR", help="folder for the files")]
AllowCollision = Annotated[
    bool,
    typer.Option("--allow-collision", help="go on although bodies touch at the start or the goal"),
]
