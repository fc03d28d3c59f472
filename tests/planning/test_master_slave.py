"""Master first, then the slave around its motion: the same index, parked at the end."""

import numpy as np
import pytest
from window_scene import (
    GOAL,
    IMPROVED,
    MASTER,
    MASTER_GOAL,
    MASTER_START,
    SLAVE,
    START,
    around,
    scene,
)

from dualarm_repro.errors import InputError, UnknownNameError
from dualarm_repro.planning import (
    Task,
    at_tool_speed,
    control_points,
    plan_apf,
    plan_apf_compiled,
    plan_master_slave,
)
from dualarm_repro.planning.field.control_points import end_effector

TASKS = {"master": Task(MASTER_START, MASTER_GOAL, IMPROVED), "slave": Task(START, GOAL, IMPROVED)}
BOTH = plan_master_slave(scene(), TASKS)


def test_the_master_does_not_know_the_slave():
    alone = plan_apf_compiled(MASTER, MASTER_START, MASTER_GOAL, around(), IMPROVED)
    assert np.array_equal(BOTH.master.path, alone.path)
    assert list(BOTH.plans) == ["master", "slave"]


def test_the_slave_meets_the_points_of_the_master_at_the_same_step():
    points = control_points(MASTER.arm, "frames_2_6")
    obstacles = around().with_arm(MASTER, points, BOTH.master.joint_path())
    same = plan_apf_compiled(SLAVE, START, GOAL, obstacles, IMPROVED)
    assert np.array_equal(BOTH.slave.path, same.path)
    unaware = plan_apf_compiled(SLAVE, START, GOAL, around(), IMPROVED)
    assert not np.array_equal(BOTH.slave.path, unaware.path)


def tool_distance(both):
    """Distance of the two flanges over the index [m]."""
    arms = ((MASTER, both.paths["master"]), (SLAVE, both.paths["slave"]))
    master, slave = (end_effector(placed, path.at(both.index)) for placed, path in arms)
    return np.linalg.norm(master - slave, axis=1)


def test_distances_run_until_both_have_arrived():
    assert len(BOTH.index) == 1 + max(BOTH.master.steps, BOTH.slave.steps)
    tools = tool_distance(BOTH)
    assert tools.shape == BOTH.index.shape
    for step in (0, 40, len(tools) - 1):
        ends = [plan.tcp[min(step, plan.steps)] for plan in (BOTH.master, BOTH.slave)]
        assert tools[step] == pytest.approx(np.linalg.norm(ends[0] - ends[1]))
    links = BOTH.links(0.02)
    assert links.index[-1] == BOTH.index[-1]
    assert links.minimum < tools.min()


@pytest.mark.parametrize(
    ("choice", "radius", "names", "expected"),
    [
        ("joint_points", None, 5, 0.0),
        ("end_effector", 0.08, 1, 0.08),
        ((5, 7), 0.1, 2, 0.1),
    ],
)
def test_what_of_the_master_repels(choice, radius, names, expected):
    both = plan_master_slave(scene(), TASKS, master_points=choice, radius=radius)
    repelling = [name for name in both.slave.obstacle_names if name.startswith("master/")]
    assert len(repelling) == names
    gaps = tool_distance(both)[: both.slave.steps + 1] - expected
    if choice == "end_effector":
        assert (both.slave.clearance[:, -1] <= gaps + 1e-9).all()


def test_the_master_at_another_speed():
    tasks = {**TASKS, "master": Task(MASTER_START, MASTER_GOAL, IMPROVED, at_tool_speed(0.03))}
    both = plan_master_slave(scene(), tasks)
    index = both.paths["master"].index
    pieces = np.linalg.norm(np.diff(both.master.tcp, axis=0), axis=1)
    assert np.diff(index) == pytest.approx(pieces / 0.03)
    met = end_effector(MASTER, both.paths["master"].at(both.index))
    # Between two rows the joints are interpolated, so the flange cuts the chord a little unevenly.
    assert np.linalg.norm(np.diff(met, axis=0), axis=1).max() <= 0.03 * (1 + 2e-3)
    assert len(both.index) == 1 + int(np.ceil(index[-1]))


def test_any_planner_can_be_used():
    tasks = {"slave": TASKS["slave"]}
    slow, fast = (
        plan_master_slave(scene(), tasks, planner=p) for p in (plan_apf, plan_apf_compiled)
    )
    assert slow.slave.path == pytest.approx(fast.slave.path, abs=1e-12)
    assert slow.master is slow.slave


def test_bad_tasks():
    with pytest.raises(UnknownNameError, match="one of master, slave"):
        plan_master_slave(scene(), {"left": TASKS["slave"]})
    with pytest.raises(InputError, match="a task for one of master, slave"):
        plan_master_slave(scene(), {})
