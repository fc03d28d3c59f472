"""Checks that two implementations do the same work, run before either is timed."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike


class DifferentWork(Exception):
    """An implementation that is to be compared gives something else."""


def same(
    ours: Callable[[], ArrayLike], theirs: Callable[[], ArrayLike], within: float
) -> Callable[[], str]:
    """max |ours - theirs| <= ``within``, over arrays of one shape."""

    def check() -> str:
        a, b = np.asarray(ours(), dtype=float), np.asarray(theirs(), dtype=float)
        if a.shape != b.shape:
            raise DifferentWork(f"shapes {a.shape} and {b.shape}")
        if not (np.isfinite(a).all() and np.isfinite(b).all()):
            raise DifferentWork("a number is not finite")
        largest = float(np.abs(a - b).max(initial=0.0))
        if largest > within:
            raise DifferentWork(f"differs by {largest:.2g}, more than {within:.2g}")
        return f"equal to {within:.0e}"

    return check


def holds(what: str, condition: Callable[[], bool]) -> Callable[[], str]:
    """What makes two outcomes as good as each other where they cannot be equal, as for planners:
    ``what`` says it in a phrase, such as "free and not longer"."""

    def check() -> str:
        if not condition():
            raise DifferentWork(f"not {what}")
        return what

    return check


def reference(what: str = "the reference") -> Callable[[], str]:
    """Of the row that the others of its task are compared with."""
    return lambda: what
