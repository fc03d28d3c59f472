"""The stored arena: whole, up to date, and the same in whatever order its cells are computed."""

import pytest

from dualarm_repro.arena import ARENA, Outcome
from dualarm_repro.arena.cases import BENCHMARK, KINDS, NEAR, RANDOM, case_of, case_settings
from dualarm_repro.arena.study import CONTESTANTS, WITNESS
from dualarm_repro.arena.summary import TASK
from dualarm_repro.ledger.spot import spot_check

#: Planners that draw or iterate inside a library of others.
FOREIGN = ("rrt-connect", "bit-star", "cbf-qp", "trajectory-optimisation")


def test_arena_is_stored_and_up_to_date():
    assert ARENA.status() == "up to date"


def test_every_contestant_met_every_task():
    table = ARENA.load()
    met = table.groupby(list(TASK))["method"].agg(set)
    assert len(met) == len(case_settings())
    assert all(one == {WITNESS, *CONTESTANTS} for one in met)
    assert set(table["kind"]) == set(KINDS)
    assert set(table["outcome"]) <= {str(one) for one in Outcome}


def test_what_is_certified_has_a_positive_bound_and_what_collides_a_negative_one():
    table = ARENA.load().set_index("outcome")
    assert (table.loc[[Outcome.SUCCESS], "lower"] > 0.0).all()
    assert (table.loc[[Outcome.COLLIDES], "upper"] <= 0.0).all()


def test_rows_computed_again_are_the_same():
    assert spot_check(ARENA, 2, seed=2026, kind=NEAR).wrong == []


def test_order_does_not_matter():
    """Libraries that keep a generator of their own are seeded anew by every cell."""
    cells = ARENA.cells()
    task = {"kind": RANDOM, "subject": "irb120-irb120", "group": "2 spheres", "number": 0}
    chosen = [
        k for k, one in enumerate(cells) if task.items() <= one.items() and one["method"] in FOREIGN
    ]
    assert len(chosen) == len(FOREIGN)
    rows = {k: ARENA.cell(k, cells[k]) for k in chosen}
    for k in reversed(chosen):
        assert ARENA.differs(rows[k], ARENA.cell(k, cells[k])) == []


@pytest.mark.parametrize(
    ("group", "may_touch"), [("bookshelf_tall", {"Can6"}), ("table_pick", {"Can1"})]
)
def test_fingers_of_the_benchmark_may_touch_what_they_grasp_and_nothing_else(group, may_touch):
    settings = {"kind": BENCHMARK, "group": group, "subject": "panda", "number": 1}
    case = case_of(settings)
    assert {other for _, other in case.scene.exempt} == may_touch
    assert {body for body, _ in case.scene.exempt} == {
        "panda/panda_leftfinger_0",
        "panda/panda_rightfinger_0",
    }
    assert case.fault == ""
