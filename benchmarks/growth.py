"""Growth curves: time and peak memory over the size of a problem, each in a process of its own.

A curve is a module of ``curves/`` with ``TITLE``, ``X`` and a function ``series()``. Peers are
timed by turns with ours at every size, up to the largest that is worth waiting for.
"""

from __future__ import annotations

import json
import resource
import subprocess
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path

from timing import Row, by_turns

CURVES = Path(__file__).parent / "curves"
ROUNDS, BUDGET = 7, 6.0  # at each size, [1, s]


@dataclass(frozen=True)
class Series:
    """One implementation of a curve.

    Attributes
    ----------
    prepare
        Size to the call that is timed; what it needs is made before.
    sizes
        Increasing; where it ends, a larger one is not worth waiting for.
    limit
        Whether it is a bound of the machine, not an implementation.
    rounds
        At most so many at each size.
    """

    name: str
    prepare: Callable[[int], Callable[[], object]]
    sizes: Sequence[int]
    limit: bool = False
    rounds: int = ROUNDS


def names() -> list[str]:
    """Every curve."""
    return sorted(path.stem for path in CURVES.glob("*.py"))


def curves() -> list[dict[str, object]]:
    """Every curve, measured in a fresh process, so that memory of one is not counted in another.

    Raises
    ------
    RuntimeError
        A curve could not be measured.
    """
    found = []
    for name in names():
        made = subprocess.run([sys.executable, __file__, name], capture_output=True, text=True)
        if made.returncode:
            raise RuntimeError(f"curve {name}: {made.stderr.strip().splitlines()[-1]}")
        found.append(json.loads(made.stdout.splitlines()[-1]))
    return found


def measured(title: str, x: str, series: Sequence[Series]) -> dict[str, object]:
    """Median seconds with quartiles of every series at each of its sizes, and the peak of resident
    memory [MB] that the process had reached when all were timed at a size."""
    points: dict[str, list[dict[str, object]]] = {one.name: [] for one in series}
    peak: dict[str, float] = {}
    for size in sorted({size for one in series for size in one.sizes}):
        rows = [
            Row(str(size), one.name, one.prepare(size), 1, rounds=one.rounds)
            for one in series
            if size in one.sizes
        ]
        for timing in by_turns(rows, ROUNDS, BUDGET):
            wall = timing.wall
            points[timing.row.implementation].append(
                {"x": size, "seconds": wall.median, "quartiles": [wall.low, wall.high],
                 "cpu_seconds": timing.cpu.median}
            )  # fmt: skip
        peak[str(size)] = _peak()
        del rows, timing  # before arrays of the next size are made
    return {
        "title": title,
        "x": x,
        "series": [{"name": s.name, "limit": s.limit, "points": points[s.name]} for s in series],
        "peak_mb": peak,
    }


def _peak() -> float:
    unit = 1 if sys.platform == "darwin" else 1024
    return round(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit / 1e6, 1)


def main(name: str) -> None:
    """Measure one curve and print it as one line of JSON."""
    curve = import_module(f"curves.{name}")
    print(json.dumps({"name": name, **measured(curve.TITLE, curve.X, curve.series())}))


if __name__ == "__main__":
    sys.path.append(str(Path(__file__).resolve().parents[1]))
    main(sys.argv[1])
