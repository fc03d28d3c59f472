"""Rules as sentences: bounds, populations and print, each with what was needed."""

import pytest

from dualarm_repro.view.rule_sentences import (
    SIGN,
    compared_with_print,
    finding,
    rule_sentence,
    split_unit,
)


def check(label, expected, obtained, role="supports", outcome="holds"):
    return {"label": label, "role": role, "expected": expected, "obtained": obtained,
            "outcome": outcome}  # fmt: skip


@pytest.mark.parametrize(
    ("made", "sentence"),
    [
        (check("gap [m]", "at most 0", 0.3), "Gap: 0.3 m; it must not exceed zero."),
        (check("gap [m]", "at most 0", 0.0), "Gap: 0 m."),
        (check("steps", "at most 3.0", 2), "Steps: 2; at most 3 is allowed."),
        (check("steps", "at least 3.5", 2), "Steps: 2; at least 3.5 is needed."),
        (check("angle [rad]", "between 0.5 and 1.25", 0.75),
         "Angle: 0.75 rad; it has to lie between 0.5 and 1.25."),
        (check("differ by [m]", "at most 0.5", 0.25),
         "Differ by 0.25 m; at most 0.5 m is allowed."),
        (check("residual [m]", "at most 1e-06", 0.0), "Residual: zero; at most 10⁻⁶ m is allowed."),
        (check("residual [m]", "at most 0.1", 1e-12),
         "Residual: 10⁻¹² m; at most 0.1 m is allowed."),
        (check("share", "at least 0.9 of the population; fails below 0.9, else open",
               {"count": 9, "of": 10}),
         "Share: 9 of 10 (90 %); at least 90 % of all cases is needed, by the whole interval."),
        (check("share", "at most 0.1 of the population; fails above 0.3, else open",
               {"count": 2, "of": 10}),
         "Share: 2 of 10 (20 %); at most 10 % of all cases is needed, and above 30 % it fails."),
        (check("gain", "interval above 0.5; fails below", {"value": 0.7, "low": 0.6, "high": 0.8}),
         "Gain: 0.7 (95 % interval 0.6 to 0.8); the whole interval has to lie above 0.5, and below "
         "it fails."),
        (check("mean time [s]", "printed 0.41 within 0.05 (half of the last digit)", 0.4321),
         "Mean time: 0.432 s; print has 0.41 to within 0.05 (half of the last digit)."),
        (check("the winner", "improved", "improved"), "The winner: improved."),
        (check("the winner", "improved", "traditional"),
         "The winner: traditional; improved is needed."),
        (check("both agree", "True", False), "Both agree: no, not yes."),
        (check("both agree", "False", False), "Both agree: no."),
        (check("T = 0", "True", True), "T = 0: yes."),
        (check("a claim is met", "False", True, "contradicts"),
         "A claim is met: yes, by which print contradicts itself."),
        (check("a claim is met", "False", True, "contradicts", "fails"),
         "A claim is met: yes, not no."),
    ],
)  # fmt: skip
def test_a_rule_in_a_sentence(made, sentence):
    assert rule_sentence(made) == sentence


@pytest.mark.parametrize(
    ("made", "told"),
    [
        (check("gap [m]", "at most 0.5", 0.25), "gap: 0.25 m"),
        (check("differ by [m]", "at most 0.5", 0.25), "differ by 0.25 m"),
        (check("residual [m]", "at most 1e-06", 1e-12), "residual: zero up to round-off"),
        (check("time [s]", "printed 0.4", 0.4321), "time: 0.43 s"),
        (check("runs", "at most 0", 0), "runs: none"),
        (check("the drawing", "it: no original in the source at hand", None), "the drawing"),
    ],
)  # fmt: skip
def test_a_finding_leaves_out_what_was_needed(made, told):
    assert finding(made) == told


@pytest.mark.parametrize(
    ("label", "parts"),
    [("gap [m]", ("gap", "m")), ("speed [rad/s], largest", ("speed, largest", "rad/s")),
     ("q in [0, 1]", ("q in [0, 1]", "")), ("area [m^2]", ("area", "m^2")),
     ("late by [s], of all", ("late by, of all", "s")), ("plain", ("plain", ""))],
)  # fmt: skip
def test_units_are_taken_out_of_labels(label, parts):
    assert split_unit(label) == parts


def test_print_is_told_from_bounds():
    assert compared_with_print(check("a", "printed 0.5", 0.5))
    assert not compared_with_print(check("a", "at most 0.5", 0.5))
    assert not compared_with_print(check("a", "unprinted 0.5", 0.5))


def test_outcomes_have_signs_of_their_own():
    assert set(SIGN) == {"holds", "fails", "open"}
    assert len(set(SIGN.values())) == 3
