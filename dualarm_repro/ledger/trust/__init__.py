"""Whether checkers can fail: what is obtained, printed or assumed is changed, and must be noticed.

A change that nothing notices is a violation. Changes of the method itself are made on a copy of the
sources, see :mod:`.mutants`.
"""

from collections.abc import Callable

from ...errors import LedgerError
from ..registry import Registry
from .by_assumed import assumed
from .by_obtained import obtained
from .by_printed import printed
from .counts import Tally

DIRECTIONS: dict[str, Callable[[Registry, str], Tally]] = {
    "obtained": obtained,
    "printed": printed,
    "assumed": assumed,
}


def tally(registry: Registry, item_id: str, direction: str) -> Tally:
    """Changes of one item in one direction; an item that rests on a stale study stays open."""
    try:
        return DIRECTIONS[direction](registry, item_id)
    except LedgerError as error:
        return Tally(open=(f"{item_id}: {error}",))


__all__ = ["DIRECTIONS", "Tally", "assumed", "obtained", "printed", "tally"]
