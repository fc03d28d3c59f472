"""No checker of any document accepts everything: what is obtained and printed is changed."""

import pytest
from evaluated_items import ATTEMPTED, REGISTRY, evaluated, tried

from dualarm_repro.ledger import evaluate
from dualarm_repro.ledger.trust import by_obtained, by_printed, tally


@pytest.mark.parametrize("direction", ["obtained", "printed"])
@pytest.mark.parametrize("item_id", tried(ATTEMPTED))
def test_every_change_is_noticed(item_id, direction, monkeypatch):
    known = [evaluated]

    def as_it_is_then_under_other_prints(registry, asked):
        return known.pop()(asked) if known else evaluate(registry, asked)

    for module in (by_obtained, by_printed):
        monkeypatch.setattr(module, "evaluate", as_it_is_then_under_other_prints)
    assert tally(REGISTRY, item_id, direction).violations == ()
    assert known == []
