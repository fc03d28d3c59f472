"""Stored studies of `xue`."""

from . import ablation, lottery, minima, search, trials

__all__ = ["ablation", "lottery", "minima", "search", "trials"]
