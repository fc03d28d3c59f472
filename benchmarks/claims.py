"""Claims about speed, each judged by two timings of one run."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

from timing import OURS, Timing


class Kind(StrEnum):
    """What is compared with gate and goal."""

    FASTER = "faster"  # time of the peer over ours, at least
    AT_MOST = "at most"  # our time over that of the peer, at most
    SECONDS = "seconds"  # our time of one call, at most


@dataclass(frozen=True)
class Claim:
    """A gate that must hold and, beyond it, a goal.

    The ratio is the worse one of wall and CPU time, so that neither idle waiting nor hidden
    threads can win it.
    """

    text: str
    task: str
    gate: float
    goal: float | None = None
    peer: str | None = None
    kind: Kind = Kind.FASTER
    ours: str = OURS
    threads: int = 1


def judged(claim: Claim, timings: Sequence[Timing], checks: dict[str, str]) -> dict[str, object]:
    """Ratio of a claim and whether gate and goal hold, or why nothing can be said.

    Parameters
    ----------
    checks
        What is known of the equality of the work, by implementation of the claim's task.
    """
    entry: dict[str, object] = {
        "text": claim.text, "task": claim.task, "ours": claim.ours, "peer": claim.peer,
        "kind": str(claim.kind), "gate": claim.gate, "goal": claim.goal, "value": None,
        "gate_holds": None, "goal_holds": None, "reason": None,
    }  # fmt: skip
    here = {
        t.row.implementation: t
        for t in timings
        if t.row.task == claim.task and t.row.threads in (1, claim.threads)
    }
    needed = [claim.ours] if claim.peer is None else [claim.ours, claim.peer]
    if absent := [name for name in needed if name not in here]:
        return {**entry, "reason": f"not measured: {', '.join(absent)}"}
    if claim.kind is not Kind.SECONDS and not all(checks.get(name) for name in needed):
        return {**entry, "reason": "not checked to be the same work"}
    value = value_of(claim.kind, *(here[name] for name in needed))
    return {
        **entry,
        "value": value,
        "gate_holds": _reaches(claim.kind, value, claim.gate),
        "goal_holds": None if claim.goal is None else _reaches(claim.kind, value, claim.goal),
    }


def value_of(kind: Kind, ours: Timing, peer: Timing | None = None) -> float:
    """Ratio of the medians, the worse one of wall and CPU time; of ``SECONDS`` our wall time."""
    if peer is None:
        return ours.wall.median * ours.row.items
    wall, cpu = peer.wall.median / ours.wall.median, peer.cpu.median / ours.cpu.median
    return min(wall, cpu) if kind is Kind.FASTER else 1.0 / min(wall, cpu)


def _reaches(kind: Kind, value: float, bound: float) -> bool:
    return value >= bound if kind is Kind.FASTER else value <= bound
