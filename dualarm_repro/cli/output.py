"""What a command prints: tables and panels on a terminal, plain lines in a pipe, JSON on demand."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rich.console import Console


def on_terminal() -> bool:
    """Whether somebody looks at the output."""
    return sys.stdout.isatty()


def console() -> Console:
    """The terminal; text is taken literally."""
    from rich.console import Console

    return Console(highlight=False, markup=False)


def print_table(
    columns: Sequence[str],
    rows: Iterable[Sequence[str]],
    styles: Sequence[str] = (),
    styled: int = 0,
) -> None:
    """A table; in a pipe aligned by blanks, nothing cut and nothing wrapped.

    Parameters
    ----------
    styles
        Of one cell in each row, on a terminal.
    styled
        Number of the column with these cells.
    """
    found = [tuple(row) for row in rows]
    if not on_terminal():
        widths = [max(map(len, column)) for column in zip(columns, *found, strict=True)]
        for row in (columns, *found):
            line = "  ".join(f"{cell:{width}}" for cell, width in zip(row, widths, strict=True))
            print(line.rstrip())
        return
    from rich.table import Table
    from rich.text import Text

    table = Table(box=None, header_style="bold", pad_edge=False)
    for column in columns[:-1]:
        table.add_column(column, no_wrap=True)
    table.add_column(columns[-1])
    for number, row in enumerate(found):
        cells = [Text(cell) for cell in row]
        if styles:
            cells[styled].stylize(styles[number])
        table.add_row(*cells)
    console().print(table)


def print_json(value: Any) -> None:
    """JSON on standard output."""
    from ..ledger.files import to_json

    print(to_json(value), end="")


def print_written(files: Iterable[Path]) -> None:
    """The files that a command wrote."""
    print("written: " + ", ".join(str(path) for path in files))


def warn(message: str) -> None:
    """A line on standard error."""
    print(f"dualarm: {' '.join(message.split())}", file=sys.stderr)
