"""The compiled loop against the readable one: the same rows to 1e-11, whatever the settings."""

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given
from hypothesis import settings as hypothesis_settings
from hypothesis import strategies as st
from window_scene import (
    FIXED,
    GOAL,
    IMPROVED,
    MASTER,
    MASTER_GOAL,
    MASTER_START,
    SEARCH,
    SLAVE,
    START,
    TRADITIONAL,
    around,
    virtual,
    window,
)

from dualarm_repro.arms import load_arm
from dualarm_repro.planning import Trap, control_points, obstacles_of, plan_apf, plan_apf_compiled
from dualarm_repro.planning.descent.compiled import rules_of
from dualarm_repro.planning.descent.problem import problem
from dualarm_repro.planning.descent.update_kernels import move
from dualarm_repro.planning.descent.updates import next_configuration
from dualarm_repro.planning.field.field_kernels import evaluate, field_of, gradient, workspace
from dualarm_repro.scene import (
    Capsule,
    HalfSpace,
    JointPath,
    MovingShape,
    PlacedArm,
    PosePath,
    Scene,
    Sphere,
)

TOLERANCE = 1e-11  # forces grow with the cube of the nearness, and so do their last digits
SHORT = IMPROVED.termination.changed(step_limit=40)
STALL = IMPROVED.termination.changed(trap=Trap(rule="potential_stall", steps=10, threshold=1e-6))
CASES = {
    "improved": IMPROVED,
    "nearest bar": IMPROVED.changed(repulsion=IMPROVED.repulsion.changed(combination="nearest")),
    "links": IMPROVED.changed(control_points="five_links"),
    "capsules": IMPROVED.changed(control_points="capsules"),
    "weights": IMPROVED.changed(control_points=(4, 7), weights=(1.0, 0.5)),
    "attraction only": IMPROVED.changed(repulsion=None),
    "trapped": TRADITIONAL,
    "virtual point in a trap": TRADITIONAL.changed(virtual_point=IMPROVED.virtual_point),
    "virtual point replaces": TRADITIONAL.changed(
        virtual_point=virtual(switching="replaces_goal").virtual_point
    ),
    "virtual joints from the start": virtual(switching="from_start", joints=(0.2,) * 6),
    "virtual point always": virtual(switching="always").changed(termination=SHORT),
    "stall": TRADITIONAL.changed(
        termination=STALL.changed(joint_tolerance=None, position_tolerance=0.02)
    ),
    "fixed length": IMPROVED.changed(update=FIXED),
    "neighbour search": IMPROVED.changed(update=SEARCH),
    "neighbour search, trapped": TRADITIONAL.changed(update=SEARCH),
    "limits": IMPROVED.changed(enforce_limits=True),
}


def moving_master():
    """The window and the points of the master on its way."""
    path = JointPath(np.linspace(MASTER_START, MASTER_GOAL, 90))
    return around().with_arm(MASTER, control_points(MASTER.arm, "frames_2_6", radius=0.05), path)


def crowded():
    """Shapes of every sort, one of them moving, around the slave."""
    lift = PosePath([pin.SE3.Identity(), pin.SE3(np.eye(3), np.array([0.0, 0.3, 0.2]))], [0, 30])
    shapes = {
        "window": window((1.0, 1.2)),
        "ball": Sphere((-0.6, 1.6, 0.2), 0.2),
        "bar": Capsule((0.9, -0.4, 0.2), (0.9, -0.4, 1.2), 0.1),
        "floor": HalfSpace((0.0, 0.05, 1.0), -0.6),
    }
    drone = {"drone": MovingShape(Sphere((0.9, 0.9, 0.4), 0.15), lift)}
    return obstacles_of(Scene([SLAVE], shapes, drone))


def assert_same(readable, fast):
    assert (fast.reason, fast.steps) == (readable.reason, readable.steps)
    for name in ("path", "attractive", "repulsive", "virtual", "clearance"):
        mine, other = getattr(fast, name), getattr(readable, name)
        assert np.abs(mine - other)[np.isfinite(other)].max(initial=0.0) <= TOLERANCE * (
            1.0 if name in ("path", "clearance") else 1.0 + np.abs(other).max()
        ), name
    assert np.array_equal(fast.active, readable.active)
    for name in ("activations", "arrivals", "rescued", "outside_limits"):
        assert getattr(fast, name) == getattr(readable, name), name


@pytest.mark.parametrize("name", CASES)
@pytest.mark.parametrize("obstacles", [around, moving_master])
def test_same_plan(name, obstacles):
    settings = CASES[name]
    if settings.enforce_limits:
        problems = (MASTER, np.array([0.1, -0.5, 0.1, 0.0, 0.0, 0.0]), MASTER_GOAL, around())
    else:
        problems = (SLAVE, START, GOAL, obstacles())
    assert_same(plan_apf(*problems, settings), plan_apf_compiled(*problems, settings))


@pytest.mark.parametrize("settings", [IMPROVED, CASES["nearest bar"], CASES["links"]])
def test_same_plan_among_shapes_of_every_sort(settings):
    brief = settings.changed(termination=settings.termination.changed(step_limit=250))
    problems = (SLAVE, START, GOAL, crowded(), brief)
    plan = plan_apf_compiled(*problems)
    assert plan.repulsive.any()
    assert_same(plan_apf(*problems), plan)


def test_same_plan_for_another_arm_and_seven_joints():
    base = pin.SE3(pin.rpy.rpyToMatrix(0, 0, np.pi / 2), np.array([0.3, 0.0, 0.0]))
    placed = PlacedArm("arm", load_arm("panda"), base)
    start = np.array([0.0, -0.5, 0.0, -2.0, 0.0, 1.6, 0.5])
    goal = start + np.array([0.9, 0.2, -0.3, 0.4, 0.2, 0.3, -0.4])
    middle = placed.placement.act(placed.arm.positions(0.5 * (start + goal)))
    ball = obstacles_of(
        Scene([placed], {"ball": Sphere(middle + np.array([0.0, 0.0, -0.2]), 0.08)})
    )
    settings = IMPROVED.changed(
        control_points=(3, 5, 7, 8),
        virtual_point=None,
        repulsion=IMPROVED.repulsion.changed(gain=0.01, influence=0.2),
    )
    plan = plan_apf_compiled(placed, start, goal, ball, settings)
    assert plan.repulsive.any()
    assert_same(plan_apf(placed, start, goal, ball, settings), plan)


@given(st.lists(st.floats(-1.2, 1.2), min_size=6, max_size=6).map(np.array), st.integers(0, 120))
@hypothesis_settings(max_examples=40)
def test_same_terms_gradient_and_step_anywhere(shift, step):
    """Also inside obstacles, where no plan may start."""
    made = problem(SLAVE, START, GOAL, moving_master(), virtual(joints=(0.3,) * 6))
    q, field, rules = START + shift, field_of(made), rules_of(made)
    work = workspace(field)
    terms = evaluate(field, q, step, work)
    scale = 1.0 + made.repulsion.value(q, step)
    assert terms.attractive == pytest.approx(made.attraction.value(q), rel=1e-12)
    assert terms.virtual == pytest.approx(made.virtual.value(q), rel=1e-12)
    assert work.repulsive == pytest.approx(made.repulsion.terms(q, step), rel=1e-9, abs=1e-12)
    gradient(field, q, step, (True, True), work)
    expected = made.field.gradient(q, step) + made.virtual.gradient(q)
    assert work.gradient == pytest.approx(expected, rel=1e-8, abs=1e-9 * scale)
    out = np.empty(6)
    terms = evaluate(field, q, step, work)
    here = terms.attractive + terms.repulsive
    move(field, rules, q, step, (True, False), here, work, out)
    limits = (np.full(6, -np.inf), np.full(6, np.inf))
    expected = next_configuration(made.field, q, step, made.settings.update, limits)
    assert out == pytest.approx(expected, abs=1e-9)
