"""What is known about how firmly a verdict holds."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any


@dataclass(frozen=True)
class Flip:
    """The smallest change of one assumption, all others kept, that changes the verdict.

    ``change`` is the distance to the nominal value as a share of the plausible range (1 for a
    different choice).
    """

    assumption: str
    nominal: Any
    value: Any
    change: float
    verdict: str


@dataclass(frozen=True)
class Robustness:
    """Share of sampled assumption values for which the verdict stays, with its 95 % interval."""

    holds: float
    samples: int
    interval: tuple[float, float]
    varied: tuple[str, ...]
    flip: Flip | None

    def as_json(self) -> dict[str, Any]:
        """Plain mapping for JSON."""
        return {**asdict(self), "interval": list(self.interval), "varied": list(self.varied)}
