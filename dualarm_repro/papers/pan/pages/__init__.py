"""The pages of `pan`, with the checkers of the items that they show."""

from . import cell, measure, optimum, search, weld

__all__ = ["cell", "measure", "optimum", "search", "weld"]
