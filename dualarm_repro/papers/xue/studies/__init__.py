"""Stored studies of `xue`."""

from . import ablation, comparison, lottery, minima, paths, planners, search, trials

__all__ = ["ablation", "comparison", "lottery", "minima", "paths", "planners", "search", "trials"]
