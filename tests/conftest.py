"""Shared by all tests: no record cache, a quiet and reproducible hypothesis profile."""

import os

import matplotlib as mpl
import pytest
from hypothesis import settings

os.environ["DUALARM_CACHE"] = "off"
mpl.use("agg")
settings.register_profile("reproducible", deadline=None, derandomize=True, print_blob=True)
settings.load_profile("reproducible")


@pytest.fixture(scope="session")
def registry():
    """The registry with every document loaded."""
    from dualarm_repro.papers import load

    return load()
