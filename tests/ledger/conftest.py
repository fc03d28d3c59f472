"""The toy documents of these tests must leave nothing in the cache of the user."""

import pytest


@pytest.fixture(autouse=True)
def _no_record_cache(monkeypatch):
    monkeypatch.setenv("DUALARM_CACHE", "off")
