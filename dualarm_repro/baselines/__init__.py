"""Today's planners as real libraries have them, beside the documents' methods, behind one list."""

from .registry import BASELINES, enlist

__all__ = ["BASELINES", "enlist"]
