"""What of a cell hangs on round-off: inputs that differ by next to nothing change it.

A descent along a crease, or a search that turns back and forth where it is stopped, amplifies the
last digit. Another processor rounds otherwise, so that such a value cannot be compared there; that
it hangs on round-off can be shown on this one.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from typing import TYPE_CHECKING, Any

from .workers import deaf

if TYPE_CHECKING:
    from .study import Study

#: Most processes, each with inputs of its own that differ by round-off.
NUDGES = 12


def moved_by_round_off(
    study: Study,
    index: int,
    settings: Mapping[str, Any],
    made: Mapping[str, Any],
    asked: Collection[str],
) -> set[str]:
    """Which values of a cell round-off of the inputs moves.

    Parameters
    ----------
    made
        The cell as this process computes it.
    asked
        Paths of the values in question, as the lines of :func:`.drift.differences` begin.

    Returns
    -------
    set of str
        Those of ``asked`` that move; empty without a way to nudge the inputs.
    """
    from joblib.externals.loky import ProcessPoolExecutor

    moved: set[str] = set()
    for seed in range(NUDGES if study.nudge else 0):
        if moved >= set(asked):
            break
        # A process of its own: what was loaded before would keep its exact inputs.
        executor = ProcessPoolExecutor(max_workers=1)
        try:
            with deaf():
                begun = executor.submit(_nudged, study.nudge, seed, study, index, settings)
            again = begun.result()
        finally:
            executor.shutdown(kill_workers=True)  # which is at work only if we are interrupted
        moved |= {path_of(line) for line in study.differs(made, again)} & set(asked)
    return moved


def path_of(line: str) -> str:
    """The value that a line of :func:`.drift.differences` speaks of."""
    return line.partition(": ")[0]


def _nudged(
    nudge: Callable[[int], None], seed: int, study: Study, index: int, settings: Mapping[str, Any]
) -> dict[str, Any]:
    nudge(seed)
    return study.cell(index, settings)
