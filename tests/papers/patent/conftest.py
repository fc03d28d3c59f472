"""What is stored of `patent`."""

import pytest

from dualarm_repro.ledger import REGISTRY
from dualarm_repro.ledger.reference import read_reference


@pytest.fixture(scope="session")
def stored():
    """Obtained values of the reference, by item without the document."""
    return {k.partition(".")[2]: one["obtained"] for k, one in read_reference("patent").items()}


@pytest.fixture(scope="session")
def nominal(registry):
    """Values of the assumptions as declared."""
    return REGISTRY.nominal("patent")
