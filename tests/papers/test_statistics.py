"""Statements about a population do not change sides because more, or less, was drawn."""

import pandas as pd
import pytest
from evaluated_items import NOTED, REGISTRY, evaluated, tried

from dualarm_repro.datafiles import opened
from dualarm_repro.ledger import Exceeds, Generally, Study, evaluate, record
from dualarm_repro.ledger.rules import Outcome
from dualarm_repro.tracking import forget, recording

STATISTICAL = [
    item_id
    for item_id, checker in REGISTRY.checkers.items()
    if any(isinstance(rule, Generally | Exceeds) for rule in checker.rules)
]
SUBSAMPLES = 3
_LOAD = Study.load


def outcomes(evaluation):
    rules = [r for r in evaluation.checker.rules if isinstance(r, Generally | Exceeds)]
    return {rule.label: rule.outcome(evaluation.evidence) for rule in rules}


def tables(item_id):
    """Stored tables that an item reads."""
    evaluated(item_id)
    return [name for name in NOTED[item_id] if name.endswith(".parquet")]


def resampled(monkeypatch, item_id, change):
    """Outcomes when every stored study the item reads holds another sample."""

    def load_changed(study):
        opened(study.table_path)
        return change(_LOAD(study))

    names = tables(item_id)
    monkeypatch.setattr(Study, "load", load_changed)
    for name in names:
        forget(name)
    try:
        return outcomes(evaluate(REGISTRY, item_id))
    finally:
        monkeypatch.setattr(Study, "load", _LOAD)
        for name in names:
            forget(name)


def keep_sides(before, after):
    sides = {Outcome.HOLDS, Outcome.FAILS}
    return {label for label in before if {before[label], after[label]} == sides} == set()


@pytest.mark.parametrize("item_id", tried(STATISTICAL))
@pytest.mark.parametrize("k", range(SUBSAMPLES))
def test_a_third_of_the_draws(monkeypatch, item_id, k):
    full = outcomes(evaluated(item_id))
    third = resampled(
        monkeypatch, item_id, lambda table: table.sample(frac=1 / 3, random_state=k).sort_index()
    )
    assert keep_sides(full, third)


@pytest.mark.parametrize("item_id", tried(STATISTICAL))
def test_twice_the_draws(monkeypatch, item_id):
    full = outcomes(evaluated(item_id))
    twice = resampled(monkeypatch, item_id, lambda table: pd.concat([table, table]).sort_index())
    assert keep_sides(full, twice)


def test_there_are_statistical_statements_and_most_read_a_stored_study():
    assert len(STATISTICAL) >= 5
    with_tables = []
    for item_id in STATISTICAL:
        with recording() as noted:  # by a record, which knows what it was made of
            record(REGISTRY, item_id)
        with_tables += [item_id] * any(name.endswith(".parquet") for name in noted)
    assert len(with_tables) >= 5
