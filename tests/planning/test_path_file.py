"""Somebody else's paths: columns, names, indices, and what is wrong with them."""

import numpy as np
import pytest
from own_scenes import both, written

from dualarm_repro.errors import DataFileError
from dualarm_repro.planning import load_tasks
from dualarm_repro.planning.checks.arrival import arrives
from dualarm_repro.planning.tasks.path_file import read_paths

ENDS = "start: [0, 0, 0, 0, 0, 0], goal: [0.5, 0, 0, 0, 0, 0]"
HEAD = "q1,q2,q3,q4,q5,q6"


@pytest.fixture
def scene(tmp_path):
    return load_tasks(written(tmp_path, both(ENDS, ENDS))).scene


def table(folder, name, *lines):
    return written(folder, "\n".join(lines) + "\n", name)


def test_the_file_of_one_arm_and_its_index(scene, tmp_path):
    path = table(
        tmp_path, "t_left.csv", "# a remark", f"step,{HEAD},x", "0,0,0,0,0,0,0,9", "4,1,0,0,0,0,0,9"
    )
    found = read_paths(scene, [path])
    assert list(found) == ["left"]
    assert found["left"].index == pytest.approx([0, 4])
    assert found["left"].at(np.array([2.0]))[0] == pytest.approx([0.5, 0, 0, 0, 0, 0])


def test_one_file_with_both_arms(scene, tmp_path):
    names = [f"{arm}.q{k}" for arm in ("left", "right") for k in range(1, 7)]
    path = table(tmp_path, "all.csv", "time, " + ", ".join(names), "0.5" + ",0.1" * 12)
    found = read_paths(scene, [path])
    assert found["right"].configurations == pytest.approx(np.full((1, 6), 0.1))
    assert found["right"].index == pytest.approx([0.5])


BAD = {
    "no joint": (("left.csv", "a,b", "1,2"), r"column = 'q1'"),
    "whose": (("path.csv", HEAD, "0,0,0,0,0,0"), r"columns ARM\.q1 .* of one of left, right"),
    "too many": (("left.csv", HEAD + ",q7", "0,0,0,0,0,0,0"), r"column = 'q7': expected 6 joints"),
    "nan": (("left.csv", HEAD, "0,0,nan,0,0,0"), r"q3, row 1"),
    "text": (("left.csv", HEAD, "0,0,0,0,0,0", "0,0,0,x,0,0"), r"q4, row 2 = 'x'"),
    "infinite": (("left.csv", HEAD, "0,0,0,0,0,inf"), r"q6, row 1"),
    "index falls": (("left.csv", "step," + HEAD, "1,0,0,0,0,0,0", "0,0,0,0,0,0,0"), "increasing"),
    "empty": (("left.csv", HEAD), r"rows = 0"),
    "huge": (
        ("left.csv", HEAD, "0,0,0,0,0,0", "0,1e5,0,0,0,0"),
        r"q2, row 2 = 100000.0: expected a",
    ),
    "degrees": (("left.csv", HEAD, "0,0,0,0,90,0"), r"q5, row 1 = 90"),
    "too far": (
        ("left.csv", HEAD, *["2,0,0,0,0,0", "-2,0,0,0,0,0"] * 2000),
        r"way of left = '1.6e\+04 rad'",
    ),
    "nothing": (("left.csv", ""), r"content = "),
}


@pytest.mark.parametrize(("lines", "message"), BAD.values(), ids=BAD)
def test_what_is_wrong_is_named(scene, tmp_path, lines, message):
    with pytest.raises(DataFileError, match=message):
        read_paths(scene, [table(tmp_path, *lines)])


def test_missing_and_double_files(scene, tmp_path):
    with pytest.raises(DataFileError, match="a readable CSV file"):
        read_paths(scene, [tmp_path / "left.csv"])
    path = table(tmp_path, "left.csv", HEAD, "0,0,0,0,0,0")
    with pytest.raises(DataFileError, match="one path of each arm"):
        read_paths(scene, [path, path])


def test_arrival_is_what_the_file_asks_for(tmp_path):
    """Joints, a position that another posture meets as well, a pose with a free axis."""
    given = load_tasks(written(tmp_path, both(ENDS, ENDS)))
    left, task = given.scene.arms[0], given.tasks["left"]
    assert arrives(left, task, task.goal + 0.009)
    assert not arrives(left, task, task.goal + 0.011)
    ask = "start: [0, 0, 0, 0, 0.5, 0], goal: {position: [0.05, 0.1, 0.55]%s}"
    for more, turned in (
        ("", True),
        (", rpy: [0, 1.5, 0], free: z", True),
        (", rpy: [0, 1.5, 0]", False),
    ):
        given = load_tasks(written(tmp_path, both(ask % more, ENDS)))
        left, task = given.scene.arms[0], given.tasks["left"]
        turn = np.array([0, 0, 0, 0, 0, 0.5])
        assert arrives(left, task, task.goal)
        assert arrives(left, task, task.goal + turn) is turned
        assert not arrives(left, task, task.goal + np.array([0.1, 0, 0, 0, 0, 0]))
