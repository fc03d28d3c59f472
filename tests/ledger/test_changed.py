"""Values of assumptions from the command line, and what they do to an item."""

import pytest

from dualarm_repro.errors import InputError
from dualarm_repro.ledger.changed import (
    evaluate_changed,
    flipping,
    read_changes,
    read_value,
    setting,
    typed,
)
from dualarm_repro.ledger.record import record
from dualarm_repro.ledger.schema import Assumption
from dualarm_repro.view.assumption_rows import rerun
from dualarm_repro.view.terminal import place_lines, plausible_text

from .toy import toy_registry


@pytest.fixture
def toy(tmp_path):
    return toy_registry(tmp_path)


def entry(value, **declared):
    return Assumption(statement="s", value=value, why="w", evidence="assumed", **declared)


@pytest.mark.parametrize(
    ("declared", "text", "value"),
    [
        (entry(1.0, range=(0, 2)), "1.5", 1.5),
        (entry(1.0, range=(0, 2)), "-7e2", -700.0),
        (entry(3000, range=(1000, 3000)), "1500", 1500),
        (entry(0, choices=[0, 1]), "5", 5),
        (entry("x", choices=["x", "y"]), "y", "y"),
        (entry("1", choices=["1", "2"]), "2", "2"),
        (entry(True), "false", False),
        (entry([1, 2]), "[0.5, 3]", [0.5, 3]),
        (entry({"a": 1.0}), '{"a": 2}', {"a": 2}),
    ],
)
def test_values_of_the_declared_kind(declared, text, value):
    found = read_value(declared, "name", text)
    assert (found, type(found)) == (value, type(value))


@pytest.mark.parametrize(
    ("declared", "text", "expected"),
    [
        (entry(1.0, range=(0, 2)), "wide", "a finite number"),
        (entry(1.0, range=(0, 2)), "NaN", "a finite number"),
        (entry(1.0, range=(0, 2)), "1e999", "a finite number"),
        (entry(1.0, range=(0, 2)), "9" * 400, "a finite number"),
        (entry(1.0, range=(0, 2)), "true", "a finite number"),
        (entry(0, choices=[0, 1]), "0.5", "a whole number"),
        (entry("x", choices=["x", "y"]), "z", "one of x, y"),
        (entry("x"), "z", "one of x"),
        (entry(True), "1", "true or false"),
        (entry([1, 2]), "[1]", "a list of 2"),
        (entry([1, 2]), '["a", "b"]', "a list of 2"),
        (entry([1, 2]), "[" * 5000, "a list of 2"),
        (entry({"a": 1.0}), '{"b": 2}', "a mapping of a"),
    ],
)
def test_values_of_another_kind_are_refused(declared, text, expected):
    with pytest.raises(InputError, match=expected) as refused:
        read_value(declared, "name", text)
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    ("settings", "expected"),
    [
        (["width"], "assumption=value"),
        (["width=1", "width=2"], "width once"),
        (["wide=1"], "such as width"),
    ],
)
def test_settings_that_cannot_be_read(toy, settings, expected):
    with pytest.raises(InputError, match=expected):
        read_changes(toy, "toy.claim_area", settings)


def test_an_item_at_other_values_beside_the_declared_ones(toy):
    changes = read_changes(toy, "toy.claim_area", ["width=3", "shape=square"])
    assert changes == {"width": 3, "shape": "square"}
    made, evaluation = evaluate_changed(toy, "toy.claim_area", changes)
    assert (made["verdict"], made["nominal"]["verdict"]) == (
        "not-reproduced",
        "reproduced-under-assumption",
    )
    assert (made["obtained"], made["nominal"]["obtained"]) == ({"area": 9}, {"area": 0.75})
    assert [one["plausible"] for one in made["changed"]] == [True, True]
    assert {one["id"]: one["value"] for one in made["assumptions"]} == changes
    assert made["robustness"] is None
    assert evaluation.result.obtained == {"area": 9}


def test_the_verdict_without_a_change_is_that_of_the_declared_values(toy):
    made, _ = evaluate_changed(toy, "toy.claim_area", {"width": 1.0})
    assert made["verdict"] == made["nominal"]["verdict"]
    assert made["checks"] == made["nominal"]["checks"]


def test_what_the_computation_cannot_take_is_an_input_error(toy):
    with pytest.raises(InputError, match=r"width=.*TypeError"):
        evaluate_changed(toy, "toy.claim_area", {"width": None})
    with pytest.raises(InputError, match="an item that is computed"):
        evaluate_changed(toy, "toy.fig01", {})


def test_what_is_typed_is_read_back(registry):
    """Every value of every assumption, in the words in which a terminal offers it."""
    for paper in registry.papers.values():
        for name, declared in paper.assumptions.items():
            offered = plausible_text(declared.model_dump())
            for value in (declared.value, *(declared.choices or ())):
                assert read_value(declared, name, typed(value)) == value, name
                assert declared.range or not declared.choices or typed(value) in offered, name


@pytest.mark.usefixtures("kept_records")
def test_the_command_that_is_offered_changes_what_it_says(registry):
    """The change that flips the outcome where there is one, else another plausible value."""
    flips = others = 0
    for item_id in registry.items:
        made = record(registry, item_id)
        if (offered := rerun(made)) is None:
            assert flipping(made) is None
            continue
        command, what = offered
        assert any(line.endswith(f"{what}: {command}") for line in place_lines(made))
        start, _, change = command.partition(" --set ")
        assert start == f"dualarm run {item_id}"
        ((name, value),) = read_changes(registry, item_id, [change]).items()
        if flipping(made):
            flip, flips = made["robustness"]["flip"], flips + 1
            assert ({name: value}, "flips" in what) == ({flip["assumption"]: flip["value"]}, True)
        else:
            others += 1
            (declared,) = (one for one in made["assumptions"] if one["id"] == name)
            assert value != declared["value"]
            assert "flips" not in what
    assert min(flips, others) > 20


def test_no_command_is_offered_for_a_change_of_many_numbers():
    flip = {"assumption": "height", "value": [1.0, 2.0]}
    assert flipping({"robustness": {"flip": flip}}) is None
    assert flipping({"robustness": None}) is None
    assert setting("points", [1, 2.5]) == "points=[1, 2.5]"
    assert setting("shape", "front_deep") == "shape=front_deep"
    assert setting("angle", 0.7853981633974483) == "angle=0.7853981633974483"
