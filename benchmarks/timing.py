"""One timing: the median time an implementation needs for one item of a task."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from statistics import median

REPEATS = 15


@dataclass(frozen=True)
class Row:
    """A timing; rows of one task are compared with the row whose ``implementation`` is ``OURS``."""

    task: str
    implementation: str
    microseconds: float  # per item
    items: int  # per call


OURS = "dualarm_repro"


def timed(task: str, implementation: str, call: Callable[[], object], items: int) -> Row:
    """Median over ``REPEATS`` calls, after one call that compiles and warms up."""
    call()
    seconds = []
    for _ in range(REPEATS):
        start = time.perf_counter()
        call()
        seconds.append(time.perf_counter() - start)
    return Row(task, implementation, 1e6 * median(seconds) / items, items)
