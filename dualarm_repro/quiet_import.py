"""Importing a package of others without the warnings that Python has about its source."""

from __future__ import annotations

from importlib import import_module
from types import ModuleType
from warnings import catch_warnings


def quietly(name: str) -> ModuleType:
    """The module ``name``; what its first compilation warns of is not the user's to mend."""
    with catch_warnings(action="ignore"):
        return import_module(name)
