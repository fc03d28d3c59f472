"""The template package is built, installed into a folder, listed, planned with and judged."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from zipfile import ZipFile

import pytest

from dualarm_repro.cli import main

TEMPLATE = Path(__file__).parents[2] / "examples" / "planner_package"
NAME = "straight-line"


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """A folder with what an installer puts there: the content of the wheel."""
    folder = tmp_path_factory.mktemp("template")
    source = shutil.copytree(TEMPLATE, folder / "source")
    build = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(folder)]
    subprocess.run(build, cwd=source, check=True, capture_output=True)
    (wheel,) = folder.glob("*.whl")
    with ZipFile(wheel) as content:
        content.extractall(folder / "site")
    return folder / "site"


@pytest.fixture
def dualarm(installed):
    """The command in a process of its own that sees the folder."""
    paths = [str(installed), *filter(None, [os.environ.get("PYTHONPATH")])]
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(paths)}

    def run(*arguments):
        command = [sys.executable, "-m", "dualarm_repro.cli", *map(str, arguments)]
        return subprocess.run(command, env=environment, capture_output=True, text=True)

    return run


def test_wheel_declares_the_planner_and_nothing_else(installed):
    (declared,) = installed.glob("*.dist-info/entry_points.txt")
    lines = declared.read_text(encoding="utf-8").split()
    assert lines == ["[dualarm_repro.planners]", NAME, "=", "straight_line_planner:plan"]


def test_methods_lists_it_with_its_docstring(dualarm):
    done = dualarm("methods", "--json")
    listed = {one["name"]: one["description"] for one in json.loads(done.stdout)}
    assert listed[NAME] == "Straight line of all joints, if it keeps the margin at every look"


def test_arena_judges_it(dualarm):
    """The straight line is blocked on all random tasks, and the planner says so itself."""
    done = dualarm("arena", "--method", NAME, "--kind", "random", "--most", 3, "--json")
    (row,) = json.loads(done.stdout)
    assert row["method"] == NAME
    assert (row["tasks"], row["stops on the way"]) == (3, 3)
    assert row["share"] == row["claimed"] == row["arrives, collides"] == 0


def test_without_it_the_name_is_refused_in_one_line(monkeypatch, capsys):
    """In this process, which has not installed it."""
    monkeypatch.setattr(sys, "argv", ["dualarm", "arena", "--method", NAME])
    with pytest.raises(SystemExit) as ended:
        main()
    told = capsys.readouterr().err
    assert ended.value.code == 2
    assert told.count("\n") == 1
    assert NAME in told
