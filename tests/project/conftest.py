"""The tools that guard installation and supply are scripts; make them importable."""

import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT / "tools")]


@pytest.fixture(scope="session")
def root():
    """Folder of the clone."""
    return ROOT
