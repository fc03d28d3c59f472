"""Everything that is wrong with a task, told at once: one line a fault."""

from __future__ import annotations

from collections.abc import Sequence

from ..errors import InputError

#: Faults that are told; the last line counts the others.
MOST_TOLD = 20


class TaskFaults(InputError):
    """Several faults of one scene or task; the attributes of the base are those of the first.

    Attributes
    ----------
    faults : tuple of InputError
    """

    def __init__(self, faults: Sequence[InputError]) -> None:
        first = faults[0]
        super().__init__(first.source, first.field, first.value, first.expected)
        self.faults = tuple(faults)

    def __reduce__(self) -> tuple[type, tuple[tuple[InputError, ...]]]:
        return TaskFaults, (self.faults,)

    @property
    def lines(self) -> list[str]:
        """One line for each fault."""
        told = [str(fault) for fault in self.faults[:MOST_TOLD]]
        more = len(self.faults) - len(told)
        return told + [f"{self.source}: {more} more of the kind"] * bool(more)

    def __str__(self) -> str:
        return "\n".join(self.lines)
