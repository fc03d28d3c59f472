"""The faults are brought about by tools, which are scripts; make them importable."""

import sys
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT / "tools")]


@pytest.fixture
def lab(tmp_path):
    """A laboratory that tries one of each."""
    from fault_injection.laboratory import Laboratory

    return Laboratory(tmp_path, np.random.default_rng(17), repeats=1, few=1)
