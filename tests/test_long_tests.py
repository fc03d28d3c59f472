"""Nothing is tried in the long form only, without a reason."""

import pytest
from long_tests import COLLECTED, without_short_form
from schedule import COSTS, DearestFirst, cost_of, group_of, order_of


def test_every_long_test_has_a_short_form_or_a_reason(request):
    assert without_short_form(request.config.stash[COLLECTED]) == []


@pytest.mark.parametrize(
    ("mark", "missing"),
    [
        ({}, True),
        ({"short": "test_sample"}, False),
        ({"short": "test_another"}, True),
        ({"short": "test_long"}, True),
        ({"reason": "it needs a night"}, False),
        ({"reason": ""}, True),
    ],
)
def test_what_lacks_a_short_form_is_found(mark, missing):
    collected = [("a.py::test_long", mark), ("a.py::test_sample[1]", None)]
    collected.append(("b.py::test_another", None))
    assert without_short_form(collected) == (["a.py::test_long"] if missing else [])


def test_a_parameter_is_long_where_another_is_short():
    collected = [("a.py::test_it[dear]", {}), ("a.py::test_it[cheap]", None)]
    assert without_short_form(collected) == []
    assert without_short_form(collected[:1]) == ["a.py::test_it"]


@pytest.mark.parametrize(
    ("nodeid", "group"),
    [
        ("tests/arms/test_arm.py::test_a[1]", "tests/arms/test_arm.py"),
        ("tests/papers/test_trust.py::test_a[xue.eq01-printed]", "items of xue"),
        ("tests/papers/test_statistics.py::test_a[2-qiu.claim_d]", "items of qiu"),
        ("tests/papers/test_ledger_of_papers.py::test_nothing_drifted[pan-soon]", "items of pan"),
        ("tests/papers/test_ledger_of_papers.py::test_a", "tests/papers/test_ledger_of_papers.py"),
        ("tests/papers/pan/pages/test_seam.py::test_a[xue]", "items of pan"),
        ("tests/papers/patent/test_room.py::test_a", "tests/papers/patent/test_room.py"),
        ("tests/replay/test_replay_pan.py::test_seam", "tests/replay/"),
    ],
)
def test_tests_that_share_an_evaluation_share_a_worker(nodeid, group):
    assert group_of(nodeid) == group
    assert DearestFirst._split_scope(None, nodeid) == group


def test_what_takes_longest_is_collected_first(request):
    """Whatever of this run takes longest; what takes no time keeps its order."""
    costs = [cost_of(group_of(item.nodeid)) for item in request.session.items]
    assert costs == sorted(costs, reverse=True)


def test_how_an_item_is_computed_is_looked_at_before_anything_else_computes_it():
    """What is computed already opens no file."""
    looked = "tests/papers/test_ledger_of_papers.py::test_no_data_file_is_opened_unseen[pan.eq01]"
    own = "tests/papers/pan/test_print.py::test_a"
    assert group_of(looked) == group_of(own)
    assert order_of(looked) < order_of(own)


def test_costs_are_of_tests_that_exist(request):
    folder = request.config.rootpath
    for name in COSTS:
        assert name.startswith("items of") or (folder / name).exists(), name
    documents = {path.name for path in (folder / "tests" / "papers").iterdir() if path.is_dir()}
    named = {name.removeprefix("items of").strip() for name in COSTS if name.startswith("items")}
    assert named <= {"", *documents}
