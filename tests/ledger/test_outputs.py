"""Exports of one item and reference results."""

import json

import pytest

from dualarm_repro.errors import DataFileError, OutputError
from dualarm_repro.ledger import evaluate, record, reference
from dualarm_repro.ledger.export import export
from dualarm_repro.ledger.files import to_json, write
from dualarm_repro.view.card import card_figure

from .toy import toy_registry


@pytest.fixture
def toy(tmp_path, monkeypatch):
    monkeypatch.setattr(reference, "data_path", lambda *parts: tmp_path.joinpath("data", *parts))
    return toy_registry(tmp_path)


def test_export_writes_the_four_files(toy, tmp_path):
    evaluation = evaluate(toy, "toy.claim_area")
    made = record(toy, "toy.claim_area")
    files = export(evaluation, made, tmp_path / "out", card_figure)
    assert sorted(path.suffix for path in files) == [".csv", ".json", ".png", ".svg"]
    assert sorted(tmp_path.joinpath("out").iterdir()) == sorted(files)
    assert json.loads((tmp_path / "out/toy.claim_area.json").read_text()) == made
    assert (tmp_path / "out/toy.claim_area.csv").read_text() == "quantity,value\narea,0.75\n"
    svg = (tmp_path / "out/toy.claim_area.svg").read_bytes()
    export(evaluation, made, tmp_path / "out", card_figure)
    assert (tmp_path / "out/toy.claim_area.svg").read_bytes() == svg


def test_unwritable_folder(toy, tmp_path):
    (tmp_path / "file").write_text("")
    made = record(toy, "toy.claim_area")
    with pytest.raises(OutputError, match="a folder that can be written"):
        export(evaluate(toy, "toy.claim_area"), made, tmp_path / "file" / "out", card_figure)


def test_failed_write_leaves_nothing(tmp_path):
    def save(path):
        path.write_text("half")
        raise OSError(28, "No space left on device")

    with pytest.raises(OutputError, match="No space left"):
        write(tmp_path / "result.json", save)
    assert list(tmp_path.iterdir()) == []


def test_json_has_no_nan():
    import numpy as np

    assert json.loads(
        to_json({"a": np.float64("nan"), "b": np.arange(2), "c": np.bool_(True)})
    ) == {
        "a": None,
        "b": [0, 1],
        "c": True,
    }


def test_verify_finds_drift(toy, tmp_path):
    ids = list(toy.items)
    report = reference.verify(toy, ids, update=True)
    assert report["drifted"] == []
    clean = reference.verify(toy, ids)
    assert clean["checked"] == 3
    assert clean["drifted"] == []
    assert clean["verdicts"] == {
        "reproduced": 1,
        "reproduced-under-assumption": 1,
        "not-attempted": 1,
    }
    path = tmp_path / "data/results/toy.json"
    content = json.loads(path.read_text())
    content["items"]["toy.claim_area"]["obtained"]["area"] *= 1 + 2e-6
    path.write_text(json.dumps(content))
    drifted = reference.verify(toy, ids)["drifted"]
    assert [entry["id"] for entry in drifted] == ["toy.claim_area"]
    assert "obtained.area" in drifted[0]["differences"][0]
    content["items"]["toy.claim_area"]["obtained"]["area"] *= (1 + 5e-7) / (1 + 2e-6)
    path.write_text(json.dumps(content))
    assert reference.verify(toy, ids)["drifted"] == []


def test_broken_reference(toy, tmp_path):
    path = tmp_path / "data/results/toy.json"
    path.parent.mkdir(parents=True)
    path.write_text("{")
    with pytest.raises(DataFileError, match="reference results as JSON"):
        reference.verify(toy, ["toy.claim_area"])
