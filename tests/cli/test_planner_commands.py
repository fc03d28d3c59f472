"""`methods`, `plan` with baselines, `time` and `arena`: what they say and how they end."""

import json
import re

import pandas as pd
import pytest
import yaml

from dualarm_repro.arena import ARENA, Outcome
from dualarm_repro.baselines import BASELINES
from dualarm_repro.planning import METHODS
from dualarm_repro.view import plan_report

#: Both arms turn away from each other.
FREE = """\
arms:
  left: {robot: irb120, xyz: [-0.4, 0, 0], start: ["60 deg", 0, 0, 0, 0, 0], goal: ["100 deg", 0, 0, 0, 0, 0]}
  right:
    {robot: irb120, xyz: [0.4, 0, 0], rpy: [0, 0, pi], start: ["60 deg", 0, 0, 0, 0, 0], goal: ["100 deg", 0, 0, 0, 0, 0]}
"""  # noqa: E501


@pytest.fixture(autouse=True)
def methods():
    """The list of planners, which is as it was afterwards."""
    before = dict(METHODS)
    yield
    METHODS.clear()
    METHODS.update(before)


@pytest.fixture
def scene(tmp_path):
    path = tmp_path / "free.yaml"
    path.write_text(FREE, encoding="utf-8")
    return path


def test_methods_lists_every_planner(dualarm):
    code, out, _ = dualarm("methods", "--json")
    assert code == 0
    listed = {one["name"]: one for one in json.loads(out)}
    assert {*BASELINES, *METHODS} == set(listed)
    assert "evaluations" in listed["rrt-connect"]["settings"]["properties"]


def test_plan_by_a_baseline_and_time_it(dualarm, scene, tmp_path):
    """Planned, timed, and read back: certified free at each stage."""
    out = tmp_path / "out"
    code, text, _ = dualarm("plan", scene, "--method", "mutual-avoidance-qp", "--out", out)
    assert code == 0
    assert "outcome: arrived, certified free" in text
    paths = [out / "free_left.csv", out / "free_right.csv"]
    code, text, _ = dualarm("time", scene, *paths, "--speed", "0.5", "--out", out, "--json")
    assert code == 0
    told = json.loads(text)
    assert told["usable"] is True
    assert told["duration_s"] > 0.3
    assert {file.rpartition(".")[2] for file in told["files"]} == {"csv", "json", "yaml", "html"}
    assert len(pd.read_csv(out / "free_timed.csv")) == told["samples"]
    assert len(yaml.safe_load((out / "free_timed.yaml").read_text())["points"]) == told["samples"]
    assert dualarm("check", scene, out / "free_timed.csv")[0] == 0


def test_path_that_does_not_begin_at_the_start_is_not_usable(dualarm, scene, tmp_path):
    """It ends at the goal, so that only its first row is wrong."""
    path = tmp_path / "path.csv"
    rows = {f"{arm}.q{j + 1}": [0.0, 0.0] for arm in ("left", "right") for j in range(6)}
    rows["left.q1"], rows["right.q1"] = [1.2, 1.7453], [1.0472, 1.7453]
    pd.DataFrame(rows).to_csv(path, index=False)
    code, out, _ = dualarm("check", scene, path)
    assert code == 3
    assert "left: 0.1528 (rad, or m if it slides) from its start, at its goal" in out
    assert "right: at its start, at its goal" in out
    assert "outcome: not from the start\n" in out
    code, out, _ = dualarm("time", scene, path, "--out", tmp_path / "out")
    assert (code, "does not begin at the start" in out) == (3, True)
    assert (tmp_path / "out" / "free_timed.csv").read_text().startswith("# DO NOT RUN: not from")


def test_time_of_a_motion_in_contact_says_so(dualarm, tmp_path):
    """Straight through each other: exit code 3, files marked."""
    turn = 'start: ["60 deg", "60 deg", -0.5, 0, 0, 0], goal: ["-60 deg", "60 deg", -0.5, 0, 0, 0]'
    back = 'start: ["-60 deg", "60 deg", -0.5, 0, 0, 0], goal: ["60 deg", "60 deg", -0.5, 0, 0, 0]'
    scene = tmp_path / "cross.yaml"
    scene.write_text(
        f"arms:\n  left: {{robot: irb120, xyz: [-0.4, 0, 0], {turn}}}\n"
        f"  right: {{robot: irb120, xyz: [0.4, 0, 0], rpy: [0, 0, pi], {back}}}\n"
    )
    rows = {f"left.q{j + 1}": v for j, v in enumerate([[1.0, -1.0], [1.0, 1.0], [-0.5, -0.5]])}
    rows |= {f"right.q{j + 1}": v for j, v in enumerate([[-1.0, 1.0], [1.0, 1.0], [-0.5, -0.5]])}
    rows |= {f"{arm}.q{j}": [0.0, 0.0] for arm in ("left", "right") for j in (4, 5, 6)}
    path = tmp_path / "path.csv"
    pd.DataFrame(rows).to_csv(path, index=False)
    code, text, _ = dualarm("time", scene, path, "--out", tmp_path / "out")
    assert code == 3
    assert "COLLISION" in text
    for ending in ("csv", "yaml"):
        assert (tmp_path / "out" / f"cross_timed.{ending}").read_text().startswith("# DO NOT RUN")


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (("--speed", "2"), "speed"),
        (("--acceleration", "0"), "acceleration"),
        (("--rate", "-1"), "rate"),
        (("--rate", "1e9"), "samples"),
    ],
)
def test_wrong_limits_end_in_one_line(dualarm, scene, tmp_path, arguments, told):
    path = tmp_path / "path.csv"
    rows = {f"{arm}.q{j + 1}": [0.1, 0.2] for arm in ("left", "right") for j in range(6)}
    pd.DataFrame(rows).to_csv(path, index=False)
    out = tmp_path / "out"
    code, _, error = dualarm("time", scene, path, *arguments, "--out", out)
    assert code == 2
    assert told in error
    assert error.count("\n") == 1
    assert not out.exists()


def test_arena_judges_chosen_planners_and_stores_nothing(dualarm):
    before = ARENA.table_path.exists() and ARENA.table_path.stat().st_mtime
    code, out, _ = dualarm(
        "arena", "--method", "attraction-only", "--method", "mutual-avoidance-qp",
        "--kind", "random", "--most", 1, "--json",
    )  # fmt: skip
    assert code == 0
    rows = {one["method"]: one for one in json.loads(out)}
    assert set(rows) == {"attraction-only", "mutual-avoidance-qp"}
    for row in rows.values():
        outcomes = {str(one) for one in Outcome} & set(row)
        assert row["tasks"] == 1 == sum(row[one] for one in outcomes)
        assert row["share"] == row[str(Outcome.SUCCESS)]
    assert rows["mutual-avoidance-qp"][str(Outcome.COLLIDES)] == 0  # it yields rather than touch
    assert (ARENA.table_path.exists() and ARENA.table_path.stat().st_mtime) == before


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (("--method", "no-such"), "no-such"),
        (("--kind", "sea"), "sea"),
        (("--most", "3"), "--most"),
        (("--method", "rrt-connect", "--jobs", "2"), "--jobs"),
    ],
)
def test_wrong_options_of_the_arena_end_in_one_line(dualarm, arguments, told):
    code, _, error = dualarm("arena", *arguments)
    assert code == 2
    assert told in error
    assert error.count("\n") == 1


def test_the_arena_is_a_stored_study_among_the_others(dualarm):
    code, out, _ = dualarm("study", "--json")
    assert code == 0
    assert {one["name"]: one["title"] for one in json.loads(out)}["arena"] == ARENA.title


def test_all_planners_are_compared_also_where_bodies_may_touch(dualarm, monkeypatch, tmp_path):
    """Starts in contact are refused, unless that is allowed; then every motion is told as it is."""
    chosen = {name: METHODS[name] for name in ("attraction-only", "apf-improved")}
    monkeypatch.setattr(plan_report, "METHODS", chosen)
    ball = "obstacles: {ball: {kind: sphere, center: [-0.4, 0, 0.5], radius: 0.3}}\n"
    scene = tmp_path / "touching.yaml"
    scene.write_text(FREE + ball, encoding="utf-8")
    code, _, error = dualarm("plan", scene, "--method", "all")
    assert code == 2
    assert "ball" in error
    code, out, _ = dualarm("plan", scene, "--method", "all", "--allow-collision", "--json")
    assert code == 3
    rows = {one["method"]: one for one in json.loads(out)}
    assert set(rows) == set(chosen)
    assert {one["outcome"] for one in rows.values()} <= {"", "COLLISION"}


def test_time_tells_when_in_seconds(dualarm, scene, tmp_path):
    path = tmp_path / "path.csv"
    rows = {f"{arm}.q{j + 1}": [0.1, 0.2] for arm in ("left", "right") for j in range(6)}
    pd.DataFrame(rows).to_csv(path, index=False)
    _, out, _ = dualarm("time", scene, path, "--out", tmp_path / "out")
    assert re.search(r"at \d\.\d{3} s$", out, re.MULTILINE)
    assert "step" not in out
