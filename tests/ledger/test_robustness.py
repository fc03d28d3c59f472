"""The parts of a robustness study on functions whose answers are known by hand."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualarm_repro.errors import InputError
from dualarm_repro.ledger import Result, evaluate
from dualarm_repro.ledger.printed import leaves
from dualarm_repro.ledger.robustness import (
    NOT_COMPUTABLE,
    _bisect,
    _climb,
    _flip,
    _nudged,
    _others,
    _outcome,
    _probed,
    judged,
    miss,
    study_of,
    varied,
)
from dualarm_repro.ledger.schema import Assumption

from .toy import toy_registry

WHY = {"statement": "s", "why": "w", "evidence": "assumed"}
WIDTH = Assumption(value=1.0, range=(0.0, 4.0), **WHY)
SHAPE = Assumption(value="round", choices=["round", "square", "oval"], **WHY)
FIXED = Assumption(value=2.0, **WHY)


@pytest.fixture
def toy(tmp_path):
    return toy_registry(tmp_path)


@settings(max_examples=30)
@given(edge=st.floats(0.01, 0.99))
def test_bisection_ends_just_beyond_the_edge(edge):
    found = _bisect(lambda share: share < edge, 0.0, 1.0)
    assert edge <= found <= edge + 2.0**-6


def test_other_values_to_try():
    assert _others(WIDTH, 1.0) == [0.0, 4.0, 1.0, 3.0]
    assert _others(SHAPE, "square") == ["round", "oval"]
    assert _others(FIXED, 2.0) == [pytest.approx(2.02)]
    assert _others(Assumption(value="text", **WHY), "text") == []


@pytest.mark.parametrize(
    ("value", "probed"),
    [
        (2.0, 2.02),
        (0, 0.01),
        (True, True),
        ("a", "a"),
        ([1.0, "b", [0.0]], [1.01, "b", [0.01]]),
        ({"x": -1.0}, {"x": -1.01}),
    ],
)
def test_probed_values_differ_by_one_per_cent(value, probed):
    found = dict(leaves(_probed(value)))
    expected = dict(leaves(probed))
    assert found.keys() == expected.keys()
    for path, leaf in expected.items():
        assert type(found[path]) is type(leaf)
        assert found[path] == (pytest.approx(leaf) if isinstance(leaf, float) else leaf)


def test_nudges_are_next_to_nothing_and_stay_in_the_range():
    choice = {"width": WIDTH, "shape": SHAPE}
    for width in (0.0, 1.0, 4.0):
        found = _nudged({"width": width, "shape": "oval"}, choice)
        assert 0.0 < abs(found["width"] - width) <= 4e-10 * (1 + 1e-6)
        assert 0.0 <= found["width"] <= 4.0
        assert found["shape"] == "oval"


def test_only_what_has_alternatives_varies():
    assert list(varied({"a": WIDTH, "b": FIXED, "c": SHAPE})) == ["a", "c"]


def verdicts(holds):
    """An outcome that only tells the verdict."""

    def at(values):
        width, shape = values.get("width", 1.0), values.get("shape", "round")
        met = holds(width, shape)
        return {"verdict": "yes" if met else "no", "met": met, "miss": 0.0 if met else 1.0}

    return at


def test_the_smallest_flip_is_told_as_a_share_of_the_range():
    # From 1 the nearer edge of (0.2, 3) is 0.8 away, a fifth of the range.
    bisected = 0.02  # six halvings of a quarter of the range
    at = verdicts(lambda width, _: 0.2 < width < 3.0)
    found = _flip(at, "width", WIDTH, at({}))
    assert found["change"] == pytest.approx(0.2, abs=bisected)
    assert found["verdict"] == "no"
    far = verdicts(lambda width, _: width < 3.0)
    assert _flip(far, "width", WIDTH, far({}))["change"] == pytest.approx(0.5, abs=bisected)
    never = verdicts(lambda width, _: True)
    assert _flip(never, "width", WIDTH, never({})) == {}


def test_a_flip_by_choice_counts_as_one():
    at = verdicts(lambda _, shape: shape != "oval")
    found = _flip(at, "shape", SHAPE, at({}))
    assert (found["change"], found["values"]) == (1.0, '{"shape": "oval"}\n')


@pytest.mark.parametrize("seed", range(4))
def test_a_climb_finds_a_narrow_place_and_stops_there(seed):
    def at(values):
        away = abs(values["width"] - 3.3)
        return {"verdict": "v", "met": away < 0.02, "miss": away, "judged": "{}"}

    found = _climb(at, {"width": WIDTH}, 400, np.random.default_rng(seed))
    assert found["met"]
    assert found["evaluations"] < 400
    again = _climb(at, {"width": WIDTH}, 400, np.random.default_rng(seed))
    assert again == found


def test_a_climb_that_finds_nothing_ends_with_the_nearest():
    seen = []

    def at(values):
        seen.append(values["width"])
        return {
            "verdict": "v",
            "met": False,
            "miss": None if values["width"] < 1 else values["width"],
        }

    found = _climb(at, {"width": WIDTH}, 30, np.random.default_rng(1))
    assert found["evaluations"] == len(seen) == 30
    assert found["miss"] == min(width for width in seen if width >= 1)
    assert all(0.0 <= width <= 4.0 for width in seen)


def test_the_outcome_of_an_item_and_of_one_that_refuses(toy):
    found = _outcome(toy, "toy.claim_area", {"width": 1.0})
    assert (found["verdict"], found["met"], found["miss"]) == (
        "reproduced-under-assumption", True, 0.0
    )  # fmt: skip
    beyond = _outcome(toy, "toy.claim_area", {"width": 2.0})
    assert (beyond["met"], beyond["miss"]) == (False, pytest.approx(0.5))

    def refuse(assumed):
        raise InputError("toy", "width", assumed["width"], "another")

    checker = toy.checkers["toy.claim_area"]
    toy._checkers["toy.claim_area"] = type(checker)(refuse, checker.rules, checker.page)
    refused = _outcome(toy, "toy.claim_area", {})
    assert refused["verdict"] == NOT_COMPUTABLE
    assert not refused["met"]
    assert "toy: width = 1.0: expected another" in refused["error"]


def test_what_is_judged_and_by_how_much_it_misses(toy):
    evaluation = evaluate(toy, "toy.claim_area", {"width": 2.0})
    assert judged(evaluation) == {"verdict": "not-reproduced", "area": 3.0}
    assert miss(evaluation) == pytest.approx(0.5)
    assert miss(evaluate(toy, "toy.claim_count")) == 0.0


@pytest.mark.parametrize("samples", [1, 5, 64])
def test_cells_are_draws_and_one_change_of_every_assumption(toy, samples):
    study = study_of(toy, "toy.claim_area", samples)
    cells = study.cells()
    draws = [cell["at"] for cell in cells if cell["kind"] == "draw"]
    assert len(draws) == samples
    assert all(0.0 <= share < 1.0 for draw in draws for share in draw)
    assert [c["assumption"] for c in cells if c["kind"] == "change"] == ["width", "shape"]
    assert cells == study_of(toy, "toy.claim_area", samples).cells()
    if samples == 64:  # a Sobol' set: every eighth of both axes has its share
        counts = np.histogram2d(*np.array(draws).T, bins=8, range=[[0, 1], [0, 1]])[0]
        assert (counts == 1).all()


def test_what_rests_on_nothing_has_no_study(toy):
    assert study_of(toy, "toy.claim_count") is None
    assert study_of(toy, "toy.fig01") is None
    with pytest.raises(InputError, match="robustness: samples = 0"):
        study_of(toy, "toy.claim_area", 0)


def test_a_draw_that_next_to_nothing_decides_is_delicate(tmp_path):
    """A verdict that jumps at the very value drawn; the nudge goes towards the middle."""
    toy = toy_registry(tmp_path)
    study = study_of(toy, "toy.claim_area", 4)
    cells = study.cells()
    rows = [study.cell(k, cell) for k, cell in enumerate(cells[:4])]
    assert [row["delicate"] for row in rows] == [False] * 4
    edge = 4.0 * cells[0]["at"][0]
    checker = toy.checkers["toy.claim_area"]

    def jumping(assumed):
        _ = assumed["shape"]
        return Result({"area": 1.0 if assumed["width"] == edge else 9.0}, caption="c")

    toy._checkers["toy.claim_area"] = type(checker)(jumping, checker.rules, checker.page)
    row = study.cell(0, cells[0])
    assert (row["delicate"], row["met"]) == (True, True)
