"""What is planned does not depend on where the axes of the world lie."""

import numpy as np
import pinocchio as pin
import pytest
from window_scene import (
    CENTRE,
    GOAL,
    IMPROVED,
    MASTER,
    MASTER_GOAL,
    MASTER_START,
    SLAVE,
    START,
    TRADITIONAL,
    around,
    scene,
    virtual,
    window,
)

from dualarm_repro.arms import load_arm
from dualarm_repro.planning import Task, obstacles_of, plan_master_slave
from dualarm_repro.planning.checks.contact_check import contact_check
from dualarm_repro.planning.descent.cartesian_ik import plan_cartesian_ik
from dualarm_repro.planning.search.rrt_connect_compiled import plan_rrt_connect_compiled
from dualarm_repro.scene import PlacedArm, Scene, Sphere, certified_minimum, distances
from dualarm_repro.scene.edges import free_edges

MOTIONS = [
    pin.SE3(pin.rpy.rpyToMatrix(0.4, -1.1, 2.0), np.array([0.3, -2.0, 0.7])),
    pin.SE3(pin.rpy.rpyToMatrix(0.0, np.pi, 0.0), np.array([-1.0, 0.0, 3.0])),
]


def placed(arm, motion):
    return PlacedArm(arm.name, arm.arm, motion * arm.placement)


def window_at(motion):
    return {"window": tuple(bar.moved(motion) for bar in window())}


@pytest.mark.parametrize("motion", MOTIONS)
def test_master_and_slave_move_alike(motion):
    there = Scene([placed(MASTER, motion), placed(SLAVE, motion)], window_at(motion))
    seen = virtual(position=tuple(motion.act(np.array(CENTRE))))
    ends = {"master": (MASTER_START, MASTER_GOAL), "slave": (START, GOAL)}
    here = plan_master_slave(scene(), {name: Task(*two, IMPROVED) for name, two in ends.items()})
    found = plan_master_slave(there, {name: Task(*two, seen) for name, two in ends.items()})
    for name, plan in here.plans.items():
        np.testing.assert_allclose(found.plans[name].path, plan.path, atol=1e-8)
        moved = plan.tcp @ motion.rotation.T + motion.translation
        np.testing.assert_allclose(found.plans[name].tcp, moved, atol=1e-8)
        assert found.plans[name].reason is plan.reason


@pytest.mark.parametrize("motion", MOTIONS)
def test_a_flange_that_moves_as_a_point_takes_the_moved_way(motion):
    settings = TRADITIONAL.changed(control_points="frames_2_6")
    arm = placed(SLAVE, motion)
    here = plan_cartesian_ik(SLAVE, START, GOAL, around(), settings)
    bars = obstacles_of(Scene([arm], window_at(motion)))
    found = plan_cartesian_ik(arm, START, GOAL, bars, settings)
    assert found.reason is here.reason
    np.testing.assert_allclose(found.path, here.path, atol=1e-6)


def two_arms(motion):
    arm = load_arm("irb120")
    turned = pin.rpy.rpyToMatrix(0.0, 0.0, np.pi)
    bases = {
        "left": pin.SE3(np.eye(3), np.array([-0.4, 0.0, 0.0])),
        "right": pin.SE3(turned, np.array([0.4, 0.0, 0.0])),
    }
    arms = [PlacedArm(name, arm, motion * base) for name, base in bases.items()]
    return Scene(arms, {"ball": Sphere((0.0, 0.1, 0.6), 0.05).moved(motion)})


@pytest.fixture(scope="module")
def ends():
    """Two configurations of both arms that are free and whose straight line is not."""
    here, rng = two_arms(pin.SE3.Identity()), np.random.default_rng(1)
    lower, upper = here.limits
    while True:
        drawn = rng.uniform(0.6 * lower, 0.6 * upper, (2, here.nq))
        apart = distances(here, drawn).min() > 0.02
        if apart and not free_edges(here, drawn[:1], drawn[1:], 0.005)[0]:
            return drawn


@pytest.mark.parametrize("motion", MOTIONS)
def test_trees_of_one_seed_grow_alike_and_are_judged_alike(motion, ends):
    here, there = two_arms(pin.SE3.Identity()), two_arms(motion)
    plans = [
        plan_rrt_connect_compiled(cell, *ends, np.random.default_rng(3), 0.005)
        for cell in (here, there)
    ]
    assert len(plans[0].path) > 2
    np.testing.assert_allclose(plans[1].path, plans[0].path, atol=1e-9)
    assert plans[1].checks == plans[0].checks
    checks = [
        contact_check(cell, plan.path) for cell, plan in zip((here, there), plans, strict=True)
    ]
    assert checks[1].clearance == pytest.approx(checks[0].clearance, abs=1e-9)
    brackets = [certified_minimum(cell, plans[0].path, tolerance=1e-3) for cell in (here, there)]
    assert brackets[1].lower == pytest.approx(brackets[0].lower, abs=1e-9)
    assert brackets[1].upper == pytest.approx(brackets[0].upper, abs=1e-9)
