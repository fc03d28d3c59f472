"""Assumptions as rows: values in words, what else is plausible, and the command to try it."""

import pytest

from dualarm_repro.view.assumption_rows import assumption_rows, context_rows, rerun

from .full_record import FULL, ROBUST


def entry(name="width", **more):
    plain = {"id": name, "statement": f"the {name}", "value": 1.0, "why": "unprinted",
             "evidence": "assumed"}  # fmt: skip
    return {**plain, **more}


def row(**more):
    (found,) = assumption_rows({**FULL, "assumptions": [entry(**more)], "robustness": None})
    return found


@pytest.mark.parametrize(
    ("more", "value", "plausible"),
    [
        ({"unit": "m", "range": [0.5, 2.0]}, "1 m", "0.5 to 2 m"),
        ({"range": [0.5, 1e-6]}, "1", "0.5 to 10⁻⁶"),
        ({"value": "a_b", "choices": ["a_b", "c_d", "e"]}, "a b", "or c d, e"),
        ({"value": "a", "choices": ["a"]}, "a", ""),
        ({"value": [0.1, 0.2], "unit": "m"}, "(0.1, 0.2) m", ""),
        ({"value": True, "choices": [True, False]}, "yes", "or no"),
    ],
)
def test_values_and_what_else_is_plausible(more, value, plausible):
    found = row(**more)
    assert (found.value, found.plausible) == (value, plausible)
    assert found.moves is False


@pytest.mark.parametrize(
    ("evidence", "told"),
    [("printed", "printed elsewhere in the document"), ("public", "published by others"),
     ("inferred", "inferred from what is printed"), ("assumed", "assumed")],
)  # fmt: skip
def test_where_a_value_comes_from(evidence, told):
    assert row(evidence=evidence).evidence == told


def test_only_the_assumption_that_flips_says_so():
    entries = [entry("other"), entry("width", unit="mm")]
    rows = assumption_rows({**FULL, "assumptions": entries, "robustness": ROBUST})
    assert [one.id for one in rows] == ["width", "other"], "influence first"
    assert [one.flip for one in rows] == ["alone flips the outcome at 1.5 mm", ""]
    assert rows[0].influence == 0.61


def test_without_influence_what_flips_comes_first():
    robust = {**ROBUST, "influence": {}}
    rows = assumption_rows({**FULL, "assumptions": [entry("a"), entry()], "robustness": robust})
    assert [one.id for one in rows] == ["width", "a"]


def test_context_moves_nothing():
    made = {**FULL, "context": [entry()], "robustness": ROBUST}
    (found,) = context_rows(made)
    assert (found.influence, found.flip, found.moves) == (0.0, "", False)


FIRM = {**ROBUST, "flip": None}


@pytest.mark.parametrize(
    ("assumptions", "command"),
    [
        ([entry(range=[0.5, 4.0])], "--set width=4.0"),
        ([entry(range=[-4.0, 2.0])], "--set width=-4.0"),
        ([entry("idle", range=[0.0, 9.0]), entry(range=[0.5, 4.0])], "--set width=4.0"),
        ([entry(value="a", choices=["a", "b"])], "--set width=b"),
        ([entry(choices=[1.0, [1, 2], 3.0])], "--set width=3.0"),
    ],
)
def test_the_command_takes_the_farthest_value_of_what_matters_most(assumptions, command):
    made = {**FULL, "assumptions": assumptions, "robustness": FIRM}
    assert rerun(made) == (f"dualarm run toy.x {command}", "with an assumption changed")


@pytest.mark.parametrize(
    "assumptions", [[], [entry()], [entry(value=[1, 2], choices=[[1, 2], [3, 4]])]]
)
def test_without_another_value_there_is_no_command(assumptions):
    assert rerun({**FULL, "assumptions": assumptions, "robustness": FIRM}) is None


def test_a_flip_of_several_values_is_no_command():
    flip = {**ROBUST["flip"], "value": [1.0, 2.0]}
    made = {
        **FULL,
        "assumptions": [entry(range=[0.5, 4.0])],
        "robustness": {**ROBUST, "flip": flip},
    }
    assert rerun(made) == ("dualarm run toy.x --set width=4.0", "with an assumption changed")
