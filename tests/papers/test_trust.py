"""No checker of any document accepts everything: what is obtained and printed is changed."""

import pytest

from dualarm_repro.ledger.trust import tally
from dualarm_repro.papers import load

REGISTRY = load()


@pytest.mark.parametrize("direction", ["obtained", "printed"])
@pytest.mark.parametrize("item_id", sorted(REGISTRY.checkers))
def test_every_change_is_noticed(item_id, direction):
    assert tally(REGISTRY, item_id, direction).violations == ()
