"""A problem is checked before it is planned: each wrong part is named."""

import numpy as np
import pytest
from window_scene import GOAL, IMPROVED, MASTER, SLAVE, START, around, virtual

from dualarm_repro.errors import ConfigurationError, InputError
from dualarm_repro.planning import plan_apf, plan_apf_compiled, plan_batch
from dualarm_repro.planning.descent.problem import problem
from dualarm_repro.scene import Sphere

PLANNERS = [plan_apf, plan_apf_compiled, plan_batch]


@pytest.mark.parametrize("planner", PLANNERS)
@pytest.mark.parametrize(
    ("goal", "expected"),
    [
        (np.full(6, np.nan), "arm slave: goal = nan: expected 6 finite numbers"),
        (np.zeros(5), r"arm slave: goal = \(5,\): expected 6 finite numbers"),
        (np.zeros((2, 6)), r"arm slave: goal = \(2, 6\): expected 6 finite numbers"),
        ("end", "arm slave: goal = 'end': expected 6 finite numbers"),
    ],
)
def test_bad_goal(planner, goal, expected):
    with pytest.raises(ConfigurationError, match=expected):
        planner(SLAVE, START, goal, around(), IMPROVED)


@pytest.mark.parametrize("planner", PLANNERS)
def test_a_start_inside_an_obstacle_names_the_point_and_the_shape(planner):
    inside = around(ball=Sphere((0.7, 0.35, 0.5), 0.2), wall=Sphere((5.0, 0.0, 0.0), 0.1))
    expected = "frame_6 outside ball, not at a distance of -0.15 m"
    with pytest.raises(InputError, match=expected) as caught:
        planner(SLAVE, START, GOAL, inside, IMPROVED)
    assert (caught.value.source, caught.value.field) == ("arm slave", "start")


def test_limits_are_only_enforced_on_demand():
    problem(MASTER, np.zeros(6), GOAL, around(), IMPROVED)
    with pytest.raises(ConfigurationError, match=r"start = .*expected a value within the limits"):
        problem(MASTER, np.zeros(6), GOAL, around(), IMPROVED.changed(enforce_limits=True))


def test_joints_of_the_virtual_point_must_fit_the_arm():
    with pytest.raises(ConfigurationError, match=r"virtual_point.joints = \(2,\)"):
        problem(SLAVE, START, GOAL, around(), virtual(joints=(0.0, 1.0)))


def test_potentials_of_the_settings():
    made = problem(SLAVE, START, GOAL, around(), virtual(joints=(0.1,) * 6, joint_weight=0.5))
    position, joints = made.attraction.parts
    assert (position.gain, joints.gain) == (3.0, 3.0)
    assert position.target == pytest.approx(made.goal_point)
    position, joints = made.virtual.parts
    assert (position.gain, joints.gain) == (2.0, 1.0)
    assert joints.target == pytest.approx(np.full(6, 0.1))
    ignored = problem(SLAVE, START, GOAL, around(), IMPROVED.changed(repulsion=None))
    assert ignored.repulsion.value(START) == 0.0
    assert ignored.virtual.parts[1].gain == 0.0
