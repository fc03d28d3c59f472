"""The faults are brought about by tools, which are scripts; make them importable."""

import shutil
import sys
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT / "tools")]


@pytest.fixture(scope="module")
def shared(tmp_path_factory):
    """A cache without machine code, and what commands give undisturbed."""
    from dualarm_repro.cache_folder import cache_folder

    cache, known = tmp_path_factory.mktemp("cache"), cache_folder()
    record = Path("records") / "xue.eq01.json"
    for name in (Path("sources.json"), record) if known else ():
        if (known / name).is_file():
            (cache / name).parent.mkdir(exist_ok=True)
            shutil.copy2(known / name, cache / name)
    return cache, {}


@pytest.fixture
def lab(tmp_path, shared):
    """A laboratory that tries one of each."""
    from fault_injection.laboratory import Laboratory

    cache, known = shared
    rng = np.random.default_rng(17)
    return Laboratory(tmp_path, rng, repeats=1, few=1, known=known, cache=cache)
