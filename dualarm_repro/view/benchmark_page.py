"""The stored run of the benchmarks for the reader: machine, claims, and every row as a table."""

from __future__ import annotations

from html import escape

import pandas as pd

from .benchmark_run import BenchmarkRun, Claim, Row
from .cell_table import table
from .page import Page

#: Sign of a bound and unit of its value, by the kind of a claim.
SIGNS = {"faster": "≥", "at most": "≤", "seconds": "≤", "megabytes": "≤"}
UNITS = {"faster": "×", "at most": "×", "seconds": " s", "megabytes": " MB"}


def machine_page(run: BenchmarkRun) -> Page:
    """What the run was measured on and with, how busy the machine was, and which peers are
    missing."""
    busy = [value for pair in run.load.values() for value in pair]
    lines = [
        f"{run.cpu}, {run.vectors}, {run.cores} cores, {run.memory_gb:.0f} GB, {run.system}, "
        f"Python {run.python}. Load of the machine during the run: {min(busy):.1f} to "
        f"{max(busy):.1f} processes; with more processes than cores, times are long and spread, "
        "and only ratios are worth reading.",
        "Libraries: " + ", ".join(f"{name} {v}" for name, v in run.libraries.items()) + ".",
        _missing(run),
    ]
    return Page("".join(f"<p>{escape(line)}</p>" for line in lines))


def _missing(run: BenchmarkRun) -> str:
    if not run.missing:
        return "No peer that the suites know is missing."
    told = ", ".join(f"{name} ({what})" for name, what in run.missing.items())
    return f"Peers that were not installed and are missing from every table: {told}."


def claims_page(run: BenchmarkRun) -> Page:
    """Every claim with what was measured, gate and goal; a missed gate is called missed."""
    rows = [
        {
            "claim": claim.text,
            "measured": claim.reason or value_text(claim, claim.value),
            "gate": f"{SIGNS[claim.kind]} {value_text(claim, claim.gate)}",
            "goal": ""
            if claim.goal is None
            else f"{SIGNS[claim.kind]} {value_text(claim, claim.goal)}",
            "verdict": verdict(claim),
        }
        for claim in run.claims
    ]
    return table(pd.DataFrame(rows))


def value_text(claim: Claim, value: float | None) -> str:
    """A value of a claim with its unit and three digits."""
    return "" if value is None else f"{three_digits(value)}{UNITS[claim.kind]}"


def verdict(claim: Claim) -> str:
    """What became of a claim, in words."""
    if claim.gate_holds is None:
        return "not measured"
    if not claim.gate_holds:
        return "gate MISSED"
    return "goal reached" if claim.goal_holds else "gate holds"


def rows_page(run: BenchmarkRun, *suites: str) -> Page:
    """The rows of some suites, in the order of their tasks; what does other work is named below."""
    chosen = [row for row in run.rows if row.suite in suites]
    absent = [name for name in suites if name not in {row.suite for row in chosen}]
    shown = table(pd.DataFrame([_cells(row) for row in chosen])).html if chosen else ""
    lacking = not_measured(*absent).html if absent else ""
    other = "".join(
        f"<p>Not timed, since it does other work: {escape(one.implementation)} in "
        f"<i>{escape(one.task)}</i> ({escape(one.reason)}).</p>"
        for one in run.different
        if one.suite in suites
    )
    return Page(f"{shown}{lacking}{other}")


def not_measured(*names: str) -> Page:
    """What the page says of suites and curves that the stored run lacks."""
    return Page(f"<p>Not measured in the stored run: {escape(', '.join(names))}.</p>")


def _cells(row: Row) -> dict[str, str]:
    low, high = row.quartiles
    return {
        "task": row.task,
        "implementation": row.implementation,
        "time": duration(row.microseconds),
        "quartiles": f"{duration(low)} – {duration(high)}",
        "CPU": duration(row.cpu_microseconds),
        "times ours": "" if row.ratio is None else three_digits(row.ratio),
        "first call": duration(1e6 * row.first_call_seconds),
        "same work": row.same_work or "not checked",
    }


def three_digits(value: float) -> str:
    """A number to three digits, of thousands with commas."""
    rounded = float(f"{value:.3g}")
    return f"{rounded:,.0f}" if rounded >= 100.0 else f"{rounded:g}"


def duration(microseconds: float) -> str:
    """Three digits with the unit that suits: ns, µs, ms or s."""
    for factor, unit in ((1e3, "ns"), (1.0, "µs"), (1e-3, "ms")):
        if microseconds * factor < 999.5:
            return f"{microseconds * factor:.3g} {unit}"
    return f"{float(f'{microseconds * 1e-6:.3g}'):g} s"


def workers_page(run: BenchmarkRun) -> Page:
    """Seconds of each study by one worker and by more, how much CPU time two take of that of one,
    and how long they start."""
    curve = run.curve("workers")
    if curve is None:
        return not_measured("workers")
    rows = [
        {"study": one.name} | {f"{point.x} workers [s]": point.seconds for point in one.points}
        for one in curve.series
    ]
    frame = pd.DataFrame(rows).rename(columns={"1 workers [s]": "1 worker [s]"})
    if "2 workers [s]" in frame:
        frame["gain of two"] = frame["1 worker [s]"] / frame["2 workers [s]"]
        points = [{point.x: point for point in one.points} for one in curve.series]
        parted = all(p[2].start_seconds is not None for p in points)
        if parted:  # a run before that took wall for CPU time
            frame["CPU time of two / one"] = [p[2].cpu_seconds / p[1].cpu_seconds for p in points]
            frame["start of two [s]"] = [p[2].start_seconds for p in points]
    return table(frame, "{:.2f}")
