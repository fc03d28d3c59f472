"""Figures of what was tried: those of the page are those that are stored."""

import json

import branch_coverage
import pytest
import run_long_tests
import trust
import trust_figures


def test_the_page_states_the_stored_figures():
    assert trust_figures.main(["--check"]) == 0, "run tools/trust_figures.py"


def test_a_figure_that_changes_is_noticed(tmp_path):
    found = {"counts": {"killed": {"tried": 60, "survived": 59}}, "lost": {}}
    (tmp_path / "faults.json").write_text(json.dumps(found))
    (tmp_path / "fuzz.json").write_text(json.dumps({"cases": {"refused": 7, "answered": 5}}))
    (tmp_path / "coverage.json").write_text(json.dumps({"branches": 8, "reached": 7}))
    again = {"counts": {"two workers": {"items": 9, "cells": 4, "otherwise": 1}}}
    (tmp_path / "determinism.json").write_text(json.dumps(again))
    table = trust_figures.figures(trust_figures.rows(tmp_path, tmp_path))
    assert "| computed again: two workers | 9 items, 4 cells of studies | 1 otherwise |" in table
    assert "| faults: killed | 60 | 59 survived |" in table
    assert "| hostile inputs | 12 | 5 answered, 7 refused |" in table
    assert "| branches of the library | 8 | 87.5% reached |" in table
    page = f"a\n{trust_figures.BEGIN}\n12 of 13\n{trust_figures.END}\nb\n"
    made = trust_figures.with_figures(page, table)
    assert "12 of 13" not in made
    assert trust_figures.with_figures(made, table) == made
    with pytest.raises(ValueError, match="not both there"):
        trust_figures.with_figures("nothing", table)


def test_what_is_not_stored_is_not_claimed(tmp_path):
    table = trust_figures.figures(trust_figures.rows(tmp_path, tmp_path))
    assert table.count(trust_figures.ABSENT) == 4


def test_properties_are_counted_from_the_tests(tmp_path):
    (tmp_path / "test_a.py").write_text(
        "@given(x=floats())\ndef test_a(x): ...\n"
        "@settings(max_examples=30)\n@given(floats())\ndef test_b(x): ...\n"
        "def test_c(): ...\n"
    )
    assert trust_figures.properties(tmp_path) == (2, 130)


def test_branches_are_counted_by_room():
    def of(there, reached):
        return {"summary": {"num_branches": there, "covered_branches": reached}}

    files = {
        "dualarm_repro/arms/a.py": of(4, 3),
        "dualarm_repro/arms/b/c.py": of(2, 2),
        "dualarm_repro/errors.py": of(2, 0),
    }
    found = branch_coverage.by_room(files)
    assert (found["branches"], found["reached"]) == (8, 5)
    assert found["rooms"]["arms"] == {"branches": 6, "reached": 5}
    assert found["rooms"]["errors"] == {"branches": 2, "reached": 0}


def test_every_part_of_make_trust_is_there(root):
    for part in trust.PARTS:
        assert (root / trust.command(part)[1]).is_file()
    assert list(trust.PARTS)[-1] == "trust_figures", "written from what the others stored"
    assert run_long_tests.command()[-2:] == ["-m", "long"]
    assert "$(BIN)/python tools/trust.py" in (root / "Makefile").read_text(encoding="utf-8")
