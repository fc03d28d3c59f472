"""`dualarm plan`, `check` and `view`: what they say about a motion, and how they end."""

import json
import shlex

import pandas as pd
import pytest

from dualarm_repro.datafiles import data_path

TASKS = data_path("scenes", "example_tasks.yaml")
#: An arm that turns through the place of a parked one.
SWEEP = """\
arms:
  left:
    robot: irb120
    xyz: [-0.4, 0, 0]
    start: ["60 deg", "60 deg", -0.5, 0, 0, 0]
    goal: ["-60 deg", "60 deg", -0.5, 0, 0, 0]
  right: {robot: irb120, xyz: [0.4, 0, 0], rpy: [0, 0, pi], start: [0, "60 deg", -0.5, 0, 0, 0]}
"""


@pytest.fixture(scope="module")
def planned(tmp_path_factory):
    """Folder of a plan, made once."""
    return tmp_path_factory.mktemp("plan folder")


@pytest.fixture
def sweep(tmp_path):
    path = tmp_path / "sweep.yaml"
    path.write_text(SWEEP, encoding="utf-8")
    return path


def told(out):
    return dict(line.partition(": ")[::2] for line in out.splitlines())


def test_plan_says_how_to_repeat_and_how_to_look(dualarm, planned):
    """The example of the project arrives and is certified free."""
    method = ("--method", "apf-bidirectional", "--out", planned)
    code, out, _ = dualarm("plan", TASKS, *method)
    assert code == 0
    lines = told(out)
    assert shlex.split(lines["again"]) == ["dualarm", "plan", *map(str, (TASKS, *method))]
    page = planned / "example_tasks.html"
    assert page.is_file()
    assert shlex.split(lines["view"])[-1] == page.as_uri()
    assert lines["outcome"] == "arrived, certified free"
    summary = json.loads((planned / "example_tasks.json").read_text())
    assert summary["usable"] is True
    assert summary["links"]["collision_free"] is True
    low, high = summary["links"]["bracket_m"]
    assert 0.0 < low == summary["links"]["minimum_distance_m"] <= high
    made = json.loads(dualarm("plan", TASKS, *method, "--json")[1])
    assert made["links"] == summary["links"]
    assert str(page) in made["files"]
    assert (made["again"], made["view"]) == (lines["again"], lines["view"])


def test_paths_of_a_plan_are_certified_by_check(dualarm, planned):
    """Another command, from the files alone, says the same."""
    files = [planned / f"example_tasks_{arm}.csv" for arm in ("left", "right")]
    code, out, _ = dualarm("check", TASKS, *files, "--json")
    assert code == 0
    made = json.loads(out)
    summary = json.loads((planned / "example_tasks.json").read_text())
    assert made["links"]["pair"] == summary["links"]["pair"]
    wanted = summary["links"]["minimum_distance_m"]
    # both are lower bounds, each within the tolerance of its certificate
    assert made["links"]["minimum_distance_m"] == pytest.approx(wanted, abs=2e-3)


def test_a_collision_is_called_so_and_ends_with_three(dualarm, sweep, tmp_path):
    out_dir = tmp_path / "o"
    code, out, _ = dualarm("plan", sweep, "--method", "attraction-only", "--out", out_dir)
    assert code == 3
    assert "COLLISION, do not run this on robots" in out
    assert told(out)["right"] == "parked"
    assert told(out)["outcome"] == "COLLISION"
    summary = json.loads((out_dir / "sweep.json").read_text())
    assert summary["arms"]["left"]["reached"] is True
    assert (summary["usable"], summary["links"]["collision_free"]) == (False, False)
    assert summary["links"]["minimum_distance_m"] < -0.09
    table = out_dir / "sweep_left.csv"
    assert table.read_text().startswith("# DO NOT RUN: COLLISION\n")
    assert len(pd.read_csv(table, comment="#")) == summary["arms"]["left"]["steps"] + 1
    assert "COLLISION" in (out_dir / "sweep.html").read_text()
    code, out, _ = dualarm("check", sweep, table)
    assert code == 3
    assert told(out)["left"] == "at its start, at its goal"
    assert "COLLISION" in out


def test_an_arm_that_does_not_arrive_ends_with_three(dualarm, tmp_path):
    """A goal that is free, behind a wall that no method of the kind passes."""
    wall = "obstacles: {wall: {kind: box, center: [0.15, 0, 0.5], size: [0.02, 0.5, 2]}}\n"
    left, right = SWEEP.split("  right:")
    path = tmp_path / "wall.yaml"
    alone = left.replace("-60 deg", "-58 deg")
    path.write_text(alone.replace("-0.4", "-0.2") + wall, encoding="utf-8")
    code, out, _ = dualarm("plan", path, "--method", "apf-improved", "--out", tmp_path / "o")
    assert right
    assert code == 3
    assert "not arrived" in told(out)["outcome"] or "COLLISION" in told(out)["outcome"]


def test_a_bad_goal_ends_with_two_and_writes_nothing(dualarm, tmp_path):
    path = tmp_path / "bad.yaml"
    text = SWEEP.replace("-60 deg", "-170 deg") + "floor: 0.7\n"
    path.write_text(text, encoding="utf-8")
    code, out, err = dualarm("plan", path, "--method", "apf-improved", "--out", tmp_path / "o")
    assert (code, out) == (2, "")
    lines = err.splitlines()
    assert len(lines) > 2
    assert all(line.startswith(f"dualarm: {path}: ") for line in lines)
    assert sum("left.goal: joint_1" in line for line in lines) == 1
    assert not (tmp_path / "o").exists()


def test_collisions_at_the_ends_are_let_pass_on_demand(dualarm, sweep, tmp_path):
    text = sweep.read_text().replace('goal: ["-60 deg"', 'goal: ["0 deg"')
    sweep.write_text(text, encoding="utf-8")
    how = ("plan", sweep, "--method", "attraction-only", "--out", tmp_path / "o")
    code, _, err = dualarm(*how)
    assert code == 2
    assert "left/" in err
    assert not (tmp_path / "o").exists()
    code, out, _ = dualarm(*how, "--allow-collision")
    assert code == 3
    assert "--allow-collision" in told(out)["again"]


def test_check_of_a_scene_alone(dualarm, sweep):
    code, out, _ = dualarm("check", sweep)
    assert code == 0
    assert told(out)["starts and goals"] == "sound"
    sweep.write_text(SWEEP.replace('goal: ["-60 deg"', 'goal: ["0 deg"'), encoding="utf-8")
    code, out, err = dualarm("check", sweep)
    assert (code, out) == (2, "")
    assert "apart, not at a distance of -0.1" in err


def test_view_draws_without_planning(dualarm, sweep, tmp_path):
    code, out, _ = dualarm("view", sweep, "--out", tmp_path / "o")
    assert code == 0
    page = tmp_path / "o" / "sweep_view.html"
    assert told(out)["written"] == str(page)
    made = json.loads(dualarm("view", sweep, "--out", tmp_path / "o", "--json")[1])
    assert made == {"scene": "sweep.yaml", "files": [str(page)]}
    text = page.read_text()
    assert "left" in text
    assert "right" in text
