"""Who wins where: the documents' methods against today's, task by task.

Two methods meet the same tasks, so that the difference of their shares is one of paired
proportions. Its interval of 95 % is method 10 of R. G. Newcombe, Improved confidence intervals for
the difference between binomial proportions based on paired data, Statist. Med. 17, 1998: Wilson's
intervals of both shares, joined with the correlation of the outcomes.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import sqrt
from typing import NamedTuple

import numpy as np
import pandas as pd

from ..ledger.shares import Share
from .study import PAPERS
from .summary import TASK, methods_of


class Duel(NamedTuple):
    """Two methods on the same tasks.

    Attributes
    ----------
    first, second : str
        Their names.
    tasks : int
    only_first, only_second : int
        Tasks that one does and the other does not.
    shares : (Share, Share)
    difference : Share
        Share of the first less that of the second, with the ends of its interval.
    """

    first: str
    second: str
    tasks: int
    only_first: int
    only_second: int
    shares: tuple[Share, Share]
    difference: Share

    @property
    def verdict(self) -> str:
        """What became of the first: it wins, it loses, or the tasks do not decide it."""
        if self.difference.low > 0.0:
            return "wins"
        return "loses" if self.difference.high < 0.0 else "undecided"

    @property
    def told(self) -> str:
        """The difference with its interval."""
        return "{:+.0%} [{:+.0%}, {:+.0%}]".format(*self.difference)


def successes(rows: pd.DataFrame) -> pd.DataFrame:
    """Whether a method did a feasible task: tasks by methods, boolean."""
    mine = rows[rows["feasible"]]
    found = mine.pivot_table(index=list(TASK), columns="method", values="success", aggfunc="max")
    return found.reindex(columns=methods_of(mine)).fillna(False).astype(bool)


def duel(rows: pd.DataFrame, first: str, second: str) -> Duel:
    """Two methods on the feasible tasks of some rows."""
    done = successes(rows)
    a, b = (done[name].to_numpy() for name in (first, second))
    shares = Share.of(int(a.sum()), len(a)), Share.of(int(b.sum()), len(b))
    only = int((a & ~b).sum()), int((b & ~a).sum())
    return Duel(first, second, len(done), *only, shares, paired_difference(a, b))


def paired_difference(a: np.ndarray, b: np.ndarray) -> Share:
    """p_a - p_b of paired outcomes (N,), with its interval (Newcombe's method 10)."""
    p, q = Share.of(int(a.sum()), len(a)), Share.of(int(b.sum()), len(b))
    both, neither = int((a & b).sum()), int((~a & ~b).sum())
    first, second = int((a & ~b).sum()), int((b & ~a).sum())
    margins = float(a.sum() * (~a).sum() * b.sum() * (~b).sum())
    phi = (both * neither - first * second) / sqrt(margins) if margins else 0.0

    def joined(x: float, y: float) -> float:
        return sqrt(max(x * x - 2.0 * phi * x * y + y * y, 0.0))

    value = p.value - q.value
    down = joined(p.value - p.low, q.high - q.value)
    up = joined(q.value - q.low, p.high - p.value)
    return Share(value, value - down, value + up)


def halves(rows: pd.DataFrame, papers: Sequence[str] = PAPERS) -> dict[str, Duel]:
    """The best of the documents' methods against the best of the others, by kind and on all tasks.

    The best is the one that does most of these tasks, the first of the list among equals.
    """
    found = {}
    for kind in (*dict.fromkeys(rows["kind"]), "all"):
        mine = rows if kind == "all" else rows[rows["kind"] == kind]
        shares = successes(mine).mean()
        ours = [name for name in shares.index if name in papers]
        others = [name for name in shares.index if name not in papers]
        if mine["feasible"].any() and ours and others:
            found[kind] = duel(mine, str(shares[ours].idxmax()), str(shares[others].idxmax()))
    return found


def compared(met: Mapping[str, Duel]) -> pd.DataFrame:
    """The halves as a table, one line a kind."""
    found = {}
    for kind, one in met.items():
        ours, others = ("{:.0%} [{:.0%}, {:.0%}]".format(*share) for share in one.shares)
        found[kind] = {
            "tasks": one.tasks,
            "best of the documents'": one.first,
            "does": ours,
            "best of today's": one.second,
            "does ": others,
            "difference": one.told,
            "the documents' best": one.verdict,
        }
    return pd.DataFrame.from_dict(found, orient="index").rename_axis("tasks of kind")


def against(rows: pd.DataFrame, reference: str) -> pd.DataFrame:
    """Every method against one: tasks that only one of the two does, difference, and verdict."""
    found = {}
    for name in successes(rows).columns.drop(reference):
        one = duel(rows, name, reference)
        found[name] = {
            "does alone": one.only_first,
            f"{reference} alone": one.only_second,
            "difference": one.told,
            f"against {reference}": one.verdict,
        }
    return pd.DataFrame.from_dict(found, orient="index").rename_axis("method")
