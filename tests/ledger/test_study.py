"""Stored studies: independent of workers and interruptions, never stale unseen."""

import json
import os

import pandas as pd
import pytest

from dualarm_repro.errors import DataFileError, InputError, LedgerError
from dualarm_repro.ledger import Registry, Study, closure, round_off, study
from dualarm_repro.ledger.spot import spot_check
from dualarm_repro.tracking import note

CELLS = 40


def _cells():
    return [{"k": k, "weights": [k, 1]} for k in range(CELLS)]


def _compute(settings, rng):
    note("robots/toy.yaml")
    return {
        "value": settings["k"] * settings["weights"][1] + rng.random(),
        "seconds": rng.random(),
        "nested": json.dumps({"a": 0.1 * settings["k"]}),
    }


@pytest.fixture
def data(tmp_path, monkeypatch):
    folder = tmp_path / "data"
    (folder / "robots").mkdir(parents=True)
    (folder / "robots" / "toy.yaml").write_text("a: 1\n")
    for module in (study, closure):
        monkeypatch.setattr(module, "data_path", lambda *parts: folder.joinpath(*parts))
    return folder


@pytest.fixture
def toy(data):
    def make(**changes):
        options = {
            "name": "toy_sweep",
            "title": "a sweep",
            "cells": _cells,
            "compute": _compute,
            "seed": 7,
            "measured": ("seconds",),
            "nested": ("nested",),
            "registry": Registry(data),
        }
        return Study(**{**options, **changes})

    return make


def test_same_bytes_for_any_number_of_workers(toy, tmp_path):
    one = toy().run(jobs=1, scratch=tmp_path)
    stored = toy().table_path.read_bytes(), toy().meta_path.read_bytes()
    assert toy().run(jobs=2, scratch=tmp_path).equals(one)
    assert (toy().table_path.read_bytes(), toy().meta_path.read_bytes()) == stored
    assert toy().load().equals(one)
    assert toy().meta()["cells"] == len(one) == CELLS


def test_same_bytes_on_a_dask_cluster(toy, tmp_path):
    from dask.distributed import LocalCluster

    toy().run(jobs=1, scratch=tmp_path)
    stored = toy().table_path.read_bytes()
    with LocalCluster(
        n_workers=1, threads_per_worker=1, processes=False, dashboard_address=None
    ) as c:
        toy().run(scratch=tmp_path, scheduler=c.scheduler_address)
    assert toy().table_path.read_bytes() == stored


def test_no_scheduler_there(toy, tmp_path):
    with pytest.raises(InputError, match="--scheduler"):
        toy().run(scratch=tmp_path, scheduler="nonsense")


def test_resumes(toy, tmp_path):
    calls = []

    def compute(settings, rng):
        calls.append(settings["k"])
        if settings["k"] == 30 and calls.count(30) == 1:
            raise RuntimeError("killed")
        return _compute(settings, rng)

    with pytest.raises(RuntimeError, match="killed"):
        toy(compute=compute).run(scratch=tmp_path)
    table = toy(compute=compute).run(scratch=tmp_path)
    assert sorted(set(calls)) == list(range(CELLS))
    assert calls.count(3) == 1
    assert table.equals(toy().run(scratch=tmp_path))


def test_the_dearest_cells_are_computed_first_and_their_rows_stay_in_place(toy, tmp_path):
    calls = []

    def compute(settings, rng):
        calls.append(settings["k"])
        return _compute(settings, rng)

    table = toy(compute=compute, dearest=(30, 7)).run(scratch=tmp_path)
    assert calls == [30, 7, *(k for k in range(CELLS) if k not in (30, 7))]
    assert table.equals(toy().run(scratch=tmp_path))


def test_a_dearest_cell_that_there_is_not_is_named(toy, tmp_path):
    with pytest.raises(InputError, match=rf"dearest.*{CELLS}"):
        toy(dearest=(CELLS,)).run(scratch=tmp_path)


def test_a_damaged_chunk_is_computed_again(toy, tmp_path):
    expected = toy().run(scratch=tmp_path)
    folder = tmp_path / f"toy_sweep-{toy().code['digest'][:16]}"
    for text in ("", "[]", "{", '{"rows": [], "inputs": []}', '{"rows": 1, "inputs": []}'):
        (folder / "000000.json").write_text(text)
        assert toy().run(scratch=tmp_path).equals(expected)


def test_stale_and_missing(toy, tmp_path, data):
    assert toy().status() == "missing"
    with pytest.raises(DataFileError, match="dualarm study toy_sweep"):
        toy().load()
    toy().run(scratch=tmp_path)
    assert toy().status() == "up to date"
    assert "robots/toy.yaml" in toy().meta()["inputs"]
    for changed in ({"seed": 8}, {"settings": {"a": 1}}, {"also": ("dualarm_repro.errors",)}):
        with pytest.raises(LedgerError, match="stale: code, seed or settings changed"):
            toy(**changed).load()
    (data / "robots" / "toy.yaml").write_text("a: 2\n")
    with pytest.raises(LedgerError, match=r"robots/toy\.yaml changed"):
        toy().load()


def test_a_falsified_or_truncated_table_is_found(toy, tmp_path):
    table = toy().run(scratch=tmp_path)
    good = toy().table_path.read_bytes()
    table["value"] *= 1.5
    table.to_parquet(toy().table_path, index=False)
    with pytest.raises(LedgerError, match="the table is not the one that was computed"):
        toy().load()
    toy().table_path.write_bytes(good[:100])
    with pytest.raises(LedgerError, match="the table is not the one"):
        toy().load()
    toy().table_path.unlink()
    assert toy().status() == "missing"
    with pytest.raises(LedgerError, match="missing"):
        toy().load()


@pytest.mark.parametrize("text", ["", "[]", "{}", "null"])
def test_a_damaged_record_of_the_study(toy, tmp_path, text):
    toy().run(scratch=tmp_path)
    toy().meta_path.write_text(text)
    assert toy().status() == "stale: its record cannot be read"
    with pytest.raises(DataFileError):
        toy().load()


def _forge(study):
    """Another number in the table, with a hash that fits."""
    table = pd.read_parquet(study.table_path)
    table["value"] += 1e-3
    table.to_parquet(study.table_path, index=False)
    meta = json.loads(study.meta_path.read_text())
    meta["table_sha256"] = closure.hash_file(study.table_path)
    study.meta_path.write_text(json.dumps(meta))


def test_spot_check_finds_a_forged_number(toy, tmp_path):
    toy().run(scratch=tmp_path)
    assert spot_check(toy(), 10, seed=1).wrong == []
    _forge(toy())
    assert len(spot_check(toy(), 10, seed=1).wrong) == 10
    with pytest.raises(InputError, match="count"):
        spot_check(toy(), 0, seed=1)


def test_spot_check_finds_an_input_that_is_not_recorded(toy, tmp_path):
    toy().run(scratch=tmp_path)
    meta = json.loads(toy().meta_path.read_text())
    meta["inputs"] = {}
    toy().meta_path.write_text(json.dumps(meta))
    (line,) = spot_check(toy(), 1, seed=1).wrong
    assert "opened robots/toy.yaml, which is not recorded" in line


def test_columns_of_a_peer_that_is_missing(toy, tmp_path):
    toy().run(scratch=tmp_path)
    _forge(toy())
    lacking = toy(peers={"no_such_package": "value"})
    assert lacking.missing_peers() == ["no_such_package"]
    assert spot_check(lacking, 10, seed=1).wrong == []
    with pytest.raises(LedgerError, match="no_such_package not installed"):
        lacking.run(scratch=tmp_path)


def test_registered_once(toy):
    registry = Registry()
    registry.keeps(toy())
    with pytest.raises(LedgerError, match="second study"):
        registry.keeps(toy())


def test_a_certificate_is_computed_from_the_stored_row_alone(toy, tmp_path):
    """What a search found may differ; what holds where it ended has to follow from the row."""
    found = iter(range(10**6))

    def search(settings, rng):
        note("robots/toy.yaml")
        place = 0.001 * settings["k"] + next(found)
        return {"place": place, "square": place**2}

    def certificate(settings, row):
        return {"square": row["place"] ** 2}

    options = {"compute": search, "measured": ("place", "square"), "nested": ()}
    study = toy(**options, certificate=certificate)
    study.run(jobs=1, scratch=tmp_path)
    assert spot_check(study, 5, seed=1).wrong == []
    wrong = toy(**options, certificate=lambda settings, row: {"square": 1.1 * row["place"] ** 2})
    assert len(spot_check(wrong, 5, seed=1).wrong) == 5


def test_a_cell_that_next_to_nothing_decides_is_not_compared(toy, tmp_path):
    """Whether the stored row says so, or the new one on another processor."""
    here = {"delicate": (0, 1), "offset": 0.0}

    def descent(settings, rng):
        note("robots/toy.yaml")
        return {
            "value": settings["k"] + here["offset"],
            "delicate": settings["k"] in here["delicate"],
        }

    study = toy(compute=descent, nested=(), measured=(), knife_edge="delicate")
    study.run(jobs=1, scratch=tmp_path)
    assert spot_check(study, CELLS, seed=1).wrong == []
    here |= {"delicate": (0, 1, 2), "offset": 1e-3}
    differing = spot_check(study, CELLS, seed=1).wrong
    assert len(differing) == CELLS - 3
    assert not any(" cell 2:" in line for line in differing)


def _nudge(seed):
    os.environ["TOY_NUDGE"] = str(seed + 1)


def _along_a_crease(settings, rng):
    note("robots/toy.yaml")
    shift = float(os.environ.get("TOY_NUDGE", 0))
    return {"end": settings["k"] + shift, "kept": settings["k"]}


def test_what_round_off_of_the_inputs_moves_is_told_apart(toy, tmp_path, monkeypatch):
    study = toy(compute=_along_a_crease, nested=(), measured=())
    study.run(jobs=1, scratch=tmp_path)
    assert spot_check(study, 2, seed=1)[2:] == ([], [])
    table = pd.read_parquet(study.table_path)
    table[["end", "kept"]] += 0.1
    monkeypatch.setattr(pd, "read_parquet", lambda _: table)
    spot = spot_check(study, 1, seed=1)
    assert len(spot.wrong) == 2, "without a nudge nothing is excused"
    study.registry.nudge = _nudge
    # Each nudge is a process; what stays as it is would ask for all of them.
    monkeypatch.setattr(round_off, "NUDGES", 2)
    spot = spot_check(study, 1, seed=1)
    assert [line.split(": ")[1] for line in spot.unsettled] == ["obtained.end"]
    assert [line.split(": ")[1] for line in spot.wrong] == ["obtained.kept"]
    assert "TOY_NUDGE" not in os.environ, "nudged in processes of their own"
