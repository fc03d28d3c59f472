"""A record in panels and tables for a terminal."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from rich.console import Group, RenderableType
from rich.padding import Padding
from rich.panel import Panel
from rich.table import Table
from rich.text import Text

from .printed_beside import check_rows, in_words, printed_rows
from .terminal import (
    before_rows,
    changed_lines,
    place_lines,
    plausible_text,
    proof_text,
    robustness_line,
    verdict_note,
    verdict_style,
    verdict_text,
)
from .wording import search_lines, short

_OUTCOMES = {"holds": "green", "fails": "red", "open": "yellow"}


def panels(made: dict[str, Any]) -> Group:
    """Everything a record says: the verdict first, then print beside ours, then the grounds."""
    return Group(*_parts(made))


def _parts(made: dict[str, Any]) -> Iterator[RenderableType]:
    style = verdict_style(made["verdict"])
    head = Text.assemble(("verdict: ", "dim"), (verdict_text(made), f"bold {style}"))
    lines = [Text(made["title"], "bold"), *(Text(line) for line in changed_lines(made))]
    lines.append(head + Text(verdict_note(made)))
    lines += [Text(str(made[key])) for key in ("unavailable", "pending") if made.get(key)]
    if made["decided_by"]:
        lines.append(Text(f"no original in the source; decided by {made['decided_by']}"))
    if made["caption"]:
        lines += [Text(), Text(made["caption"])]
    title = Text(f"{made['id']}, {made['kind']}, {made['place']}")
    yield Panel(Group(*lines), title=title, title_align="left", border_style=style)
    yield from _printed(made)
    if made["checks"]:
        yield from (Text(), _checks(made))
    if made["assumptions"]:
        rows = [_assumption(entry) for entry in _influential_first(made)]
        yield from (Text(), _table(("name", "value", "statement"), rows, "Assumptions"))
    if made["context"]:
        values = (f"{entry['id']} = {_value(entry)}" for entry in made["context"])
        yield from _texts("Context, which moves nothing judged", [", ".join(values)])
    yield from _texts("Errata", (f"{e['id']}: {e['problem']} [{proof_text(e)}]"
                                 for e in made["errata"]))  # fmt: skip
    yield from _texts("Not printed", made["missing"])
    yield from _texts("How firmly", _firmness(made))
    yield from _texts("Where", place_lines(made))


def _table(
    columns: Iterable[str], rows: Iterable[Iterable[str]], title: str, styles: Iterable[str] = ()
) -> Table:
    table = Table(
        title=title, title_justify="left", title_style="bold", box=None, header_style="dim",
        pad_edge=True,
    )  # fmt: skip
    for column in columns:
        table.add_column(column, overflow="fold", ratio=2 if column == "statement" else None)
    colours = list(styles)
    for number, row in enumerate(rows):
        cells = [Text(cell) for cell in row]
        if colours:
            cells[0].stylize(colours[number])
        table.add_row(*cells)
    return table


def _checks(made: dict[str, Any]) -> Table:
    rows = [
        (row.outcome, row.what, row.printed, row.obtained + before)
        for row, before in zip(check_rows(made), before_rows(made), strict=True)
    ]
    styles = [_OUTCOMES.get(row[0], "") for row in rows]
    return _table(("", "compared", "expected", "obtained"), rows, "Checks", styles)


def _printed(made: dict[str, Any]) -> Iterator[RenderableType]:
    rows = printed_rows(made)
    if not rows:
        return
    columns = ["", f"printed [{made['unit']}]" if made["unit"] else "printed", "obtained"]
    width = 3 if any(row.obtained for row in rows) else 2
    table = _table(columns[:width], [row[:width] for row in rows], "In print")
    yield from (Text(), table)
    if told := in_words(made):
        yield Padding(Text.assemble(("obtained, in words: ", "dim"), told), (0, 1))


def _influential_first(made: dict[str, Any]) -> list[dict[str, Any]]:
    influence = (made["robustness"] or {}).get("influence", {})
    return sorted(made["assumptions"], key=lambda entry: -influence.get(entry["id"], 0.0))


def _assumption(entry: dict[str, Any]) -> tuple[str, ...]:
    return entry["id"], f"{_value(entry)}\n{plausible_text(entry)}", entry["statement"]


def _value(entry: dict[str, Any]) -> str:
    value = entry["value"]  # a word stays as `--set` reads it
    text = value if isinstance(value, str) else short(value)
    return f"{text} {entry['unit']}" if entry.get("unit") else text


def _firmness(made: dict[str, Any]) -> Iterator[str]:
    if "changed" not in made:
        yield robustness_line(made)
    for entry in made["witnesses"]:
        values = short(entry["values"]) if entry["values"] else "the values as declared"
        yield f"witness ({entry['choice']}): {entry['verdict']} with {values}"
    yield from search_lines(made)
    for name, entry in made["thresholds"].items():
        yield f"threshold {name} = {entry['value']:g}: {entry['reason']}"
    for name, value in (made["measured"] or {}).items():
        yield f"measured here: {name} = {short(value)}"


def _texts(title: str, lines: Iterable[str]) -> Iterator[RenderableType]:
    found = [Text(f"- {line}") for line in lines]
    if found:
        yield Text(f"\n{title}", "bold")
        yield Padding(Group(*found), (0, 1, 0, 1))
