"""Stored studies of `patent`."""

from . import crossings, tasks

__all__ = ["crossings", "tasks"]
