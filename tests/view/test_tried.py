"""The page of what was tried shows what is stored, and nothing where nothing is."""

import json

import pytest

from dualarm_repro.view import tried


@pytest.fixture
def results(tmp_path, monkeypatch):
    monkeypatch.setattr(tried, "data_path", lambda *parts: tmp_path / parts[-1])
    return tmp_path


def test_nothing_stored_claims_nothing(results):
    assert "make trust" in tried.tried_page().html
    assert "survived" not in tried.lost_page().html


def test_every_row_is_shown(results):
    rows = [["properties", "3 with 30 examples", "each holds"], ["faults: killed", "60", "59"]]
    (results / "tried.json").write_text(json.dumps({"rows": rows}))
    shown = tried.tried_page().html
    assert all(f"<td>{text}</td>" in shown for row in rows for text in row)


def test_a_lost_fault_is_named(results):
    stored = {"counts": {"killed": {"tried": 60, "survived": 60}}, "lost": {}}
    (results / "faults.json").write_text(json.dumps(stored))
    assert "All 60 faults were survived" in tried.lost_page().html
    stored["counts"]["killed"]["survived"], stored["lost"] = 58, {"killed: plan: <half>": 2}
    (results / "faults.json").write_text(json.dumps(stored))
    shown = tried.lost_page().html
    assert "killed: plan: &lt;half&gt;" in shown
    assert "All" not in shown


def test_what_came_out_otherwise_is_named(results):
    assert "came out the same" not in tried.otherwise_page().html
    count = {"items": 3, "cells": 2, "otherwise": 0}
    stored = {"counts": {"two workers": count, "warm cache": count}, "otherwise": {}}
    (results / "determinism.json").write_text(json.dumps(stored))
    assert "Everything came out the same in 2 circumstances" in tried.otherwise_page().html
    stored["otherwise"] = {"two workers": ["toy cell 1: obtained.x: reference 1, found <2>"]}
    (results / "determinism.json").write_text(json.dumps(stored))
    shown = tried.otherwise_page().html
    assert "two workers" in shown
    assert "found &lt;2&gt;" in shown
    assert "Everything" not in shown
