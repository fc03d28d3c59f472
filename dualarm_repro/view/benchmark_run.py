"""The stored run of the benchmarks, as `benchmarks/run.py --growth --store` wrote it."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Literal

from ..datafiles import StrictModel, data_path, opened
from ..errors import DataFileError


class Row(StrictModel):
    """One implementation of a task: times of one item, and ratios to ours of the same task."""

    suite: str
    task: str
    implementation: str
    threads: int
    items: int
    rounds: int
    microseconds: float
    quartiles: tuple[float, float]
    cpu_microseconds: float
    cpu_quartiles: tuple[float, float]
    first_call_seconds: float
    ratio: float | None
    cpu_ratio: float | None
    same_work: str | None


class Claim(StrictModel):
    """What is claimed, with gate and goal; ``reason`` where nothing could be measured."""

    suite: str
    text: str
    task: str
    ours: str
    peer: str | None
    kind: Literal["faster", "at most", "seconds", "megabytes"]
    gate: float
    goal: float | None
    value: float | None
    gate_holds: bool | None
    goal_holds: bool | None
    reason: str | None

    @property
    def margin(self) -> float | None:
        """How many times better than the gate; below 1 it is missed."""
        if self.value is None:
            return None
        return self.value / self.gate if self.kind == "faster" else self.gate / self.value


class Different(StrictModel):
    """A row that was not timed, since it does other work."""

    suite: str
    task: str
    implementation: str
    reason: str


class Point(StrictModel):
    """Seconds of a call at one size, and where others start first, those until they have."""

    x: int
    seconds: float
    quartiles: tuple[float, float]
    cpu_seconds: float
    start_seconds: float | None = None


class Series(StrictModel):
    """One implementation over the sizes, or a limit of the machine."""

    name: str
    limit: bool
    points: tuple[Point, ...]

    def at(self, x: int) -> float | None:
        """Seconds of a call at a size; None where it was not tried."""
        return next((point.seconds for point in self.points if point.x == x), None)


class Curve(StrictModel):
    """How time and peak memory [MB] grow; the first series is ours."""

    name: str
    title: str
    x: str
    series: tuple[Series, ...]
    peak_mb: dict[int, float]


class BenchmarkRun(StrictModel):
    """A run of every suite on one machine; ``load`` is its mean before and after each suite."""

    cpu: str
    vectors: str
    cores: int
    memory_gb: float
    system: str
    python: str
    libraries: dict[str, str]
    missing: dict[str, str]
    load: dict[str, tuple[float, float]]
    rows: tuple[Row, ...]
    claims: tuple[Claim, ...]
    different: tuple[Different, ...]
    growth: tuple[Curve, ...]

    def curve(self, name: str) -> Curve | None:
        """A growth curve by name; None if this run has not measured it."""
        return next((curve for curve in self.growth if curve.name == name), None)


def stored_path() -> Path:
    """Where the run is stored."""
    return data_path("results", "benchmarks.json")


def stored(path: Path | None = None) -> BenchmarkRun:
    """The stored run.

    Raises
    ------
    DataFileError
        Nothing is stored, or it is not what a run writes.
    """
    path = path or stored_path()
    try:
        content = json.loads(opened(path).read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise DataFileError(path, "file", reason, "a stored run (`make bench` writes it)") from None
    return BenchmarkRun.checked(path, content)
