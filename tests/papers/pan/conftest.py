"""What is stored of `pan`, and the cell at the position that drawings use."""

from functools import cache

import pytest

from dualarm_repro.ledger import REGISTRY
from dualarm_repro.ledger.reference import read_reference
from dualarm_repro.papers.pan.pages.search import algorithm
from dualarm_repro.papers.pan.reading import at_display


@pytest.fixture(scope="session")
def stored():
    """Obtained values of the reference, by item without the document."""
    return {key.partition(".")[2]: one["obtained"] for key, one in read_reference("pan").items()}


@pytest.fixture(scope="session")
def nominal(registry):
    """Values of the assumptions as declared."""
    return REGISTRY.nominal("pan")


@pytest.fixture(scope="session")
def display(nominal):
    """Cell, jobs and position of the drawings."""
    return at_display(nominal)


@pytest.fixture(scope="session")
def watched():
    """Runs of the declared search that are watched, each made once: they follow no print."""
    return cache(algorithm.declared_trace)
