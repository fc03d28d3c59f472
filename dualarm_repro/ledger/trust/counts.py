"""What a series of changes came to: how many were tried, how many were noticed, which were not."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Tally:
    """Changes of one kind.

    Attributes
    ----------
    tried
        Changes that were made.
    violations
        Those that nothing noticed, one line each.
    open
        What could not be tried, one line each.
    """

    tried: int = 0
    violations: tuple[str, ...] = ()
    open: tuple[str, ...] = field(default=())

    @property
    def killed(self) -> int:
        """Changes that were noticed."""
        return self.tried - len(self.violations)

    @classmethod
    def of(cls, noticed: Iterable[tuple[str, bool]], unable: Iterable[str] = ()) -> Tally:
        """From pairs of a change and whether it was noticed."""
        pairs = list(noticed)
        missed = tuple(line for line, seen in pairs if not seen)
        return cls(len(pairs), missed, tuple(unable))

    def __add__(self, other: Tally) -> Tally:
        return Tally(
            self.tried + other.tried,
            self.violations + other.violations,
            self.open + other.open,
        )
