"""What a first plan needs late is compiled by a second process."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from dualarm_repro.arms import Arm
from dualarm_repro.cli import ahead
from dualarm_repro.machine_code import stamp

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


POPEN = subprocess.Popen
TASKS = Path(__file__).parents[2] / "data/scenes/example_tasks.yaml"


class Process:
    """Stands for the second process: what became of it."""

    def __init__(self, command, **how):
        self.command, self.how, self.calls = command, how, []

    def kill(self):
        self.calls.append("killed")

    def communicate(self):
        self.calls.append("waited for")


@pytest.fixture
def begun(monkeypatch, tmp_path):
    """Processes that were begun, on two cores and with an empty cache."""
    found = []

    def popen(command, **how):
        found.append(Process(command, **how))
        return found[-1]

    monkeypatch.setattr(subprocess, "Popen", popen)
    monkeypatch.setattr(ahead, "_cores", lambda: 2)
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    return found


def test_it_ends_with_the_block_and_leaves_nothing(begun, tmp_path):
    def block():
        with ahead.compiling_ahead(TASKS):
            assert [path.name[:7] for path in tmp_path.iterdir()] == [".ahead-"]
            raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        block()
    assert [one.calls for one in begun] == [["killed", "waited for"]]
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("moment", ["begin", "end"])
def test_an_interruption_leaves_neither_process_nor_folder(begun, tmp_path, monkeypatch, moment):
    begin, end = subprocess.Popen, Process.communicate

    def interrupted(at, call):
        def called(*given, **named):
            found = call(*given, **named)
            if moment == at:
                signal.raise_signal(signal.SIGINT)
            return found

        return called

    monkeypatch.setattr(subprocess, "Popen", interrupted("begin", begin))
    monkeypatch.setattr(Process, "communicate", interrupted("end", end))
    with pytest.raises(KeyboardInterrupt), ahead.compiling_ahead(TASKS):
        assert moment == "end"
    assert [one.calls for one in begun] == [["killed", "waited for"]]
    assert list(tmp_path.iterdir()) == []


def test_the_folder_of_machine_code_is_made(begun, tmp_path, monkeypatch):
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "of" / "nobody"))
    with ahead.compiling_ahead(TASKS):
        assert len(list((tmp_path / "of" / "nobody").iterdir())) == 1


def test_the_second_process_ends_with_the_first_however_that_ends(tmp_path):
    own = tmp_path / ".ahead-1"
    own.mkdir()
    code = f"import time; from {ahead.__name__} import end_with_the_first as f; f(); "
    second = subprocess.Popen(
        [sys.executable, "-c", code + "print('begun', flush=True); time.sleep(600)"],
        env={**os.environ, "NUMBA_CACHE_DIR": str(own)},
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
    )
    second.stdout.readline()
    assert own.is_dir()
    second.stdin.close()  # as the system does when the first one is gone
    second.stdout.close()
    assert second.wait(60) == 0
    assert not own.exists()


@pytest.mark.parametrize(("method", "count"), [("apf-bidirectional", 1), ("all", 0)])
def test_a_plan_is_compiled_ahead(begun, dualarm, tmp_path, method, count):
    scene = tmp_path / "none.yaml"
    assert dualarm("plan", str(scene), "--method", method)[0] == 2
    assert [one.command[-1] for one in begun] == [str(scene)] * count


def _on_one_core(monkeypatch, tmp_path):
    monkeypatch.setattr(ahead, "_cores", lambda: 1)


def _with_machine_code(monkeypatch, tmp_path):
    module = "dualarm_repro.planning.field.gift_wrapping"
    folder = tmp_path / module / stamp(module)[:16]
    folder.mkdir(parents=True)
    (folder / "wrap_hulls.nbi").touch()


def _without_a_cache(monkeypatch, tmp_path):
    monkeypatch.delenv("NUMBA_CACHE_DIR")
    monkeypatch.setenv("DUALARM_CACHE", "off")


def _with_a_cache_that_cannot_be_written(monkeypatch, tmp_path):
    monkeypatch.setenv("NUMBA_CACHE_DIR", "/proc/none")


@pytest.mark.parametrize(
    "where",
    [_on_one_core, _with_machine_code, _without_a_cache, _with_a_cache_that_cannot_be_written],
)
def test_where_it_is_of_no_use_it_is_not_begun(monkeypatch, tmp_path, begun, where):
    where(monkeypatch, tmp_path)
    with ahead.compiling_ahead(TASKS):
        assert begun == []


@pytest.mark.parametrize("fault", [BlockingIOError, TypeError])
def test_a_system_without_further_processes_only_costs_time(monkeypatch, begun, fault):
    def popen(*_, **__):
        raise fault

    monkeypatch.setattr(subprocess, "Popen", popen)
    done = []
    with ahead.compiling_ahead(TASKS):
        done.append("the plan")
    assert done == ["the plan"]


def test_the_process_says_nothing_and_imports_nothing_of_the_users_folder(
    monkeypatch, begun, tmp_path
):
    with ahead.compiling_ahead(TASKS):
        pass
    (one,) = begun
    assert one.how["stdout"] == one.how["stderr"] == subprocess.DEVNULL
    folder = tmp_path / "of the user"
    folder.mkdir()
    (folder / "random.py").write_text("raise SystemExit('run')")
    monkeypatch.setattr(subprocess, "Popen", POPEN)
    assert one.command[-1] == str(TASKS)
    tried = [*one.command[:-2], f"import random; import {ahead.__name__}"]
    environment = {**one.how["env"], "PYTHONSAFEPATH": ""}
    subprocess.run(tried, cwd=folder, env=environment, check=True)


@pytest.mark.parametrize("taken", [False, True])
def test_machine_code_is_moved_where_there_is_none(monkeypatch, tmp_path, taken):
    made, module = tmp_path / ".ahead-1", "dualarm_repro.view.scenes.raster"
    for name in (module, "dualarm_repro.scene.vectors"):
        (made / name / "stamp").mkdir(parents=True)
        for part in ("one.py311.nbi", "one.py311.1.nbc", "two.py311.nbi", "two.py311.1.nbc"):
            (made / name / "stamp" / part).write_text("new")
    place = tmp_path / module / "stamp"
    if taken:
        place.mkdir(parents=True)
        for part in ("one.py311.nbi", "one.py311.1.nbc"):
            (place / part).write_text("old")
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(made))
    for _ in range(2):  # what has been handed over stays
        ahead._publish()
    for part in ("py311.nbi", "py311.1.nbc"):
        assert (place / f"one.{part}").read_text() == ("old" if taken else "new")
        assert (place / f"two.{part}").read_text() == "new"
    assert not (tmp_path / "dualarm_repro.scene.vectors").exists(), "the first process writes these"


def test_no_index_is_handed_over_without_what_it_names(monkeypatch, tmp_path):
    made, module = tmp_path / ".ahead-1", "dualarm_repro.view.scenes.raster"
    for folder in (made, tmp_path):
        (folder / module / "stamp").mkdir(parents=True)
        (folder / module / "stamp" / "one.py311.1.nbc").write_text(folder.name)
    (made / module / "stamp" / "one.py311.nbi").write_text("new")
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(made))
    ahead._publish()
    assert not (tmp_path / module / "stamp" / "one.py311.nbi").exists(), "it is being written there"


def test_machine_code_of_another_folder_stays_where_it_is(monkeypatch, tmp_path):
    made = tmp_path / "kept" / "dualarm_repro.view.scenes.raster" / "stamp"
    made.mkdir(parents=True)
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "kept"))
    ahead._publish()
    assert made.is_dir()


def test_everything_that_is_rehearsed_is_called(monkeypatch):
    called = []
    for name in (
        "planning.field.hull_obstacle.hull_track",
        "planning.search.splice.smoothed",
        "view.scenes.raster.fill_triangles",
        "view.scenes.raster.stroke",
    ):
        path = f"dualarm_repro.{name}"
        monkeypatch.setattr(path, lambda *_, name=name: called.append(name.split(".")[-1]))
    ahead.rehearse("there is none")
    assert called == ["hull_track", "smoothed", "fill_triangles", "stroke"]


def test_arms_are_moved_as_their_tasks_need(monkeypatch):
    moved = []
    for name in ("positions", "jacobian"):
        monkeypatch.setattr(Arm, name, lambda arm, q, name=name: moved.append((arm.name, name)))
    ahead._move_arms(TASKS)
    assert moved == [("panda", "positions"), ("panda", "jacobian"), ("irb120", "positions")]


@pytest.mark.long(short="test_everything_that_is_rehearsed_is_called")
def test_after_the_rehearsal_the_plan_compiles_none_of_it(tmp_path):
    environment = {**os.environ, "DUALARM_CACHE": str(tmp_path)}
    environment.pop("NUMBA_CACHE_DIR", None)
    own = tmp_path / "compiled" / ".ahead-1"
    own.mkdir(parents=True)
    rehearsed = f"from dualarm_repro.cli.ahead import rehearse; rehearse({str(TASKS)!r})"
    subprocess.run(
        [sys.executable, "-c", rehearsed],
        env={**environment, "NUMBA_CACHE_DIR": str(own)},
        check=True,
    )
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
    assert not [name for name in compiled if name.startswith(("position_", "jacobian_"))]
    assert compiled, "what depends on the scene is compiled"
