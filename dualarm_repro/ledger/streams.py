"""Random streams of the cells of a study: cell k has its own, whatever ran before it."""

from __future__ import annotations

import numpy as np


def stream(seed: int, index: int) -> np.random.Generator:
    """Generator of cell ``index`` of a study: entropy ``seed``, spawn key ``(index,)``."""
    return np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(index,)))
