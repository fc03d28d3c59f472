"""`dualarm run ID --set assumption=value`: said, compared, and not stored."""

import json

import pytest

from dualarm_repro.ledger import kept


@pytest.fixture
def declared(registry):
    """The declared distance of the bases [m]."""
    return registry.nominal("xue")["base_distance"]


def test_a_changed_run_says_what_was_changed_and_stores_nothing(
    dualarm, declared, tmp_path, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    before = json.loads(dualarm("show", "xue.claim_overlap", "--json")[1])
    place = kept.path_of("records", "xue.claim_overlap")
    stored = place.read_bytes() if place else b""
    code, out, _ = dualarm("run", "xue.claim_overlap", "--set", "base_distance=6.5")
    assert code == 0
    assert f"changed: base_distance = 6.5 m ({declared} in the ledger; plausible" in out
    assert "this is outside" in out
    assert "verdict: not-reproduced with these values alone; reproduced-under-assumption" in out
    assert "again: dualarm run xue.claim_overlap --set=base_distance=6.5" in out
    assert "(declared values: " in out
    assert "nothing is stored" in out
    assert list(tmp_path.iterdir()) == []
    assert (place.read_bytes() if place else b"") == stored
    assert json.loads(dualarm("show", "xue.claim_overlap", "--json")[1]) == before


def test_files_of_a_changed_run_say_so(dualarm, declared, tmp_path):
    setting = ("--set", "base_distance=3.0", "--out", tmp_path, "--json")
    code, out, _ = dualarm("run", "xue.claim_overlap", *setting)
    assert code == 0
    (made,) = json.loads(out)
    written = json.loads((tmp_path / "xue.claim_overlap.json").read_text())
    assert written["changed"] == made["changed"]
    (change,) = written["changed"]
    assert (change["assumption"], change["value"], change["nominal"]) == (
        "base_distance",
        3.0,
        declared,
    )
    assert written["nominal"]["obtained"] != written["obtained"]
    assert str(tmp_path / "xue.claim_overlap.png") in made["files"]


@pytest.mark.parametrize("setting", ["base_distance=", "=3", "nothing=1", "base_distance=[1]"])
def test_a_wrong_change_leaves_nothing(dualarm, tmp_path, monkeypatch, setting):
    monkeypatch.chdir(tmp_path)
    code, out, err = dualarm("run", "xue.eq01", "xue.claim_overlap", "--set", setting)
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert list(tmp_path.iterdir()) == []
