"""Stored studies of `patent`."""

from . import tasks

__all__ = ["tasks"]
