"""Growth curves: time and peak memory over the size of a problem, each in a process of its own.

A curve is a module of ``curves/`` with ``TITLE``, ``X`` and a function ``series()``, or ``times()``
where it measures in a way of its own. Peers are timed by turns with ours at every size, up to the
largest that is worth waiting for.
"""

from __future__ import annotations

import json
import os
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
SHARE = BUDGET / 20.0  # of the seconds of a task of a suite
#: glibc keeps what it was given. Else every call on a million poses gets fresh pages, whose handing
#: out by the system takes as long as the poses, and what grows is not the work.
KEEPING = {"MALLOC_MMAP_MAX_": "0", "MALLOC_TRIM_THRESHOLD_": str(2**36)}


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
    """

    name: str
    prepare: Callable[[int], Callable[[], object]]
    sizes: Sequence[int]
    limit: bool = False


def names() -> list[str]:
    """Every curve."""
    return sorted(path.stem for path in CURVES.glob("*.py"))


def curves(rounds: int = ROUNDS, budget: float = BUDGET) -> list[dict[str, object]]:
    """Every curve: times in one fresh process, and peak memory of ours alone in another.

    Parameters
    ----------
    rounds, budget
        At most so many rounds, and seconds, at each size.

    Raises
    ------
    RuntimeError
        A curve could not be measured.
    """
    return [
        {**_child(name, "times", rounds, budget), "peak_mb": _child(name, "memory", 1, budget)}
        for name in names()
    ]


def _child(name: str, what: str, rounds: int, budget: float) -> dict[str, object]:
    command = [sys.executable, __file__, name, what, str(rounds), str(budget)]
    made = subprocess.run(
        command, stdout=subprocess.PIPE, stderr=None, text=True, env=os.environ | KEEPING
    )
    if made.returncode:
        raise RuntimeError(f"growth curve {name}, {what}: exit code {made.returncode}")
    return dict(json.loads(made.stdout.splitlines()[-1]))


def times(
    title: str, x: str, series: Sequence[Series], rounds: int = ROUNDS, budget: float = BUDGET
) -> dict[str, object]:
    """Median wall and CPU seconds of a call, with quartiles, of every series at each size."""
    points: dict[str, list[dict[str, object]]] = {one.name: [] for one in series}
    for size in sorted({size for one in series for size in one.sizes}):
        rows = [
            Row(str(size), one.name, one.prepare(size), 1) for one in series if size in one.sizes
        ]
        for timing in by_turns(rows, rounds, budget):
            wall = timing.wall
            points[timing.row.implementation].append(
                {"x": size, "seconds": wall.median, "quartiles": [wall.low, wall.high],
                 "cpu_seconds": timing.cpu.median}
            )  # fmt: skip
        del rows, timing  # before arrays of the next size are made
    return {
        "title": title,
        "x": x,
        "series": [{"name": s.name, "limit": s.limit, "points": points[s.name]} for s in series],
    }


def memory(series: Sequence[Series]) -> dict[str, float]:
    """Peak of resident memory [MB], interpreter and libraries included, by size: what the process
    has reached when ours, the first series, was called once at each size up to it."""
    ours, peak = series[0], {}
    for size in ours.sizes:
        call = ours.prepare(size)
        call()
        peak[str(size)] = _peak()
        del call
    return peak


def _peak() -> float:
    status = Path("/proc/self/status")
    if status.is_file():  # what getrusage says there a process inherits from the one that began it
        words = dict(line.split(":", 1) for line in status.read_text().splitlines())
        return round(int(words["VmHWM"].split()[0]) * 1024 / 1e6, 1)
    unit = 1 if sys.platform == "darwin" else 1024
    return round(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit / 1e6, 1)


def main(name: str, what: str, rounds: int, budget: float) -> None:
    """Measure one curve and print it as one line of JSON."""
    curve = import_module(f"curves.{name}")
    if what == "memory":
        print(json.dumps(memory(curve.series()) if getattr(curve, "MEMORY", True) else {}))
        return
    own = getattr(curve, "times", None)
    found = own() if own else times(curve.TITLE, curve.X, curve.series(), rounds, budget)
    print(json.dumps({"name": name, **found}))


if __name__ == "__main__":
    sys.path.append(str(Path(__file__).resolve().parents[1]))
    main(sys.argv[1], sys.argv[2], int(sys.argv[3]), float(sys.argv[4]))
