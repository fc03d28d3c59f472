"""Which assumption a verdict hangs on, from draws that are there already."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

_BINS = 4
_SHUFFLES = 200
_LEVEL = 0.95


def first_order(values: Sequence[Any], met: Sequence[bool], seed: int) -> float | None:
    """First-order index Var(E[met | x]) / Var(met) of one assumption (Sobol 1993).

    From given draws: the values in four bins of equal count, or by choice, less what shuffled draws
    give on average (Plischke 2010). None where the index is not above 95 % of the shuffled ones, or
    where the outcome never changes, so that chance is not shown as an influence.
    """
    outcome = np.asarray(met, dtype=float)
    if outcome.std() == 0.0:
        return None
    groups = _groups(values)
    rng = np.random.default_rng(seed)
    chance = [_explained(groups, rng.permutation(outcome)) for _ in range(_SHUFFLES)]
    found = _explained(groups, outcome)
    if found <= np.quantile(chance, _LEVEL):
        return None
    return float(max(0.0, found - float(np.mean(chance))))


def _groups(values: Sequence[Any]) -> np.ndarray:
    if all(isinstance(v, int | float) and not isinstance(v, bool) for v in values):
        distinct = np.unique(values)
        if len(distinct) > _BINS:
            ranks = np.argsort(np.argsort(values))
            return ranks * _BINS // len(values)
    return np.unique([repr(value) for value in values], return_inverse=True)[1]


def _explained(groups: np.ndarray, outcome: np.ndarray) -> float:
    counts = np.bincount(groups)
    means = np.bincount(groups, outcome) / np.maximum(counts, 1)
    return float(
        (counts * (means - outcome.mean()) ** 2).sum() / ((outcome - outcome.mean()) ** 2).sum()
    )
