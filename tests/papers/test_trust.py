"""No checker of any document accepts everything: what is obtained and printed is changed."""

import pytest
from evaluated_items import ATTEMPTED, REGISTRY, evaluated

from dualarm_repro.ledger import evaluate
from dualarm_repro.ledger.trust import by_obtained, by_printed, tally


@pytest.mark.parametrize("direction", ["obtained", "printed"])
@pytest.mark.parametrize("item_id", ATTEMPTED)
def test_every_change_is_noticed(item_id, direction, monkeypatch):
    # First the item as it is, which is known; then under other prints, which is computed.
    known = iter([evaluated(item_id)])
    for module in (by_obtained, by_printed):
        monkeypatch.setattr(module, "evaluate", lambda *of: next(known, None) or evaluate(*of))
    assert tally(REGISTRY, item_id, direction).violations == ()
    assert next(known, None) is None
