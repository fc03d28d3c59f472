"""Options of a run, and what stands around the suites."""

import sys

import numpy as np
import peers
import pytest
import run
import start_up
from machine import load, machine
from memory import touch


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["nothing"], "suite 'nothing': expected one of"),
        (["--store", "control"], "--store keeps a run of every suite"),
        (["--rounds", "0"], "--rounds 0: expected at least 1"),
    ],
)
def test_wrong_options_end_with_two(arguments, says, monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", ["run.py", *arguments])
    with pytest.raises(SystemExit) as ended:
        run.main()
    assert ended.value.code == 2
    assert says in capsys.readouterr().err


def test_a_peer_that_is_missing_is_named(monkeypatch):
    monkeypatch.setitem(peers.PEERS, "no-such-peer", "everything")
    assert peers.missing()["no-such-peer"] == "everything"
    assert "no-such-peer" not in peers.versions()
    assert "numpy" in peers.versions()


def test_the_machine_is_told_without_name_or_date():
    found = machine()
    assert set(found) == {"cpu", "vectors", "cores", "memory_gb", "system", "python"}
    assert found["cores"] >= 1
    assert found["memory_gb"] > 0.1
    assert load() >= 0.0


def test_touching_reads_and_writes_every_number():
    q, out = np.arange(12.0).reshape(4, 3), np.zeros((4, 5))
    touch(q, out)
    np.testing.assert_array_equal(out, np.tile(q.sum(axis=1)[:, None], 5))


def test_a_cold_process_that_fails_is_told():
    start_up.cold(["-c", "import sys; sys.exit(0)"])
    with pytest.raises(RuntimeError, match="exit code 3, it broke"):
        start_up.cold(["-c", "import sys; print('it broke', file=sys.stderr); sys.exit(3)"])
