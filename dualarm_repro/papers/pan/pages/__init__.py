"""The pages of `pan`, with the checkers of the items that they show."""

from . import cell, measure, optimum, search

__all__ = ["cell", "measure", "optimum", "search"]
