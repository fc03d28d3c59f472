"""What is stored of `qiu`."""

import pyarrow.parquet as pq
import pytest

from dualarm_repro.datafiles import data_path
from dualarm_repro.ledger import REGISTRY
from dualarm_repro.ledger.reference import read_reference


@pytest.fixture(scope="session")
def stored():
    """Obtained values of the reference, by item without the document."""
    return {k.partition(".")[2]: one["obtained"] for k, one in read_reference("qiu").items()}


@pytest.fixture(scope="session")
def nominal(registry):
    """Values of the assumptions as declared."""
    return REGISTRY.nominal("qiu")


@pytest.fixture(scope="session")
def rows():
    """Rows of a stored study as plain mappings, without the library's reading of them."""
    return lambda name: pq.read_table(data_path("results", f"qiu_{name}.parquet")).to_pylist()
