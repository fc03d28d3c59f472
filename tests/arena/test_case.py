"""A case of the arena: what is wrong with its ends, and what a method is given."""

from dataclasses import replace

import numpy as np
import pinocchio as pin
import pytest

from dualarm_repro.arena.case import Case
from dualarm_repro.arms import load_arm
from dualarm_repro.planning import METHODS
from dualarm_repro.scene import PlacedArm, Scene, Sphere

START, GOAL = np.zeros(6), np.array([0.6, 0.2, -0.1, 0.0, 0.3, 0.0])


def placed(name, y):
    return PlacedArm(name, load_arm("irb120"), pin.SE3(np.eye(3), np.array([0.0, y, 0.0])))


@pytest.fixture(scope="module")
def case():
    scene = Scene([placed("left", 0.6), placed("right", -0.6)], {"ball": Sphere([0, 0, 3.0], 0.1)})
    starts = {"left": START, "right": 0.5 * GOAL}
    return Case("two arms", scene, starts, {"left": GOAL, "right": START})


def test_ends_are_those_of_all_arms_one_after_the_other(case):
    np.testing.assert_array_equal(
        case.ends, [np.concatenate([START, 0.5 * GOAL]), np.concatenate([GOAL, START])]
    )
    assert case.fault == ""


@pytest.mark.parametrize("end", ["starts", "goals"])
def test_a_body_in_the_way_of_either_end_is_a_fault(case, end):
    q = getattr(case, end)["left"]
    tip = case.scene.arms[0].placement.act(load_arm("irb120").fk(q)[:3, 3])
    blocked = replace(case, scene=Scene(list(case.scene.arms), {"ball": Sphere(tip, 0.05)}))
    assert blocked.fault == "contact"


@pytest.mark.parametrize("end", ["starts", "goals"])
@pytest.mark.parametrize(("side", "fault"), [(1e-6, "limits"), (0.0, "")])
def test_a_joint_beyond_its_limit_is_a_fault(case, end, side, fault):
    q = START.copy()
    q[0] = load_arm("irb120").upper[0] + side
    turned = replace(case, **{end: {**getattr(case, end), "right": q}})
    assert turned.fault == fault


def test_an_arm_alone_touches_nothing():
    arm = Scene([placed("left", 0.0)], self_collision=False)
    assert Case("alone", arm, {"left": START}, {"left": GOAL}).fault == ""


@pytest.mark.parametrize("name", ["apf-bidirectional", "attraction-only", "rrt-connect"])
def test_a_method_is_given_its_own_defaults(case, name):
    from dualarm_repro.baselines.registry import enlist

    method = enlist()[name]
    given = case.tasks(method)
    assert list(given.tasks) == ["left", "right"]
    for arm, task in given.tasks.items():
        np.testing.assert_array_equal(task.start, case.starts[arm])
        np.testing.assert_array_equal(task.goal, case.goals[arm])
        assert given.settings[arm] == method.default(load_arm("irb120"))
    assert given.scene is case.scene
    assert str(given.path) == "two arms"
    assert name in METHODS or name == "rrt-connect"
