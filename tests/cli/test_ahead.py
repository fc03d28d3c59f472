"""What a first plan needs late is compiled by a second process."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from dualarm_repro.cli import ahead
from dualarm_repro.planning.field.gift_wrapping import wrap_hulls
from dualarm_repro.view.scenes.raster import fill_triangles, stroke

#: A first plan in a process that tells which functions it compiled itself.
FIRST_PLAN = """
import sys
from numba.core import event
class Listener(event.Listener):
    def on_start(self, one):
        print("compiled", one.data["dispatcher"].py_func.__name__)
    def on_end(self, one):
        pass
event.register("numba:compile", Listener())
from dualarm_repro.cli import main
main()
"""


class Process:
    """Stands for the second process: what became of it."""

    def __init__(self, command, **how):
        self.command, self.how, self.calls = command, how, []

    def terminate(self):
        self.calls.append("terminated")

    def wait(self):
        self.calls.append("waited for")


@pytest.fixture
def begun(monkeypatch):
    """Processes that were begun, on a machine with two cores."""
    found = []

    def popen(command, **how):
        found.append(Process(command, **how))
        return found[-1]

    monkeypatch.setattr(subprocess, "Popen", popen)
    monkeypatch.setattr(os, "cpu_count", lambda: 2)
    return found


@pytest.mark.parametrize(
    ("cores", "kept", "wanted"),
    [(2, False, 1), (2, True, 0), (2, None, 0), (1, False, 0), (None, False, 0)],
)
def test_it_is_begun_where_it_helps_and_ends_with_the_block(
    monkeypatch, begun, cores, kept, wanted
):
    monkeypatch.setattr(os, "cpu_count", lambda: cores)
    monkeypatch.setattr("dualarm_repro.machine_code.is_kept", lambda _: kept)
    with pytest.raises(ZeroDivisionError), ahead.compiling_ahead():
        raise ZeroDivisionError
    assert [one.calls for one in begun] == [["terminated", "waited for"]] * wanted


def test_a_system_without_further_processes_only_costs_time(monkeypatch):
    def popen(*_, **__):
        raise BlockingIOError

    monkeypatch.setattr(subprocess, "Popen", popen)
    monkeypatch.setattr(os, "cpu_count", lambda: 2)
    monkeypatch.setattr("dualarm_repro.machine_code.is_kept", lambda _: False)
    done = []
    with ahead.compiling_ahead():
        done.append("the plan")
    assert done == ["the plan"]


def test_the_process_finds_the_package_and_says_nothing(monkeypatch, begun):
    monkeypatch.setattr("dualarm_repro.machine_code.is_kept", lambda _: False)
    with ahead.compiling_ahead():
        pass
    (one,) = begun
    assert one.command[0] == sys.executable
    assert one.how["stdout"] == one.how["stderr"] == subprocess.DEVNULL
    assert set(one.how["env"]["PYTHONPATH"].split(os.pathsep)) == set(filter(None, sys.path))


def test_what_is_rehearsed_is_compiled():
    ahead.rehearse()
    for one in (wrap_hulls, fill_triangles, stroke):
        assert one.signatures


@pytest.mark.long(short="test_what_is_rehearsed_is_compiled")
def test_after_the_rehearsal_the_plan_compiles_none_of_it(tmp_path):
    environment = {**os.environ, "DUALARM_CACHE": str(tmp_path)}
    environment.pop("NUMBA_CACHE_DIR", None)
    rehearsed = "from dualarm_repro.cli.ahead import rehearse; rehearse()"
    subprocess.run([sys.executable, "-c", rehearsed], env=environment, check=True)
    example = ["data/scenes/example_tasks.yaml", "--method", "apf-bidirectional"]
    done = subprocess.run(
        [sys.executable, "-c", FIRST_PLAN, "plan", *example, "--out", str(tmp_path / "out")],
        env=environment,
        cwd=Path(__file__).parents[2],
        check=True,
        capture_output=True,
        text=True,
    )
    lines = done.stdout.splitlines()
    compiled = {line.split()[1] for line in lines if line.startswith("compiled ")}
    assert not compiled & {"wrap_hulls", "_wrapped", "_smooth", "fill_triangles", "stroke"}
    assert compiled, "what depends on the arm is compiled"
