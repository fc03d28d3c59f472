"""Stored studies of `xue`."""

from . import ablation, comparison, lottery, minima, search, trials

__all__ = ["ablation", "comparison", "lottery", "minima", "search", "trials"]
