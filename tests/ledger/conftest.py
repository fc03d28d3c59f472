"""The toy documents of these tests must leave nothing in the cache of the user."""

import os

import pytest

from dualarm_repro.cache_folder import CACHE_VARIABLE
from dualarm_repro.machine_code import compiled_folder


@pytest.fixture(autouse=True)
def _no_record_cache(monkeypatch):
    """No cache but that of machine code, which is of the package; the folder of the user's."""
    before = os.environ.get(CACHE_VARIABLE)
    if folder := compiled_folder():
        monkeypatch.setenv("NUMBA_CACHE_DIR", str(folder))
    monkeypatch.setenv(CACHE_VARIABLE, "off")
    return before


@pytest.fixture
def kept_records(monkeypatch, _no_record_cache):
    """For tests of the documents themselves, whose records are kept for all."""
    if _no_record_cache is None:
        monkeypatch.delenv(CACHE_VARIABLE)
    else:
        monkeypatch.setenv(CACHE_VARIABLE, _no_record_cache)
