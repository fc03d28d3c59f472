"""Faults in their short form: a few of each kind, on the commands that take least."""

import os
import sys
from pathlib import Path

import faults
import pytest
from fault_injection import caches, struck, surroundings
from fault_injection.calls import Call, Place, called, computed, reaches, start
from fault_injection.jobs import OUT, SHOW, STUDY, Job, cli, refusal
from fault_injection.laboratory import Trial, damages

CITE = cli("cite", "cite", "xue.eq01", told=True)


def lost(trials):
    """What did not survive; there was something to survive."""
    trials = list(trials)
    assert trials
    return [trial for trial in trials if trial.wrong]


def test_a_study_that_is_killed_goes_on(lab):
    assert lost(struck.killed(lab, [STUDY])) == []


def test_a_damaged_table_is_noticed_and_computed_again(lab):
    assert lost(caches.tables(lab)) == []


def test_a_damaged_record_is_a_miss(lab):
    assert lost(caches.records(lab)) == []


def test_any_locale(lab, monkeypatch):
    name = "C, no UTF-8 at all"
    monkeypatch.setattr(surroundings, "LOCALES", {name: surroundings.LOCALES[name]})
    assert lost(surroundings.locales(lab, [SHOW])) == []


def test_any_folder(lab):
    assert lost(surroundings.folders(lab, [CITE])) == []


def writes(text, name="out"):
    """A command that writes a file slowly, then says so."""
    program = (
        "import pathlib, sys, time\n"
        f"pathlib.Path({OUT!r}).mkdir(exist_ok=True)\n"
        f"with open({OUT!r} + '/a.txt', 'w') as file:\n"
        f"    for letter in {text!r}:\n"
        "        file.write(letter); file.flush()\n"
        "        end = time.process_time() + 0.02\n"
        "        while time.process_time() < end: pass\n"
    )
    return Job(name, (sys.executable, "-c", program))


def test_a_command_that_writes_in_place_is_caught(lab):
    (trial,) = struck.killed(lab, [writes("abcdefghijklmnopqrstuvwxyz" * 2)])
    assert trial.wrong == "half-written: a.txt"


def test_a_command_that_fails_undisturbed_is_no_measure(lab):
    with pytest.raises(RuntimeError, match="fails undisturbed: ValueError: here"):
        lab.undisturbed(Job("bad", (sys.executable, "-c", "raise ValueError('here')")))
    clock = f"import pathlib, time; pathlib.Path({OUT!r}).mkdir(); print(time.time_ns())"
    with pytest.raises(RuntimeError, match="other results the second time"):
        lab.undisturbed(Job("clock", (sys.executable, "-c", clock), told=True))


def test_what_is_no_proper_ending():
    assert refusal(Call(2, "", "dualarm: no room\n", 0)) == ""
    assert refusal(Call(0, "", "dualarm: no room\n", 0)).startswith("exit code 0")
    assert refusal(Call(2, "", "Traceback\nOSError: no room\n", 0)) == "2 lines: OSError: no room"
    assert refusal(Call(70, "", "x of /a/b/c is bad", 0)) == "exit code 70: x of (…) is bad"
    job = Job("job", ("true",), told=True)
    call = Call(0, "3", "", 0)
    assert job.complaint(call, {"standard output": "3"}, Path("nowhere")) == ""
    assert "standard output" in job.complaint(call, {"standard output": "4"}, Path("nowhere"))
    assert job.complaint(call._replace(code=1), {}, Path("nowhere")).startswith("exit code 1")


def test_a_strike_comes_at_a_moment_of_the_command_itself(tmp_path):
    place = Place(tmp_path, tmp_path)
    process = start([sys.executable, "-c", "while True: pass"], place)
    try:
        assert reaches(process, 0.2)
        assert computed(process) >= 0.2
    finally:
        process.kill()
        process.communicate()
    assert not reaches(process, 10.0)
    assert not reaches(start([sys.executable, "-c", ""], place), 60.0)


def test_every_damage_damages(lab, tmp_path):
    for way, damage in damages(lab.rng).items():
        path = tmp_path / way
        path.write_bytes(b"0123456789" * 20)
        damage(path)
        if way == "another owner":
            assert path.stat().st_mode & 0o777 == 0
        else:
            assert path.is_dir() or path.read_bytes() != b"0123456789" * 20, way


def test_a_hidden_package_is_not_there(lab):
    hide = lab.scratch / "hidden"
    hide.mkdir()
    (hide / "sitecustomize.py").write_text(surroundings._HIDES)
    place = lab.place(
        cache=hide, changes={"PYTHONPATH": str(hide), "FAULTS_MISSING": "colorsys,wave"}
    )
    program = "from importlib.util import find_spec as f; print(f('wave'), f('calendar') is None)"
    assert called([sys.executable, "-c", program], place).out == "None False\n"
    assert called([sys.executable, "-c", "import colorsys"], place).code == 1


def test_counts_hold_neither_clocks_nor_folders():
    trials = [Trial("killed", "run", ""), Trial("killed", "run", "x"), Trial("killed", "run", "x")]
    found = faults.counted([*trials, Trial("locale", "show", "")])
    assert found["counts"] == {
        "killed": {"tried": 3, "survived": 1},
        "locale": {"tried": 1, "survived": 1},
    }
    assert found["lost"] == {"killed: run: x": 2}
    assert os.sep not in str(found["lost"])
