"""Settings change the machine code that runs, and what moves under one is reported."""

import json
import sys

import machine_code
import pytest
import verify_portable
from long_tests import long_where
from machine_code import Setting, settings

SETTINGS = {setting.name: setting for setting in settings()}
PARTS = [name for name in SETTINGS if name not in ("nominal", "everything")]


@pytest.fixture(scope="module")
def here():
    """The machine code of this process."""
    return machine_code.probe()


@pytest.fixture
def machine(tmp_path):
    """The machine code that a process under a setting reports, with no item computed."""
    return lambda name: verify_portable.outcomes(SETTINGS[name], [], tmp_path, 0)["machine"]


@pytest.mark.parametrize("name", long_where(lambda name: name not in ("libm", "fused"), PARTS))
def test_a_part_takes_effect_and_leaves_the_rest(name, machine, here):
    there, setting = machine(name), SETTINGS[name]
    assert setting.without_effect(there) == []
    assert {key for key in here if here[key] != there[key]} == set(setting.changes)
    assert setting.without_effect(here)


def test_everything_takes_effect(machine):
    there = machine("everything")
    assert SETTINGS["everything"].without_effect(there) == []
    assert there["numba"]["cpu"] == "generic"
    assert not there["numba"]["fma"]
    assert there["numpy"] == []
    assert len(set(there["blas"].values())) <= 1


def test_both_openblas_are_seen(here):
    if machine_code.platform.machine() != "x86_64" or sys.platform != "linux":
        pytest.skip("core types of OpenBLAS are read on Linux only")
    assert set(here["blas"]) == {"numpy.libs", "scipy.libs"}
    cores = [name for name in SETTINGS if name.startswith("blas-")]
    assert len(cores) == 2


def test_without_variables_a_process_is_as_this_one_and_a_setting_fails(monkeypatch, capsys, here):
    """The nominal process in all but its name, asked for an effect."""
    assert SETTINGS["nominal"] == Setting("nominal", {}, {})
    idle = Setting("idle", {}, {"numpy": here["numpy"]})
    monkeypatch.setattr(verify_portable, "settings", lambda: [idle])
    given, made = verify_portable.outcomes, []
    monkeypatch.setattr(
        verify_portable, "outcomes", lambda *asked: made.append(given(*asked)) or made[-1]
    )
    assert verify_portable.main(["--cells", "0", "xue.eq01"]) == 1
    assert [one["machine"] for one in made] == [here]
    out = capsys.readouterr().out
    assert "no effect on numpy" in out
    assert "1 checked,   0 drifted,   0 verdicts changed" in out


def test_drift_and_changed_verdicts_are_counted(monkeypatch, capsys, tmp_path):
    moved = {"verdict": "undecidable", "obtained": None, "proofs": {}}
    made = {"machine": {}, "items": {"xue.eq01": moved}, "cells": 3, "wrong": [], "unsettled": []}
    monkeypatch.setattr(verify_portable, "outcomes", lambda *_: made)
    assert verify_portable.main(["--setting", "nominal", "xue.eq01"]) == 1
    out = capsys.readouterr().out
    assert "1 checked,   1 drifted,   1 verdicts changed" in out
    assert "xue.eq01: verdict" in out


def test_a_cell_of_a_study_that_comes_out_otherwise_fails(monkeypatch, capsys, here):
    machine = {"fused": not here["fused"]}
    wrong = ["toy cell 1: obtained.x moved"]
    made = {"machine": machine, "items": {}, "cells": 3, "wrong": wrong, "unsettled": []}
    monkeypatch.setattr(verify_portable, "outcomes", lambda *_: made)
    assert verify_portable.main(["--setting", "nominal", "xue.eq01"]) == 1
    out = capsys.readouterr().out
    assert "3 cells of studies, 1 otherwise" in out
    assert "toy cell 1" in out
    assert verify_portable.main(["--setting", verify_portable.STRESS, "xue.eq01"]) == 0
    assert "toy cell 1" in capsys.readouterr().out
    made |= {"wrong": [], "unsettled": wrong}
    assert verify_portable.main(["--setting", "nominal", "xue.eq01"]) == 0
    assert "by round-off of the inputs too: toy cell 1" in capsys.readouterr().out


def test_the_short_sample_holds_what_is_delicate(registry):
    chosen = verify_portable.sample()
    assert chosen == verify_portable.sample()
    assert {key for key, item in registry.items.items() if item.tolerances} <= set(chosen)
    assert len(chosen) == len(set(chosen))
    assert set(chosen) <= set(registry.items)


def test_spreads_name_what_moves():
    runs = {
        "a": {"i": {"obtained": {"x": 1.0, "y": 1.0, "n": 3, "s": "left", "z": 0.0}}},
        "b": {"i": {"obtained": {"x": 1.0 + 1e-7, "y": 1.0 + 1e-12, "n": 4, "s": "right"}}},
    }
    rows = {row["path"]: row["relative"] for row in verify_portable.spreads(runs)}
    assert set(rows) == {"i.obtained.x", "i.obtained.n", "i.obtained.s", "i.obtained.z"}
    assert rows["i.obtained.x"] == pytest.approx(1e-7, rel=1e-3)
    json.dumps(list(rows))


def test_a_process_that_fails_is_reported(tmp_path, monkeypatch):
    monkeypatch.setattr(verify_portable, "ROOT", tmp_path)  # there is nothing to run
    with pytest.raises(RuntimeError, match="nominal: the process ended with 2"):
        verify_portable.outcomes(SETTINGS["nominal"], ["xue.eq01"], tmp_path, 0)


def test_unknown_setting(monkeypatch, capsys):
    monkeypatch.setattr(verify_portable, "settings", SETTINGS.values)
    with pytest.raises(SystemExit) as ended:
        verify_portable.main(["--setting", "abacus"])
    assert ended.value.code == 2
    assert "no setting ['abacus'] here; there are nominal" in capsys.readouterr().err
