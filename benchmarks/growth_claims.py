"""Claims about growth curves: time of twice as much work, peak memory, two workers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from math import log2
from typing import Any

#: Bounds. A doubling may take 5 % more than twice as long, which is noise of the clock and caches.
DOUBLING, NOISE, SMALLEST = 2.0, 1.05, 1_000
PEAK_MB, TWO_WORKERS = 2.0 * 1024**3 / 1e6, 1.8  # 2 GiB


def judged(curves: Sequence[Mapping[str, Any]]) -> list[dict[str, object]]:
    """Claims about the curves that are there, as :func:`claims.judged` gives them."""
    found = {curve["name"]: curve for curve in curves}
    made = []
    if curve := found.get("configurations"):
        ours = curve["series"][0]["points"]
        value = doubling([p for p in ours if p["x"] >= SMALLEST])
        text = "time of twice as many poses, up to ten million"
        made.append(_entry(text, "configurations", "at most", value, NOISE * DOUBLING))
        text = "peak memory of ten million poses [MB]"
        value = max(curve["peak_mb"].values())
        made.append(_entry(text, "configurations", "megabytes", value, PEAK_MB))
    if curve := found.get("workers"):
        gains = [found for one in curve["series"] if (found := gain(one["points"])) is not None]
        text = "two workers, the study that gains least"
        made.append(_entry(text, "workers", "faster", min(gains, default=None), TWO_WORKERS))
    return made


def doubling(points: Sequence[Mapping[str, Any]]) -> float:
    """max over neighbouring sizes of 2^(log(t2/t1) / log(n2/n1)), of CPU time: by how much the time
    of a call grows where its work doubles."""
    pairs = pairwise(points)
    return max(
        2.0 ** (log2(b["cpu_seconds"] / a["cpu_seconds"]) / log2(b["x"] / a["x"])) for a, b in pairs
    )


def gain(points: Sequence[Mapping[str, Any]]) -> float | None:
    """Wall time of one worker over that of two; None where two were not tried."""
    spent = {p["x"]: p["seconds"] for p in points}
    return spent[1] / spent[2] if {1, 2} <= spent.keys() else None


def _entry(text: str, curve: str, kind: str, value: float | None, gate: float) -> dict[str, object]:
    holds = None if value is None else (value >= gate if kind == "faster" else value <= gate)
    return {
        "suite": "growth", "text": text, "task": curve, "ours": "dualarm_repro", "peer": None,
        "kind": kind, "gate": gate, "goal": None, "value": value, "gate_holds": holds,
        "goal_holds": None, "reason": "not measured: one core" if value is None else None,
    }  # fmt: skip
