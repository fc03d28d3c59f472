"""`dualarm plan`: what it says about the motion, and the commands to go on with."""

import json
import shlex

import pytest

from dualarm_repro.datafiles import data_path

TASKS = data_path("scenes", "example_tasks.yaml")


@pytest.fixture(scope="module")
def planned(tmp_path_factory):
    """Folder of a plan, made once."""
    return tmp_path_factory.mktemp("plan folder")


def test_plan_says_how_to_repeat_and_how_to_look(dualarm, planned):
    method = ("--method", "attraction-only", "--out", planned)
    code, out, _ = dualarm("plan", TASKS, *method)
    assert code == 0
    lines = dict(line.partition(": ")[::2] for line in out.splitlines())
    assert shlex.split(lines["again"]) == ["dualarm", "plan", *map(str, (TASKS, *method))]
    page = planned / "example_tasks.html"
    assert page.is_file()
    assert shlex.split(lines["view"])[-1] == page.as_uri()
    summary = json.loads((planned / "example_tasks.json").read_text())
    assert ("COLLISION" in lines["closest bodies"]) is not summary["links"]["collision_free"]
    made = json.loads(dualarm("plan", TASKS, *method, "--json")[1])
    assert made["links"] == summary["links"]
    assert str(page) in made["files"]
    assert (made["again"], made["view"]) == (lines["again"], lines["view"])
