"""What is stored of `pan`, and the cell at the position that drawings use."""

import pytest

from dualarm_repro.ledger import REGISTRY
from dualarm_repro.ledger.reference import read_reference
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
