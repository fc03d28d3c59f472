"""Assumptions: their plausible values, settings made of them, and what makes a study stale."""

from dataclasses import dataclass

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualarm_repro.ledger import assumptions as module
from dualarm_repro.ledger.assumptions import (
    Chosen,
    FromAssumptions,
    alternatives,
    hashable,
    plausible,
)
from dualarm_repro.ledger.schema import Assumption
from dualarm_repro.tracking import recording

from .toy import YAML, toy_registry

WHY = {"statement": "s", "why": "w", "evidence": "assumed"}


@settings(max_examples=40)
@given(
    low=st.floats(0.01, 10.0),
    width=st.floats(0.1, 100.0),
    share=st.floats(0.0, 1.0),
    scale=st.sampled_from(["linear", "log"]),
)
def test_a_share_of_a_range_and_back(low, width, share, scale):
    entry = Assumption(value=low, range=(low, low + width), scale=scale, **WHY)
    value = entry.at(share)
    assert low * (1 - 1e-12) <= value <= (low + width) * (1 + 1e-12)
    assert entry.share_of(value) == pytest.approx(share, abs=1e-6)
    assert entry.at(0.0) == pytest.approx(low)
    assert entry.at(1.0) == pytest.approx(low + width)
    middle = entry.at(0.5)
    if scale == "log":
        assert middle**2 == pytest.approx(low * (low + width))
    else:
        assert middle == pytest.approx(low + width / 2)


def test_choices_have_equal_shares():
    entry = Assumption(value="b", choices=["a", "b", "c"], **WHY)
    assert [entry.at(k / 6) for k in range(6)] == ["a", "a", "b", "b", "c", "c"]
    assert entry.at(1.0 - 1e-12) == "c"
    assert entry.varies
    with pytest.raises(ValueError, match="with a range"):
        entry.share_of(0.5)


def test_what_has_one_value_does_not_vary():
    fixed = Assumption(value=1.0, **WHY)
    assert not fixed.varies
    assert not Assumption(value=1, choices=[1], **WHY).varies
    with pytest.raises(ValueError, match="with a range or with choices"):
        fixed.at(0.5)


@pytest.mark.parametrize(
    ("fields", "reason"),
    [
        ({"value": 3.0, "range": (1.0, 2.0)}, "inside range"),
        ({"value": "a", "range": (1.0, 2.0)}, "a number inside range"),
        ({"value": 1.0, "range": (1.0, 1.0)}, "low < high"),
        ({"value": 0.0, "range": (0.0, 1.0), "scale": "log"}, "must be positive"),
        ({"value": "c", "choices": ["a", "b"]}, "one of choices"),
    ],
)
def test_implausible_values_are_refused(fields, reason):
    with pytest.raises(ValueError, match=reason):
        Assumption(**fields, **WHY)


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        ([1, [2, 3]], (1, (2, 3))),
        ({"b": [1], "a": {"c": 2}}, (("a", (("c", 2),)), ("b", (1,)))),
        ("text", "text"),
        (None, None),
    ],
)
def test_values_of_the_file_become_hashable(value, expected):
    assert hashable(value) == expected
    assert hash(hashable(value)) == hash(expected)


@dataclass(frozen=True)
class Box(FromAssumptions):
    """Settings of a method."""

    width: float
    corners: tuple[int, ...]


def test_settings_read_exactly_their_fields():
    class Once(dict):
        """Notes what is asked for."""

        def __getitem__(self, key):
            asked.append(key)
            return super().__getitem__(key)

    asked = []
    made = Box.of(Once(width=2.0, corners=[1, 2], other=3))
    assert made == Box(2.0, (1, 2))
    assert asked == ["width", "corners"]
    assert Box.names() == ("width", "corners")
    with pytest.raises(KeyError):
        Box.of({"width": 2.0})


@pytest.fixture
def toy(tmp_path, monkeypatch):
    registry = toy_registry(tmp_path)
    monkeypatch.setattr(module, "REGISTRY", registry)
    return registry


def test_plausible_values_and_alternatives_by_name(toy):
    assert plausible("toy.width", 0.25) == 1.0
    assert plausible("toy.shape", 0.75) == "square"
    assert alternatives("toy.width", 5) == [0.0, 1.0, 2.0, 3.0, 4.0]
    assert alternatives("toy.shape", 5) == ["round", "square"]


def test_chosen_values_follow_the_document_and_note_what_they_read(toy, tmp_path, monkeypatch):
    chosen = Chosen("toy", ("width", "shape"), size=3, shape="oval")
    assert list(chosen) == ["width", "size", "shape"]
    assert len(chosen) == 3
    with recording() as noted:
        assert dict(chosen) == {"width": 1.0, "size": 3, "shape": "oval"}
    assert noted == {"papers/toy.yaml#assumptions.width.value"}
    with pytest.raises(KeyError):
        chosen["height"]
    changed = tmp_path / "changed"
    changed.mkdir()
    monkeypatch.setattr(
        module, "REGISTRY", toy_registry(changed, YAML.replace("value: 1.0", "value: 2.5"))
    )
    assert chosen["width"] == 2.5


def test_ranges_count_where_a_study_draws_from_them(toy):
    with recording() as noted:
        found = Chosen("toy", ("width", "shape"), ranges=True)["width"]
    assert found == {"value": 1.0, "range": (0.0, 4.0), "choices": None}
    fields = {name.rpartition(".")[2] for name in noted}
    assert fields == {"value", "range", "choices"}
