"""No clock decides anything: with a falsified one only what is ``measured`` changes."""

import ast
import sys
import time
from functools import cache
from importlib import import_module
from inspect import getsource

import numpy as np
import pytest
from evaluated_items import is_dear
from long_tests import long_where

from dualarm_repro.ledger import evaluate
from dualarm_repro.ledger.closure import closure
from dualarm_repro.ledger.comparison import is_number
from dualarm_repro.ledger.drift import differences
from dualarm_repro.ledger.printed import leaves
from dualarm_repro.ledger.reference import declared, outcome, read_costs, read_reference
from dualarm_repro.ledger.spot import spot_check
from dualarm_repro.papers import load

REGISTRY = load()
CLOCKS = ("perf_counter", "process_time", "thread_time", "monotonic", "time")
TRUE = {
    getattr(time, name + unit): (name, unit)
    for name in CLOCKS
    for unit in ("", "_ns")
    if hasattr(time, name + unit)
}
#: Studies of which a cell takes long; their clocks are those of the planners, tried on the others.
DEAR = {"xue_search", "xue_ablation", "pan_optimisers"}


@cache
def reads_a_clock(module):
    """Whether the source of a module names a clock."""
    tree = ast.walk(ast.parse(getsource(import_module(module))))
    called = [node.func for node in tree if isinstance(node, ast.Call)]
    names = {getattr(call, "attr", None) or getattr(call, "id", "") for call in called}
    return any(name.removesuffix("_ns") in CLOCKS for name in names)


def with_clocks(modules):
    return any(reads_a_clock(module) for module in modules)


@cache
def clocks_of(item_id):
    """The modules with a clock on which an item rests."""
    modules = closure([REGISTRY.checkers[item_id].compute]).modules
    return frozenset(module for module in modules if reads_a_clock(module))


ITEMS = [item_id for item_id in sorted(REGISTRY.checkers) if clocks_of(item_id)]
STUDIES = [
    name
    for name, study in sorted(REGISTRY.studies.items())
    if with_clocks(study.code["modules"]) and name not in DEAR
]
#: Studies of which a cell takes seconds, or compiles for it: their clocks are those of the others.
SLOW = {"xue_planners", "xue_paths", "xue_lottery", "xue_trials"}


def stands_for_others(item_id, most=3):
    """Whether an item reads a clock itself, or is one of the cheapest that rest on its clocks."""
    if reads_a_clock(REGISTRY.checkers[item_id].compute.__module__):
        return True
    alike = [one for one in ITEMS if clocks_of(one) == clocks_of(item_id)]
    return item_id in sorted(alike, key=lambda one: read_costs().get(one, 0.0))[:most]


@pytest.fixture
def false_clock(monkeypatch):
    """Clocks of the package that now stand almost still, and now leap ahead by hours."""
    falsify(1.0, monkeypatch, spread=10.0)


def falsify(scale, monkeypatch, spread=2.0):
    rng, now = np.random.default_rng(20200344), [0.0]

    def clock(unit):
        def read():
            now[0] += scale * float(rng.lognormal(0.0, spread))
            return int(1e9 * now[0]) if unit else now[0]

        return read

    for true, (name, unit) in TRUE.items():
        monkeypatch.setattr(time, name + unit, clock(unit))
        for module_name, module in list(sys.modules.items()):
            if module_name.startswith("dualarm_repro"):
                for key, value in list(vars(module).items()):
                    if value is true:
                        monkeypatch.setattr(module, key, clock(unit))


def test_clocks_are_found():
    assert reads_a_clock("dualarm_repro.planning.checks.query_cost")
    assert not reads_a_clock("dualarm_repro.papers.qiu.reading")
    assert len(ITEMS) > 20
    assert len(STUDIES) > 5


@pytest.mark.parametrize(
    "item_id", long_where(lambda one: is_dear(one) or not stands_for_others(one), ITEMS)
)
def test_no_item_hangs_on_a_clock(item_id, false_clock):
    document = item_id.partition(".")[0]
    stored = read_reference(document)[item_id]
    assert differences(stored, outcome(REGISTRY, item_id), declared(REGISTRY, item_id)) == []


@pytest.mark.parametrize("name", long_where(SLOW.__contains__, STUDIES))
def test_no_stored_cell_hangs_on_a_clock(name, false_clock):
    assert spot_check(REGISTRY.studies[name], 1, seed=20200344).wrong == []


def test_a_falsified_clock_reaches_what_is_measured(monkeypatch):
    times = {}
    for scale in (1e-9, 1e4):
        falsify(scale, monkeypatch)
        made = evaluate(REGISTRY, "qiu.claim_hull_valid").result.measured
        times[scale] = [value for _, value in leaves(made) if is_number(value)]
        monkeypatch.undo()
    assert all(slow > 1e6 * fast for fast, slow in zip(*times.values(), strict=True))
