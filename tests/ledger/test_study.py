"""Stored studies: independent of workers and interruptions, never stale unseen."""

import json

import pytest

from dualarm_repro.errors import DataFileError, InputError, LedgerError
from dualarm_repro.ledger import Registry, Study, study

CELLS = 40


def _cells():
    return [{"k": k, "weights": [k, 1]} for k in range(CELLS)]


def _compute(settings, rng):
    return {"value": settings["k"] * settings["weights"][1] + rng.random(), "seconds": rng.random()}


@pytest.fixture
def toy(tmp_path, monkeypatch):
    monkeypatch.setattr(study, "data_path", lambda *parts: tmp_path.joinpath("data", *parts))

    def make(**changes):
        options = {
            "name": "toy_sweep",
            "title": "a sweep",
            "cells": _cells,
            "compute": _compute,
            "sources": ("ledger/study.py",),
            "seed": 7,
            "measured": ("seconds",),
        }
        return Study(**{**options, **changes})

    return make


def test_same_for_any_number_of_workers(toy, tmp_path):
    one = toy().run(jobs=1, scratch=tmp_path)
    assert toy().run(jobs=2, scratch=tmp_path).equals(one)
    assert toy().load().equals(one)
    assert toy().meta()["cells"] == len(one) == CELLS


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


def test_stale_and_missing(toy, tmp_path):
    with pytest.raises(DataFileError, match="dualarm study toy_sweep"):
        toy().load()
    toy().run(scratch=tmp_path)
    for changed in ({"seed": 8}, {"settings": {"a": 1}}, {"sources": ("ledger/files.py",)}):
        with pytest.raises(LedgerError, match="stale"):
            toy(**changed).load()
    with pytest.raises(LedgerError, match="nothing at ghost"):
        _ = toy(sources=("ledger/ghost.py",)).source_hash


def test_spot_check_finds_a_forged_number(toy, tmp_path):
    table = toy().run(scratch=tmp_path)
    assert toy().spot_check(10, seed=1) == []
    table["value"] += 1e-3
    table.to_parquet(toy().table_path)
    assert len(toy().spot_check(10, seed=1)) == 10
    with pytest.raises(InputError, match="count"):
        toy().spot_check(0, seed=1)


def test_meta_is_json(toy, tmp_path):
    toy().run(scratch=tmp_path)
    meta = json.loads(toy().meta_path.read_text())
    assert {"seed", "settings", "source_hash", "versions"} <= meta.keys()


def test_registered_once(toy):
    registry = Registry()
    registry.keeps(toy())
    with pytest.raises(LedgerError, match="second study"):
        registry.keeps(toy())
