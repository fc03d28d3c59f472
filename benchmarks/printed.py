"""A run as tables for the terminal."""

from __future__ import annotations

from itertools import groupby
from typing import Any

from rich.console import Console
from rich.table import Table
from timing import OURS


def print_report(report: dict[str, Any], width: int = 118) -> None:
    """Rows, claims, growth curves, libraries and what is missing."""
    console = Console(width=width)
    cpu, vectors = report["cpu"], report["vectors"]
    for suite, rows in groupby(report["rows"], key=lambda row: row["suite"]):
        before, after = report["load"][suite]
        title = f"{suite}: {cpu}, {vectors}, medians by turns, load {before} to {after}"
        console.print(_rows(title, list(rows)))
    if report["claims"]:
        console.print(_claims(report["claims"]))
    for one in report["different"]:
        console.print(f"OTHER WORK, not timed: {one['task']}, {one['implementation']}: "
                      f"{one['reason']}")  # fmt: skip
    for curve in report["growth"]:
        console.print(_growth(curve))
    console.print(", ".join(f"{name} {number}" for name, number in report["libraries"].items()))
    if report["missing"]:
        told = (f"{name} ({what})" for name, what in report["missing"].items())
        console.print(f"missing here: {', '.join(told)}")


def _rows(title: str, rows: list[dict[str, Any]]) -> Table:
    table = Table("task", "implementation", title=title)
    for head in ("us per item", "quartiles", "CPU us", f"times {OURS}", "first call"):
        table.add_column(head, justify="right")
    before = None
    for row in rows:
        if before not in (None, row["task"]):
            table.add_section()
        before = row["task"]
        low, high = row["quartiles"]
        threads = f", {row['threads']} threads" if row["threads"] > 1 else ""
        table.add_row(
            row["task"],
            row["implementation"] + threads,
            f"{row['microseconds']:.4g}",
            f"{low:.4g}-{high:.4g}",
            f"{row['cpu_microseconds']:.4g}",
            "" if row["ratio"] is None else f"{row['ratio']:.1f}",
            f"{row['first_call_seconds']:.3g} s",
        )
    return table


def _claims(claims: list[dict[str, Any]]) -> Table:
    table = Table("claim", "suite", title="Claims: the worse ratio of wall and CPU time")
    for head in ("measured", "gate", "goal", "gate holds"):
        table.add_column(head, justify="right")
    for claim in claims:
        sign = ">=" if claim["kind"] == "faster" else "<="
        unit = {"seconds": " s", "megabytes": " MB"}.get(claim["kind"], "x")
        table.add_row(
            claim["text"],
            claim["suite"],
            claim["reason"] or f"{claim['value']:.4g}{unit}",
            f"{sign} {claim['gate']:g}{unit}",
            "" if claim["goal"] is None else f"{sign} {claim['goal']:g}{unit}",
            {True: "yes", False: "NO", None: "?"}[claim["gate_holds"]],
        )
    return table


def _growth(curve: dict[str, Any]) -> Table:
    table = Table(curve["x"], title=curve["title"])
    for series in curve["series"]:
        table.add_column(f"{series['name']} [s]", justify="right")
    table.add_column("peak memory [MB]", justify="right")
    sizes = sorted({point["x"] for series in curve["series"] for point in series["points"]})
    for size in sizes:
        found = [
            next((p["seconds"] for p in series["points"] if p["x"] == size), None)
            for series in curve["series"]
        ]
        peak = curve["peak_mb"].get(str(size))
        table.add_row(
            f"{size:,}",
            *("" if seconds is None else f"{seconds:.3g}" for seconds in found),
            "" if peak is None else f"{peak:.0f}",
        )
    return table
