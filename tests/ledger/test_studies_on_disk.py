"""Random streams, workers and the record of a study: order, chunks and what is stored."""

import json
import signal
import time

import numpy as np
import pandas as pd
import pytest

from dualarm_repro.errors import LedgerError
from dualarm_repro.ledger import Registry, Study, closure, study
from dualarm_repro.ledger.comparison import Comparison
from dualarm_repro.ledger.streams import stream
from dualarm_repro.ledger.workers import results


def test_streams_are_those_of_the_spawned_seed():
    child = np.random.SeedSequence(7).spawn(4)[3]
    np.testing.assert_array_equal(stream(7, 3).random(5), np.random.default_rng(child).random(5))
    first = {stream(seed, index).random() for seed in range(4) for index in range(4)}
    assert len(first) == 16


def power(base, exponent):
    return base**exponent


@pytest.mark.parametrize("jobs", [1, 2])
def test_results_come_in_the_order_of_the_tasks(jobs):
    tasks = ((power, k, 2) for k in range(7))
    assert list(results(tasks, 7, "squares", jobs)) == [k * k for k in range(7)]


def meets(number, folder):
    """Whether the other of a pair of tasks, of which there are some at the end, is under way."""
    if number < 200:
        return True
    (folder / str(number)).touch()
    until = time.monotonic() + 60.0
    while not (met := (folder / str(number ^ 1)).exists()) and time.monotonic() < until:
        time.sleep(0.01)
    return met


def test_no_worker_gets_a_task_while_it_has_another(tmp_path):
    """However short those before were: of two neighbours each worker computes one."""
    tasks = ((meets, number, tmp_path) for number in range(204))
    assert all(results(tasks, 204, "pairs", jobs=2))


def hears(number, _):
    """Whether a signal reaches the process in which this runs."""
    return number not in signal.pthread_sigmask(signal.SIG_BLOCK, ())


@pytest.mark.skipif(not hasattr(signal, "pthread_sigmask"), reason="signals of POSIX")
def test_workers_are_deaf_to_an_interruption_and_who_began_them_is_not():
    asked = [(hears, number, 0) for number in (signal.SIGINT, signal.SIGTERM)]
    assert list(results(asked, 2, "ears", jobs=2)) == [False, True]
    assert hears(signal.SIGINT, 0)


def test_results_are_shown_as_they_come(capsys):
    list(results(((power, k, 1) for k in range(3)), 3, "one by one", progress=True))
    shown = capsys.readouterr()
    assert "one by one" in shown.err
    assert "3/3" in shown.err
    assert shown.out == ""


@pytest.fixture
def toy(tmp_path, monkeypatch):
    for module in (study, closure):
        monkeypatch.setattr(module, "data_path", lambda *parts: tmp_path.joinpath("data", *parts))

    def make(count=5, **changes):
        options = {
            "name": "toy_small",
            "title": "a small one",
            "cells": lambda: [{"k": k, "at": [k, 1], "of": {"a": k}} for k in range(count)],
            "compute": lambda settings, rng: {"value": 2 * settings["k"], "drawn": rng.random()},
            "seed": 11,
            "settings": {"step": 0.5},
            "registry": Registry(tmp_path / "data"),
        }
        return Study(**{**options, **changes})

    return make


@pytest.mark.parametrize("count", [1, 5, 130])
def test_every_cell_has_its_row_with_its_settings_and_stream(toy, tmp_path, count):
    table = toy(count).run(scratch=tmp_path)
    assert table["k"].tolist() == list(range(count))
    assert table["value"].tolist() == [2 * k for k in range(count)]
    assert table["drawn"].tolist() == [stream(11, k).random() for k in range(count)]
    # Settings that are no plain values are kept as JSON texts.
    assert [json.loads(text) for text in table["at"]] == [[k, 1] for k in range(count)]
    assert [json.loads(text) for text in table["of"]] == [{"a": k} for k in range(count)]


def test_the_record_says_what_was_run(toy, tmp_path):
    toy().run(scratch=tmp_path)
    meta = toy().meta()
    assert (meta["title"], meta["seed"], meta["cells"]) == ("a small one", 11, 5)
    assert meta["settings"] == {"step": 0.5}
    assert meta["inputs"] == {}
    assert meta["table_sha256"] == closure.hash_file(toy().table_path)
    assert "dualarm_repro.ledger.streams" in meta["code"]["modules"]
    assert meta["code"]["versions"]["numpy"] == np.__version__
    scratch = tmp_path / f"toy_small-{toy().code['digest'][:16]}"
    assert list(scratch.glob("*.json")) == [], "finished chunks are not kept for ever"


def test_another_setting_is_stale_and_another_title_is_not(toy, tmp_path):
    toy().run(scratch=tmp_path)
    assert toy().status() == "up to date"
    assert toy(settings={"step": 0.6}).status() == "stale: code, seed or settings changed"
    assert toy(title="another title").status() == "up to date"


def test_rows_are_compared_without_what_depends_on_the_machine(toy):
    one = {"value": 1.0, "seconds": 2.0, "rows": json.dumps({"a": 1.0, "b": [1, 2]})}
    plain = toy(measured=("seconds",), nested=("rows",))
    assert plain.differs(one, {**one, "seconds": 9.0}) == []
    near = {**one, "rows": json.dumps({"b": [1, 2], "a": 1.0 + 1e-9})}
    assert plain.differs(one, near) == []
    far = {**one, "value": 1.1, "rows": json.dumps({"a": 1.0, "b": [1, 3]})}
    lines = plain.differs(one, far)
    assert [line.partition(":")[0] for line in lines] == ["obtained.rows.b.1", "obtained.value"]
    tolerant = toy(
        measured=("seconds",),
        nested=("rows",),
        compared=(Comparison("value", "spread", relative=0.2),),
    )
    assert len(tolerant.differs(one, far)) == 1
    assert plain.differs(one, {"value": 1.0, "rows": one["rows"], "new": 3}) != []


def test_a_cell_that_cannot_be_computed_stores_nothing(toy, tmp_path):
    def compute(settings, rng):
        if settings["k"] == 3:
            raise LedgerError("not this one")
        return {"value": 0.0}

    with pytest.raises(LedgerError, match="not this one"):
        toy(compute=compute).run(scratch=tmp_path)
    assert toy().status() == "missing"
    assert not toy().table_path.exists()


def test_a_table_is_read_as_it_was_written(toy, tmp_path):
    written = toy().run(scratch=tmp_path)
    pd.testing.assert_frame_equal(toy().load(), written)
    assert list(written.columns) == ["k", "at", "of", "value", "drawn"]
