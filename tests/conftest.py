"""Shared by all tests: a registry, a quiet and reproducible hypothesis profile, the long tests.

Records come from the cache of the user, each kept under what it depends on: the suite computes each
once. A test that is marked ``long`` runs in ``.ci/run`` and ``make trust``; what it tries, another
test tries in short, or the mark gives the reason why none does.
"""

import gc
import signal
import sys
from pathlib import Path

import matplotlib as mpl
import pytest
from hypothesis import settings
from long_tests import COLLECTED
from schedule import DearestFirst, order_of

sys.path.append(str(Path(__file__).parents[1] / "tools" / "sphinx_ext"))

from rare_collections import THRESHOLDS

mpl.use("agg")
settings.register_profile("reproducible", deadline=None, derandomize=True, print_blob=True)
settings.load_profile("reproducible")


def pytest_configure():
    """Hear Ctrl-C, which whoever starts the suite in the background may have ignored."""
    signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_call():
    """What hears Ctrl-C after a test is what did before it: the next ones rely on it."""
    before = signal.getsignal(signal.SIGINT)
    found = yield
    assert signal.getsignal(signal.SIGINT) is before
    return found


@pytest.fixture(scope="session")
def registry():
    """The registry with every document loaded."""
    from dualarm_repro.papers import load

    return load()


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config, items):
    """Before the long tests are left out, remember them; what takes longest starts first."""
    config.stash[COLLECTED] = [
        (item.nodeid, mark and dict(mark.kwargs))
        for item in items
        for mark in [item.get_closest_marker("long")]
    ]
    items.sort(key=lambda item: order_of(item.nodeid))


def pytest_collection_finish():
    """Thousands of tests are no garbage, and looking through them again and again is no test."""
    gc.collect()
    gc.freeze()
    gc.set_threshold(*THRESHOLDS)


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config, log):
    """Groups by what they share, in the order above."""
    config.option.loadscopereorder = False
    return DearestFirst(config, log)
