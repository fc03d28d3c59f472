"""Shared by all tests: a registry, and a quiet and reproducible hypothesis profile.

Records come from the cache of the user, each kept under what it depends on: the suite computes each
once, and the book built after it none.
"""

import matplotlib as mpl
import pytest
from hypothesis import settings

mpl.use("agg")
settings.register_profile("reproducible", deadline=None, derandomize=True, print_blob=True)
settings.load_profile("reproducible")


@pytest.fixture(scope="session")
def registry():
    """The registry with every document loaded."""
    from dualarm_repro.papers import load

    return load()
