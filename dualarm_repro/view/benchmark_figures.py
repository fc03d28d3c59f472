"""Figures of the stored run: claims against their gates, growth curves, start-up."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import matplotlib.pyplot as plt
import numpy as np

from .benchmark_page import duration, not_measured, three_digits, verdict
from .benchmark_run import BenchmarkRun, Claim, Curve, Series
from .cell import shown
from .page import Page
from .style import BLACK, BLUE, GREEN, ORANGE, PURPLE, RED, WIDTH, house_style

_ROW = 0.27  # height of a line of names [in]
_MARKS = ("o", "s", "^", "D")
_COLORS = (BLUE, ORANGE, GREEN, PURPLE)
#: Series over N are told here, where a batch no longer fits into the caches.
_TOLD = 100_000


class Told(NamedTuple):
    """A figure, its finding and its alternative text, as :func:`.cell.shown` takes them."""

    figure: Any
    finding: str
    alt: str


def claims_figure(run: BenchmarkRun) -> Told:
    """How many times better than its gate each claim is; what is left of the line is missed."""
    judged = [claim for claim in run.claims if claim.margin is not None]
    missed = [claim for claim in judged if not claim.gate_holds]
    reached = sum(claim.goal_holds is True for claim in judged)
    with house_style():
        figure, ax = plt.subplots(figsize=(WIDTH, 1.1 + _ROW * len(judged)))
        ax.axvline(1.0, color=BLACK, lw=1.2)
        for y, claim in enumerate(judged):
            _claim(ax, y, claim)
        ax.set(xscale="log", xlabel="margin over the gate, which is the line [1]")
        ax.set_yticks(range(len(judged)), [claim.text for claim in judged])
        ax.set_ylim(len(judged) - 0.4, -0.6)
        ax.grid(axis="y", visible=False)
    told = f"{len(judged) - len(missed)} of {len(judged)} gates hold"
    goals = sum(claim.goal is not None for claim in judged)
    named = f" Missed: {'; '.join(claim.text for claim in missed)}." if missed else ""
    open_ones = sum(claim.margin is None for claim in run.claims)
    unknown = f" {open_ones} more claims could not be measured." if open_ones else ""
    finding = f"{told}, and {reached} of {goals} goals are reached.{named}{unknown}"
    marks = "Filled circles: the gate holds; crosses: it is missed; open diamonds: the goal."
    spread = ", ".join(f"{c.text}: {c.margin:.2g} times, {verdict(c)}" for c in judged)
    return Told(figure, f"{finding} {marks}", f"{told}. Margin over the gate: {spread}.")


def _claim(ax: Any, y: float, claim: Claim) -> None:
    holds = bool(claim.gate_holds)
    color, mark = (BLUE, "o") if holds else (RED, "X")
    ax.plot([1.0, claim.margin], [y, y], color=color, lw=1.5, alpha=0.6)
    ax.plot(claim.margin, y, mark, color=color, ms=7)
    if claim.goal is not None:
        beyond = claim.goal / claim.gate if claim.kind == "faster" else claim.gate / claim.goal
        ax.plot(beyond, y, "D", mfc="none", mec=BLACK, ms=6)


def growth_page(run: BenchmarkRun, name: str, per_item: bool = True) -> Page:
    """A growth curve with its finding, or that the run has not measured it."""
    curve = run.curve(name)
    return shown(*growth_figure(curve, per_item)) if curve else not_measured(name)


def start_up_page(run: BenchmarkRun) -> Page:
    """Start-up with its limits, or that the run has not measured it."""
    if any(row.suite == "start_up" for row in run.rows):
        return shown(*start_up_figure(run))
    return not_measured("start_up")


def growth_figure(curve: Curve, per_item: bool = True) -> Told:
    """Time over size with quartiles, of an item or of a whole call; limits of the machine are
    dashed."""
    unit = "µs" if per_item else "ms"
    what = curve.x.removesuffix("s") if per_item else "call"
    with house_style():
        figure, ax = plt.subplots(figsize=(WIDTH, 3.6))
        drawn = iter(zip(_MARKS, _COLORS, strict=True))
        for series in curve.series:
            _line(ax, series, per_item, ("", BLACK) if series.limit else next(drawn))
        ax.set(xlabel=f"{curve.x} [1]", ylabel=f"time of one {what} [{unit}]")
        if _spread(curve):
            ax.set(xscale="log", yscale="log")
        else:
            ax.set_xticks([point.x for point in curve.series[0].points])
            ax.set_ylim(bottom=0.0)
        ax.legend()
    finding = _finding(curve, per_item)
    alt = f"Curves of time over {curve.x}: " + "; ".join(
        f"{s.name} from {_at(s, 0, per_item)} to {_at(s, -1, per_item)}" for s in curve.series
    )
    return Told(figure, finding, f"{alt}.")


def _line(ax: Any, series: Series, per_item: bool, look: tuple[str, str]) -> None:
    x = np.array([point.x for point in series.points])
    scale = 1e6 / x if per_item else np.full(len(x), 1e3)
    mark, color = look
    y = scale * np.array([point.seconds for point in series.points])
    low, high = scale * np.array([point.quartiles for point in series.points]).T
    style = "--" if series.limit else "-"
    ax.plot(x, y, style, marker=mark or None, color=color, ms=5, label=series.name)
    ax.fill_between(x, low, high, color=color, alpha=0.2, lw=0)


def _spread(curve: Curve) -> bool:
    sizes = [point.x for point in curve.series[0].points]
    return max(sizes) >= 20 * min(sizes)


def _at(series: Series, k: int, per_item: bool) -> str:
    point = series.points[k]
    micro = 1e6 * point.seconds / (point.x if per_item else 1)
    return f"{duration(micro)} at {point.x:,}"


def _finding(curve: Curve, per_item: bool) -> str:
    """The growth of ours between the ends, the others beside it, and the memory."""
    ours, *others = curve.series
    first, last = ours.points[0], ours.points[-1]
    grown = f"{three_digits(last.x / first.x)} times as many {curve.x}"
    told = f"{grown} take {three_digits(last.seconds / first.seconds)} times as long"
    if per_item:
        told += f", {_at(ours, 0, True)} and {_at(ours, -1, True)} each"
    beside = [text for other in others if (text := _beside(ours, other))]
    parts = [told, *beside]
    if curve.peak_mb:
        most = three_digits(max(curve.peak_mb.values()))
        parts.append(f"Ours takes at most {most} MB of memory, libraries included")
    return ". ".join(parts) + "."


def _beside(ours: Series, other: Series) -> str:
    """How another series compares with ours, at the largest size up to ``_TOLD`` that both have."""
    sizes = [point.x for point in other.points if point.x <= _TOLD and ours.at(point.x)]
    if not sizes:
        return ""
    mine, theirs, where = ours.at(sizes[-1]), other.at(sizes[-1]), f"At {sizes[-1]:,}"
    if mine is None or theirs is None:
        return ""
    if other.limit:
        return f"{where} ours takes {three_digits(mine / theirs)} times as long as {other.name}"
    return f"{where} {other.name} takes {three_digits(theirs / mine)} times as long as ours"


def start_up_figure(run: BenchmarkRun) -> Told:
    """Seconds of cold processes, with the limit that each has to keep."""
    limits = {c.task: c for c in run.claims if c.suite == "start_up"}
    tasks: Sequence[str] = list(dict.fromkeys(r.task for r in run.rows if r.suite == "start_up"))
    with house_style():
        figure, ax = plt.subplots(figsize=(WIDTH, 1.1 + 1.5 * _ROW * len(tasks)))
        for y, task in enumerate(tasks):
            ours: list[float] = []
            others: list[float] = []
            for row in run.rows:
                if row.suite == "start_up" and row.task == task:
                    kind = ours if row.implementation == "dualarm_repro" else others
                    kind.append(1e-6 * row.microseconds)
            ax.plot(others, [y] * len(others), "o", color=BLACK, mfc="none", ms=5)
            ax.plot(ours, [y] * len(ours), "o", color=BLUE, ms=7)
            if task in limits:
                gate = limits[task].gate
                ax.plot([gate, gate], [y - 0.35, y + 0.35], color=RED, lw=2.5)
        ax.set(xscale="log", xlabel="time until a cold process has ended [s]")
        ax.set_yticks(range(len(tasks)), tasks)
        ax.set_ylim(len(tasks) - 0.4, -0.6)
        ax.plot([], [], "o", color=BLUE, label="dualarm_repro")
        ax.plot([], [], "o", color=BLACK, mfc="none", label="import of others")
        ax.plot([], [], "-", color=RED, lw=2.5, label="limit")
        figure.legend(loc="outside upper center", ncols=3)
    judged = [c for c in limits.values() if c.value is not None]
    over = [c.text for c in judged if not c.gate_holds]
    told = f"{len(judged) - len(over)} of {len(judged)} limits of start-up are kept"
    finding = f"{told}.{' Missed: ' + '; '.join(over) + '.' if over else ''}"
    each = ", ".join(f"{c.text} {c.value:.2g} s (limit {c.gate:g} s)" for c in judged)
    return Told(figure, finding, f"Dots of seconds with limits as bars: {each}.")
