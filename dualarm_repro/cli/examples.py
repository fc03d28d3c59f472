"""Commands whose help ends with examples: panels on a terminal, plain text in a pipe."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

from typer.core import TyperCommand, TyperGroup

F = TypeVar("F", bound=Callable[..., Any])


def examples(*lines: str) -> Callable[[F], F]:
    """Decorator: the help of the command ends with these command lines."""

    def attach(function: F) -> F:
        function.examples = lines  # type: ignore[attr-defined]
        return function

    return attach


class Command(TyperCommand):
    """A command whose function carries examples."""

    @property
    def examples(self) -> tuple[str, ...]:
        """Command lines that work as they stand."""
        return tuple(getattr(self.callback, "examples", ()))

    def format_help(self, ctx: Any, formatter: Any) -> None:
        """The help of typer, then the examples."""
        super().format_help(ctx, formatter)
        _write(self.examples, self.rich_markup_mode is not None, formatter)


class Group(TyperGroup):
    """All commands, whose help shows examples, too."""

    examples: tuple[str, ...] = (
        "dualarm list --paper xue",
        "dualarm show xue.tab02",
        "dualarm run xue.tab02 --set base_distance=3.0",
    )

    def format_help(self, ctx: Any, formatter: Any) -> None:
        """The help of typer, then the examples."""
        super().format_help(ctx, formatter)
        _write(self.examples, self.rich_markup_mode is not None, formatter)


def _write(lines: tuple[str, ...], rich: bool, formatter: Any) -> None:
    if not rich:
        formatter.write("\nExamples:\n" + "".join(f"  {line}\n" for line in lines))
        return
    from rich.console import Console
    from rich.panel import Panel

    panel = Panel("\n".join(lines), title="Examples", title_align="left", border_style="dim")
    Console(markup=False, highlight=False).print(panel)
