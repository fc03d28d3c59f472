"""What a plan tells about itself."""

import numpy as np
import pytest
from window_scene import GOAL, IMPROVED, SLAVE, START, TRADITIONAL, around

from dualarm_repro.planning import plan_apf_compiled
from dualarm_repro.planning.field.control_points import end_effector

PLAN = plan_apf_compiled(SLAVE, START, GOAL, around(), IMPROVED)


def test_rows_belong_together():
    rows = PLAN.steps + 1
    for name in (
        "path",
        "attractive",
        "repulsive",
        "virtual",
        "clearance",
        "active",
        "total",
        "tcp",
    ):
        assert len(getattr(PLAN, name)) == rows, name
    assert PLAN.repulsive.shape == PLAN.clearance.shape == (rows, len(PLAN.point_names))
    assert PLAN.obstacle_names == tuple(f"window/{k}" for k in range(4))
    assert np.array_equal(PLAN.path[0], START)


def test_lengths():
    assert np.array_equal(PLAN.tcp, end_effector(SLAVE, PLAN.path))
    assert PLAN.length >= np.linalg.norm(PLAN.path[-1] - START) - 1e-12
    assert PLAN.tcp_length >= np.linalg.norm(PLAN.tcp[-1] - PLAN.tcp[0])
    assert PLAN.length <= 0.02 * PLAN.steps + 1e-9


def test_the_potential_falls_at_every_step_of_a_descent_among_standing_obstacles():
    assert (np.diff(PLAN.total) < 0).all()
    trapped = plan_apf_compiled(SLAVE, START, GOAL, around(), TRADITIONAL)
    assert (np.diff(trapped.total) <= 0).all()


def test_table_of_a_plan():
    frame = PLAN.to_frame()
    assert frame.index.name == "step"
    assert len(frame) == PLAN.steps + 1
    assert frame[[f"q{j}" for j in range(1, 7)]].to_numpy() == pytest.approx(PLAN.path)
    assert frame["clearance frame_6"].min() == PLAN.clearance[:, -1].min()
    assert frame[[f"repulsive {n}" for n in PLAN.point_names]].to_numpy() == pytest.approx(
        PLAN.repulsive
    )


def test_replay():
    path = PLAN.joint_path()
    assert path.at(np.array([0.0, 3.0, 1e9])) == pytest.approx(PLAN.path[[0, 3, -1]])


def test_a_plan_cannot_be_changed():
    with pytest.raises(AttributeError):
        PLAN.reason = "reached"
