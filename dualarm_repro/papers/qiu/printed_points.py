"""Points that the document prints about its runs, read from the ledger."""

from __future__ import annotations

import numpy as np

from ...ledger import REGISTRY


def trap() -> np.ndarray:
    """Where the one-way search is said to be trapped (3,) [m]."""
    return _numbers(REGISTRY.printed("qiu.claim_trad_stuck")["tcp"])


def meeting() -> np.ndarray:
    """Where the halves of the master are said to end, forward and backward (2, 3) [m]."""
    return _ends("qiu.claim_bi_meet")


def slave_meeting() -> np.ndarray:
    """Where the halves of the slave are said to end, forward and backward (2, 3) [m]."""
    return _ends("qiu.claim_slave_meet")


def printed_tip(item: str, key: str) -> np.ndarray:
    """A printed point of an item (3,) [m]."""
    return _numbers(REGISTRY.printed(item)[key])


def _ends(item: str) -> np.ndarray:
    printed = REGISTRY.printed(item)
    return np.array([_numbers(printed[half]) for half in ("forward", "backward")])


def _numbers(texts: list[str]) -> np.ndarray:
    return np.array([float(text) for text in texts])
