"""What a descent does: it arrives, it is trapped and says why, and the traps that fake a result."""

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given
from hypothesis import settings as hypothesis_settings
from hypothesis import strategies as st
from window_scene import (
    BY_POSITION,
    CENTRE,
    FIXED,
    GOAL,
    IMPROVED,
    MASTER,
    SLAVE,
    START,
    TRADITIONAL,
    around,
    virtual,
    window,
)

from dualarm_repro.arms import load_arm
from dualarm_repro.planning import (
    Attraction,
    Repulsion,
    StopReason,
    Termination,
    Trap,
    Update,
    obstacles_of,
    plan_apf,
    plan_apf_compiled,
)
from dualarm_repro.planning.descent.problem import problem
from dualarm_repro.planning.field.control_points import end_effector
from dualarm_repro.scene import MovingShape, PlacedArm, PosePath, Scene, Sphere

QUICK = Trap(rule="block_means", steps=20, threshold=1e-3)
joints = st.lists(st.floats(-1.5, 1.5), min_size=6, max_size=6).map(np.array)
NOTHING = obstacles_of(Scene([SLAVE]))


def test_the_improved_field_passes_the_window_and_the_traditional_one_is_trapped():
    arrived = plan_apf_compiled(SLAVE, START, GOAL, around(), IMPROVED)
    assert arrived.reached
    assert arrived.certificate is None
    assert np.abs(arrived.path[-1] - GOAL).max() <= 0.02
    assert arrived.clearance.min() > 0.2
    trapped = plan_apf_compiled(SLAVE, START, GOAL, around(), TRADITIONAL)
    assert trapped.reason is StopReason.TRAPPED
    assert np.linalg.norm(trapped.tcp[-1] - trapped.tcp[0]) > 0.1


def test_a_trap_carries_its_proof():
    plan = plan_apf_compiled(SLAVE, START, GOAL, around(), TRADITIONAL)
    proof = plan.certificate
    assert proof.gradient_norm < 1e-4
    assert proof.smallest_curvature > -1e-3
    assert set(proof.acting) == {"window/1", "window/3"}
    made = problem(SLAVE, START, GOAL, around(), TRADITIONAL)
    assert (proof.joint_error, proof.position_error) == pytest.approx(made.errors(plan.path[-1]))
    pulls = [np.linalg.norm(part.gradient(plan.path[-1])) for part in made.attraction.parts[:1]]
    assert min(pulls) > 1e4 * proof.gradient_norm


@given(joints, joints)
@hypothesis_settings(max_examples=25)
def test_the_joint_term_alone_always_leads_home(start, goal):
    settings = IMPROVED.changed(
        attraction=Attraction(gain=1.0, position_weight=0.0, joint_weight=2.0)
    )
    plan = plan_apf_compiled(SLAVE, start, goal, NOTHING, settings)
    assert plan.reached
    assert plan.length == pytest.approx(np.linalg.norm(plan.path[-1] - start))


def test_creases_of_the_nearest_distance_fake_a_trap():
    """A goal behind two bars: the descent on the nearest one halts on the crease between them with
    a large gradient, where the sum rests in a true minimum or passes."""
    arm = PlacedArm("arm", load_arm("es165d"))
    X = end_effector(arm, np.zeros(6))
    bars = {
        "window": (
            Sphere(X + np.array([0.0, -0.4, 0.25]), 0.1),
            Sphere(X + np.array([0.0, -0.4, -0.25]), 0.1),
        )
    }
    obstacles = obstacles_of(Scene([arm], bars))
    goal = np.array([-0.5, 0.0, 0.0, 0.0, 0.0, 0.0])
    base = TRADITIONAL.changed(attraction=Attraction(gain=30.0))
    ends = {}
    for combination in ("sum", "nearest"):
        settings = base.changed(
            repulsion=Repulsion(gain=1.0, influence=0.6, combination=combination),
            termination=base.termination.changed(trap=QUICK),
        )
        ends[combination] = plan_apf_compiled(arm, np.zeros(6), goal, obstacles, settings)
    crease = ends["nearest"]
    assert crease.reason is not StopReason.REACHED
    assert crease.certificate.gradient_norm > 0.1
    assert ends["sum"].reached or ends["sum"].certificate.gradient_norm < 1e-3


def test_a_goal_within_the_influence_of_an_obstacle_is_not_reached():
    """The arm rests beside its goal; a virtual point would only carry it through the tolerance."""
    goal_point = end_effector(SLAVE, GOAL)
    obstacles = around(ball=Sphere(goal_point + np.array([0.0, 0.0, -0.3]), 0.1))
    settings = IMPROVED.changed(virtual_point=None)
    plan = plan_apf_compiled(SLAVE, START, GOAL, obstacles, settings)
    assert plan.reason is StopReason.NEAR_OBSTACLE
    assert 0.0 < plan.certificate.position_error < 0.1
    assert plan.certificate.acting == ("ball",)
    assert plan.certificate.smallest_curvature > 0
    far = plan_apf_compiled(
        SLAVE,
        START,
        GOAL,
        obstacles,
        settings.changed(termination=settings.termination.changed(near_goal=0.5)),
    )
    assert far.reason is StopReason.TRAPPED


def test_a_trap_is_a_trap_however_near_the_goal_if_nothing_repels_there():
    end = TRADITIONAL.termination.changed(near_goal=1e6)
    plan = plan_apf_compiled(SLAVE, START, GOAL, around(), TRADITIONAL.changed(termination=end))
    assert plan.reason is StopReason.TRAPPED


def test_a_virtual_point_that_always_acts_moves_the_rest_of_the_tool():
    """3 (X - X_g) + 2 (X - X_v) = 0 at X = (3 X_g + 2 X_v)/5."""
    settings = BY_POSITION.changed(
        repulsion=None, virtual_point=virtual(switching="always").virtual_point
    )
    plan = plan_apf_compiled(SLAVE, START, GOAL, NOTHING, settings)
    assert plan.reason is StopReason.TRAPPED
    expected = (3 * end_effector(SLAVE, GOAL) + 2 * np.array(CENTRE)) / 5
    assert np.abs(plan.tcp[-1] - expected).max() < 1e-3
    assert plan.active.all()
    assert (plan.activations, plan.rescued) == (1, False)


@pytest.mark.parametrize("switching", ["on_when_stuck", "replaces_goal"])
def test_a_virtual_point_in_a_trap(switching):
    """Switched on at the trap, off near the point or in time, and counted if it helped."""
    point = virtual(switching=switching, max_activations=3).virtual_point
    settings = TRADITIONAL.changed(virtual_point=point)
    plan = plan_apf_compiled(SLAVE, START, GOAL, around(), settings)
    without = plan_apf_compiled(SLAVE, START, GOAL, around(), TRADITIONAL)
    on, off = (np.flatnonzero(np.diff(plan.active.astype(int)) == sign)[0] + 1 for sign in (1, -1))
    assert on == without.steps
    assert np.array_equal(plan.path[: on + 1], without.path)
    distance = np.linalg.norm(plan.tcp[off] - np.array(CENTRE))
    assert distance <= 0.1 if plan.arrivals else off - on == 400
    assert plan.arrivals == (1 if switching == "replaces_goal" else 0)
    assert (plan.activations, plan.rescued, plan.reached) == (1, True, True)
    assert plan.virtual[plan.active].min() > 0
    assert not plan.virtual[~plan.active].any()


def test_a_virtual_point_from_the_start_is_passed_and_left():
    settings = virtual(switching="from_start", release_distance=0.3)
    plan = plan_apf_compiled(SLAVE, START, GOAL, around(), settings)
    assert plan.reached
    assert plan.active[0]
    assert not plan.active[-1]
    assert (plan.activations, plan.arrivals, plan.rescued) == (1, 1, False)
    assert np.linalg.norm(plan.tcp - np.array(CENTRE), axis=1).min() <= 0.3


def test_being_at_the_goal_does_not_count_while_a_virtual_point_is_yet_to_be_left():
    """Else the pull of the point could carry a trapped arm through the tolerance."""
    without = plan_apf_compiled(SLAVE, GOAL, GOAL, around(), IMPROVED)
    assert without.reached
    assert without.steps == 0
    settings = virtual(switching="from_start", max_steps=60)
    plan = plan_apf_compiled(SLAVE, GOAL, GOAL, around(), settings)
    assert plan.reached
    assert plan.steps > 60
    away = np.abs(plan.path - GOAL).max(axis=1)
    assert away[0] == 0.0
    assert away.max() > 0.02
    assert away[-1] <= 0.02


def test_a_step_limit_is_kept_and_named():
    settings = IMPROVED.changed(termination=IMPROVED.termination.changed(step_limit=7))
    for planner in (plan_apf, plan_apf_compiled):
        plan = planner(SLAVE, START, GOAL, around(), settings)
        assert (plan.steps, plan.reason) == (7, StopReason.STEP_LIMIT)
        assert plan.certificate.gradient_norm > 1.0


def test_a_trap_is_not_called_while_obstacles_move():
    """The window is lifted away at step 400; the impatient arm gives up before."""
    away = pin.SE3(np.eye(3), np.array([0.0, 0.0, 9.0]))
    path = PosePath([pin.SE3.Identity(), pin.SE3.Identity(), away], [0, 390, 400])
    bars = {f"bar{k}": MovingShape(bar, path) for k, bar in enumerate(window())}
    obstacles = obstacles_of(Scene([SLAVE], {}, bars))
    reasons = []
    for patient in (False, True):
        trap = TRADITIONAL.termination.trap.changed(after_obstacles_rest=patient)
        settings = TRADITIONAL.changed(termination=TRADITIONAL.termination.changed(trap=trap))
        reasons.append(plan_apf_compiled(SLAVE, START, GOAL, obstacles, settings).reason)
    assert reasons == [StopReason.TRAPPED, StopReason.REACHED]


def test_potential_stall_finds_the_same_trap():
    stall = Termination(
        position_tolerance=0.02,
        step_limit=3000,
        trap=Trap(rule="potential_stall", steps=10, threshold=1e-6),
    )
    plan = plan_apf_compiled(SLAVE, START, GOAL, around(), TRADITIONAL.changed(termination=stall))
    other = plan_apf_compiled(SLAVE, START, GOAL, around(), TRADITIONAL)
    assert plan.reason is StopReason.TRAPPED
    assert np.linalg.norm(plan.tcp[-1] - other.tcp[-1]) < 0.01


def test_goal_outside_the_limits_is_reported_and_the_path_kept_inside_on_demand():
    start = np.array([0.0, -1.2, 0.0, 0.0, 0.0, 0.0])
    beyond = np.array([0.0, 0.3, 0.0, 0.0, 0.0, 0.0])
    plan = plan_apf_compiled(MASTER, start, beyond, NOTHING, IMPROVED)
    assert plan.reached
    assert plan.outside_limits == ("goal", "path")
    inside = np.array([0.0, MASTER.arm.upper[1] - 0.05, 0.0, 0.0, 0.0, 0.0])
    enforced = plan_apf_compiled(
        MASTER, start, inside, NOTHING, IMPROVED.changed(enforce_limits=True, update=FIXED)
    )
    assert enforced.reached
    assert enforced.outside_limits == ()


@pytest.mark.parametrize("update", [IMPROVED.update, FIXED])
def test_mirrored_problem_gives_the_mirrored_path(update):
    mirror = np.array([1.0, -1.0, 1.0])
    start, goal = (
        np.array([0.0, -0.3, 0.2, 0.1, 0.5, 0.0]),
        np.array([1.2, -0.6, 0.1, 0.3, 0.4, 0.2]),
    )
    ball = MASTER.arm.positions(0.5 * (start + goal)) + np.array([0.0, 0.0, -0.3])
    paths = []
    for arm, sign, centre in ((MASTER.arm, 1.0, ball), (SLAVE.arm, -1.0, ball * mirror)):
        placed = PlacedArm("arm", arm)
        around_it = obstacles_of(Scene([placed], {"ball": Sphere(centre, 0.15)}))
        settings = IMPROVED.changed(virtual_point=None, update=update)
        plan = plan_apf_compiled(placed, sign * start, sign * goal, around_it, settings)
        assert plan.repulsive.any()
        paths.append(sign * plan.path)
    assert paths[0] == pytest.approx(paths[1], abs=1e-9)


@given(
    st.lists(st.floats(-3, 3), min_size=3, max_size=3),
    st.lists(st.floats(-3, 3), min_size=3, max_size=3),
)
@hypothesis_settings(max_examples=15)
def test_moving_everything_moves_the_plan(angles, shift):
    motion = pin.SE3(pin.rpy.rpyToMatrix(*angles), np.array(shift))
    moved = PlacedArm("slave", SLAVE.arm, motion * SLAVE.placement)
    bars = tuple(bar.moved(motion) for bar in window())
    there = plan_apf_compiled(
        moved,
        START,
        GOAL,
        obstacles_of(Scene([moved], {"window": bars})),
        virtual(position=tuple(motion.act(np.array(CENTRE)))),
    )
    here = plan_apf_compiled(SLAVE, START, GOAL, around(), IMPROVED)
    assert there.path == pytest.approx(here.path, abs=1e-9)
    assert there.clearance == pytest.approx(here.clearance, abs=1e-9)


def test_attraction_only_ignores_obstacles():
    settings = IMPROVED.changed(repulsion=None, virtual_point=None)
    plan = plan_apf_compiled(SLAVE, START, GOAL, around(), settings)
    free = plan_apf_compiled(SLAVE, START, GOAL, NOTHING, settings)
    assert plan.reached
    assert np.array_equal(plan.path, free.path)
    assert plan.clearance.min() < 0
    assert not plan.repulsive.any()
    assert np.isinf(free.clearance).all()


def test_weight_zero_takes_a_control_point_out():
    one = IMPROVED.changed(control_points=(7,))
    same = IMPROVED.changed(control_points=(2, 3, 4, 5, 7), weights=(0, 0, 0, 0, 1))
    first, second = (plan_apf_compiled(SLAVE, START, GOAL, around(), s) for s in (one, same))
    assert np.array_equal(first.path, second.path)


def test_neighbour_search_arrives_on_its_lattice():
    update = Update(rule="neighbour_search", max_step=0.03)
    plan = plan_apf_compiled(SLAVE, START, GOAL, around(), IMPROVED.changed(update=update))
    assert plan.reached
    steps = np.diff(plan.path, axis=0) / 0.03
    assert np.abs(steps - np.round(steps)).max() < 1e-9
    assert np.abs(steps).max() < 1 + 1e-9
