"""Stored studies of `xue`."""

from . import ablation, lottery, minima, paths, planners, search, trials

__all__ = ["ablation", "lottery", "minima", "paths", "planners", "search", "trials"]
