"""Lines of a record for a pipe: changed runs, plausible values, robustness and commands."""

import pytest

from dualarm_repro.view.terminal import (
    before_rows,
    changed_lines,
    describe,
    place_lines,
    plausible_text,
    proof_text,
    robustness_line,
    verdict_note,
    verdict_style,
    verdict_text,
)

from .full_record import FULL, ROBUST

RECORD = {
    **FULL,
    "printed": {"a": "0.50"},
    "unit": "m",
    "obtained": {"a": 0.5},
    "caption": None,
    "page": "toy/page",
    "draws": "none",
    "robustness": ROBUST,
    "decided_by": None,
}
CHECK = {"label": "area", "role": "supports", "expected": "at most 2", "obtained": 1.0,
         "outcome": "holds"}  # fmt: skip


def changed(**more):
    """A record at another width, at which the rule fails."""
    entry = {"assumption": "width", "value": 3.0, "nominal": 1.0, "unit": "m", "range": [0.0, 4.0],
             "plausible": True}  # fmt: skip
    nominal = {"verdict": "reproduced", "checks": [CHECK], "obtained": {"a": 0.5}}
    made = {
        **RECORD,
        "changed": [entry],
        "nominal": nominal,
        "verdict": "not-reproduced",
        "checks": [{**CHECK, "obtained": 3.0, "outcome": "fails"}],
        "obtained": {"a": 4.5},
    }
    return {**made, **more}


def test_a_changed_run_says_what_was_changed_and_what_was_declared():
    (line,) = changed_lines(changed())
    assert line == "changed: width = 3.0 m (1.0 in the ledger; plausible 0 to 4)"
    same = changed(obtained={"a": 0.5})
    assert [text.startswith("no obtained value moved") for text in changed_lines(same)] == [
        False, True]  # fmt: skip
    assert list(changed_lines(RECORD)) == []


@pytest.mark.parametrize(
    ("entry", "text"),
    [
        ({"range": [0.5, 2.0]}, "plausible 0.5 to 2"),
        ({"range": [0.5, 2.0], "plausible": False}, "plausible 0.5 to 2; this is outside"),
        ({"choices": ["round", 3]}, "plausible: round, 3"),
        ({}, "no other value declared"),
    ],
)
def test_plausible_values_in_words(entry, text):
    assert plausible_text(entry) == text


def test_the_verdict_of_a_changed_run_is_that_at_these_values():
    assert verdict_note(changed()) == (
        " with these values alone; reproduced with the declared ones"
    )
    same = changed(verdict="reproduced")
    assert verdict_note(same) == " with these values alone; as with the declared ones"
    assert verdict_note({**RECORD, "change": "an axis turned"}) == " (an axis turned)"
    assert verdict_note({**RECORD, "change": None}) == ""


def test_a_check_that_comes_out_otherwise_is_beside_the_declared():
    (text,) = before_rows(changed())
    assert text == " (declared values: 1, holds)"
    assert before_rows(changed(checks=[CHECK])) == [""]
    other = changed(checks=[{**CHECK, "obtained": 1.5}])
    assert before_rows(other) == [" (declared values: 1, holds)"], "another value, still held"
    assert before_rows({**RECORD, "checks": [CHECK, CHECK]}) == ["", ""]


def test_commands_repeat_what_was_run():
    lines = list(place_lines(changed()))
    assert "again: dualarm run toy.x --set=width=3.0; cite: dualarm cite toy.x" in lines
    assert not any(line.startswith("with ") for line in lines)
    plain = list(place_lines(RECORD))
    assert plain[0] == "code: dualarm_repro/papers/xue/__init__.py:7 f.<locals>.g; page toy/page"
    assert plain[-1] == "with the choice that flips it: dualarm run toy.x --set width=1.5"
    words = changed()
    words["changed"][0] |= {"assumption": "shape", "value": "with a space"}
    assert "'--set=shape=with a space'" in "\n".join(place_lines(words))


@pytest.mark.parametrize(
    ("made", "text"),
    [
        ({"verdict": None, "robustness": None}, "not available"),
        ({"verdict": "reproduced"}, "reproduced"),
        ({}, "reproduced-under-assumption, 5 %"),
        ({"robustness": None}, "reproduced-under-assumption"),
        ({"decided_by": "toy.claim"}, "reproduced-under-assumption"),
    ],
)
def test_the_share_stands_behind_what_is_only_possible(made, text):
    assert verdict_text({**RECORD, **made}) == text


@pytest.mark.parametrize(
    ("made", "text"),
    [
        ({}, "print is met in 5.0% of 32 draws (1.0%-16.0%); most influential: width (0.61); "
             "flips at width = 1.5 (nominal 1.0)"),
        ({"robustness": {**ROBUST, "flip": None, "influence": {}}},
         "print is met in 5.0% of 32 draws (1.0%-16.0%); no single change within the plausible "
         "values flips it"),
        ({"verdict": "regenerated", "robustness": {**ROBUST, "flip": None, "influence": {}}},
         "the properties hold in 5.0% of 32 draws (1.0%-16.0%); no single change within the "
         "plausible values flips it"),
        ({"robustness": None}, "no assumption with another plausible value"),
        ({"robustness": None, "draws": "stale"}, "draws stale"),
    ],
)  # fmt: skip
def test_robustness_on_a_line(made, text):
    assert robustness_line({**RECORD, **made}) == text


def test_proofs_that_fail_are_loud():
    proof = {"statement": "1 < 2", "holds": True}
    assert proof_text({"proof": proof}) == "proved: 1 < 2"
    assert proof_text({"proof": {**proof, "holds": False}}) == "PROOF FAILS: 1 < 2"
    assert proof_text({"proof": None, "no_proof": "only words"}) == "only words"
    assert proof_text({"proof": None}) == ""


def test_every_ground_has_its_line():
    text = "\n".join(describe(RECORD))
    for line in (
        '  witness (draw 4): holds with {"width": 2.0}',
        "  witness (nominal): fails with the values as declared",
        "  threshold limit = 0.5: half <",
        "  assumption width: <w> (1.0 m; no other value declared)",
        "  context width: <w> (1.0; no other value declared)",
        "  erratum toy.a: x > y [proved: 1 < 2]",
        "  erratum toy.b: x > y [PROOF FAILS: 1 < 2]",
        "  erratum toy.c: x > y [only <words>]",
        "  not printed: <script>",
        "  measured: n = 3",
        "  a: 0.50 | 0.5",
        "printed (m) | obtained:",
    ):
        assert line in text.splitlines(), line
    assert "robustness" not in "\n".join(describe(changed()))


@pytest.mark.parametrize(
    ("verdict", "style"),
    [("reproduced", "green"), ("not-reproduced", "red"), ("undecidable", "yellow"), (None, "dim"),
     ("not-attempted", "dim"), ("regenerated", "cyan")],
)  # fmt: skip
def test_colours_of_verdicts(verdict, style):
    assert verdict_style(verdict) == style
