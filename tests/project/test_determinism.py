"""Results computed again in other circumstances, in the short form: one item in a copied tree."""

import json

import determinism
import pytest

from dualarm_repro.ledger.reference import outcome

ITEM = "xue.eq01"


@pytest.fixture
def made(registry):
    """What a process gives that computes one item and two cells, all as stored."""
    items = json.loads(json.dumps({ITEM: outcome(registry, ITEM)}))
    return {"items": items, "cells": 2, "wrong": [], "unsettled": ["toy cell 1: obtained.x"]}


def test_another_folder_gives_the_same(tmp_path, capsys):
    out = tmp_path / "found.json"
    asked = ["--cells", "0", "--in", determinism.FOLDER, "--out", str(out), ITEM]
    assert determinism.main(asked) == 0
    assert capsys.readouterr().out == "another folder: 1 items, 0 cells, 0 otherwise\n"
    counts = {determinism.FOLDER: {"items": 1, "cells": 0, "otherwise": 0}}
    assert json.loads(out.read_text()) == {
        "seed": determinism.SEED, "counts": counts, "otherwise": {},
    }  # fmt: skip


def test_what_comes_out_otherwise_is_named_and_counted(made):
    assert determinism.counted({"warm cache": made})["otherwise"] == {}
    made["items"][ITEM]["obtained"]["links_with_alpha"] += 1
    made["wrong"] = ["toy cell 0: obtained.x: reference 1, found 2"]
    found = determinism.counted({"warm cache": made})
    assert found["counts"]["warm cache"] == {"items": 1, "cells": 2, "otherwise": 2}
    drifted, cell = found["otherwise"]["warm cache"]
    assert drifted.startswith(f"{ITEM} drifted: obtained.links_with_alpha: reference")
    assert cell == made["wrong"][0]


def test_circumstances_differ_from_the_usual_ones():
    usual = determinism.CIRCUMSTANCES["empty cache"]
    same = {name for name, one in determinism.CIRCUMSTANCES.items() if one == usual}
    assert same == {"empty cache", "warm cache"}
    assert list(determinism.CIRCUMSTANCES)[:2] == ["empty cache", "warm cache"], "in this order"


def test_a_process_that_fails_is_no_result(tmp_path, monkeypatch):
    monkeypatch.setattr(determinism, "ROOT", tmp_path)  # there is nothing to run
    with pytest.raises(RuntimeError, match="the process ended with 2"):
        determinism.outcomes(determinism.Circumstance(), [ITEM], 0, tmp_path)


def test_unknown_circumstance(capsys):
    with pytest.raises(SystemExit) as ended:
        determinism.main(["--in", "a full moon"])
    assert ended.value.code == 2
    assert "no circumstance ['a full moon']; there are empty cache" in capsys.readouterr().err
