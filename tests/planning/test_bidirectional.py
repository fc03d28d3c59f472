"""Search from both ends: the two forms of the loop, invariances, ends, bad input."""

import numpy as np
import pinocchio as pin
import pytest
from two_spheres import GOAL, ONE_SIDED, START, obstacles, placed_arm, settings

from dualarm_repro.errors import ConfigurationError, InputError
from dualarm_repro.planning.descent.termination import StopReason
from dualarm_repro.planning.field.hull_obstacle import JointCircles, circles_on, hull_track
from dualarm_repro.planning.field.obstacles import obstacles_of
from dualarm_repro.planning.search.bidirectional import plan_bidirectional
from dualarm_repro.planning.search.bidirectional_batch import plan_bidirectional_batch
from dualarm_repro.planning.search.bidirectional_compiled import (
    plan_bidirectional_compiled,
    search_compiled,
)
from dualarm_repro.planning.search.bidirectional_settings import GainRule, StepRule, Threshold
from dualarm_repro.planning.search.failure import Failure, classify
from dualarm_repro.scene import PlacedArm, Scene, Sphere

VARIANTS = {
    "improved": {},
    "one-sided": ONE_SIDED,
    "gauss-seidel": {"order": "after"},
    "sum": {"repulsion": {"sources": "sum"}},
    "per joint": {"attraction": {"measure": Threshold.PER_JOINT}},
    "limits": {"enforce_limits": True, "radii": (0.05, 0.05, 0.03)},
    # Chatter amplifies the last digit, so that these runs are compared while it still counts.
    **{
        f"gain {rule}": {
            "two_sided": False,
            "variable_gain": {"rule": rule},
            "ending": {"search_limit": 100},
        }
        for rule in GainRule
    },
    **{f"step {rule}": {"step": {"rule": rule}} for rule in StepRule},
}


def planned(planner=plan_bidirectional_compiled, placement=None, hulls=None, **changes):
    chosen = settings(**changes)
    return planner(placed_arm(placement), START, GOAL, obstacles(placement), chosen, hulls)


def moving_hulls():
    placed = PlacedArm("other", placed_arm().arm, pin.SE3(np.eye(3), np.array([-0.6, 0.2, 0.0])))
    circles = JointCircles((1, 2, 3, 4, 5, 7), (0.09, 0.09, 0.075, 0.065, 0.05, 0.04), 8)
    path = np.linspace(START, 0.5 * GOAL, 9)
    track = hull_track(circles_on(placed, circles, path))
    return track, type(track)(*(part[::-1].copy() for part in track))


def assert_equal_plans(one, other, tolerance=1e-12):
    assert (one.reason, one.searches, one.record.flips) == (
        other.reason,
        other.searches,
        other.record.flips,
    )
    for name in ("paths", "clearances", "factors"):
        for a, b in zip(getattr(one.record, name), getattr(other.record, name), strict=True):
            assert a == pytest.approx(b, abs=tolerance)


@pytest.mark.parametrize("variant", VARIANTS)
def test_compiled_equals_readable(variant):
    one, other = (
        planned(p, **VARIANTS[variant]) for p in (plan_bidirectional, plan_bidirectional_compiled)
    )
    assert_equal_plans(one, other)


def test_compiled_equals_readable_with_a_moving_hull():
    one, other = (
        planned(p, hulls=moving_hulls()) for p in (plan_bidirectional, plan_bidirectional_compiled)
    )
    assert_equal_plans(one, other)
    assert one.searches != planned().searches or one.gap != planned().gap


def test_halves_begin_at_the_ends_and_meet():
    plan = planned()
    assert plan.reached
    assert plan.gap <= 0.05
    assert (plan.path[0] == START).all()
    assert (plan.path[-1] == GOAL).all()
    assert len(plan.path) == 2 * plan.searches + 2 == len(plan.to_frame())
    steps = np.linalg.norm(np.diff(plan.path, axis=0), axis=1)
    assert steps.max() <= 0.05 + 1e-12
    assert plan.control_clearance > 0


def test_one_sided_search_is_pushed_off_a_goal_near_an_obstacle(monkeypatch):
    plan = planned(**ONE_SIDED, repulsion={"gain": 10.0})
    assert plan.reason is StopReason.TRAPPED
    assert classify(plan) is Failure.DISPLACED_GOAL
    assert classify(planned()) is None
    starts = []

    def noted(made):
        starts.append(made.start)
        return search_compiled(made)

    monkeypatch.setattr("dualarm_repro.planning.search.failure.search_compiled", noted)
    assert classify(plan) is Failure.DISPLACED_GOAL
    assert 0.0 < np.abs(starts[0] - plan.problem.goal).max() <= 1e-5  # it begins beside the goal
    hurried = {**ONE_SIDED, "ending": {"search_limit": 10}}
    assert classify(planned(**hurried)) is Failure.NO_REST


def test_a_wall_of_spheres_on_the_way_is_a_midway_minimum():
    placed = placed_arm()
    wall = {f"ball_{k}": Sphere([0.05, y, z], 0.08) for k, (y, z) in enumerate(np.ndindex(6, 7))}
    wall = {
        name: Sphere([0.02, 0.2 + 0.11 * (k % 5), 0.11 * (k // 5)], 0.08)
        for k, name in enumerate(list(wall)[:40])
    }
    chosen = settings(**ONE_SIDED, repulsion={"gain": 0.2, "influence": 0.1})
    goal = np.array([1.6, 0.3, -0.2, 0.0, 0.0, 0.0])
    plan = plan_bidirectional_compiled(
        placed, START, goal, obstacles_of(Scene([placed], wall)), chosen
    )
    assert classify(plan) is Failure.MIDWAY_MINIMUM


def test_only_the_ratio_of_the_gains_counts():
    scaled = planned(attraction={"gain": 7.0}, repulsion={"gain": 0.07})
    assert_equal_plans(planned(), scaled, 1e-8)


def test_moving_the_whole_scene_changes_nothing():
    placement = pin.SE3(pin.rpy.rpyToMatrix(0.3, -0.4, 1.1), np.array([0.7, -0.2, 0.4]))
    assert_equal_plans(planned(), planned(placement=placement), 1e-8)


def test_mirror_image():
    arm = placed_arm().arm
    plain, mirrored = PlacedArm("arm", arm), PlacedArm("arm", arm.mirrored())
    balls = {"a": Sphere([0.3, 0.2, 0.6], 0.1), "b": Sphere([0.25, 0.35, 0.4], 0.08)}
    reflected = {name: Sphere(b.center * [1, -1, 1], b.radius) for name, b in balls.items()}
    goal = np.array([1.4, 0.4, -0.3, 0.2, 0.4, 0.0])
    plans = [
        plan_bidirectional_compiled(p, START, sign * goal, obstacles_of(Scene([p], s)), settings())
        for p, s, sign in ((plain, balls, 1), (mirrored, reflected, -1))
    ]
    assert plans[0].path == pytest.approx(-plans[1].path, abs=1e-9)


@pytest.mark.parametrize(
    ("changes", "field"),
    [
        ({"control_points": "capsules", "step": {"weights": None}}, "control_points"),
        ({"control_points": (3, 9)}, "control point"),
        ({"radii": (0.1,)}, "radii"),
        ({"step": {"weights": (1, 2)}}, "step.weights"),
        ({"variable_gain": {"kappa": 0.0}}, "kappa"),
        ({"attraction": {"gain": -1.0}}, "gain"),
        ({"ending": {"search_limit": 0}}, "search_limit"),
    ],
)
def test_bad_settings(changes, field):
    with pytest.raises(InputError) as caught:
        planned(**changes)
    assert caught.value.field == field


def test_bad_configurations():
    for q in ([0, 1], [np.nan] * 6, np.zeros((2, 6))):
        with pytest.raises(ConfigurationError):
            plan_bidirectional_compiled(placed_arm(), q, GOAL, obstacles(), settings())
    limited = settings(enforce_limits=True)
    with pytest.raises(ConfigurationError, match="limits"):
        plan_bidirectional_compiled(placed_arm(), START, GOAL + 9.0, obstacles(), limited)


@pytest.mark.parametrize("changes", [{}, ONE_SIDED, {"ending": {"search_limit": 3}}])
@pytest.mark.parametrize("jobs", [1, 3])
def test_batch_gives_the_plans_of_single_searches(changes, jobs):
    """To the last bit, for any number of threads, around a hull that moves too."""
    rng = np.random.default_rng(11)
    goals = GOAL + rng.uniform(-0.3, 0.3, (40, len(GOAL)))
    starts = START + rng.uniform(-0.1, 0.1, goals.shape)
    given = (obstacles(None), settings(**changes), moving_hulls())
    found = plan_bidirectional_batch(placed_arm(None), starts, goals, *given, jobs)
    assert len(found) == 40
    for one, start, goal in zip(found, starts, goals, strict=True):
        assert_equal_plans(
            one, plan_bidirectional_compiled(placed_arm(None), start, goal, *given), 0.0
        )
        np.testing.assert_array_equal(one.problem.goal, goal)


def test_batch_refuses_what_does_not_fit():
    given = (obstacles(None), settings())
    arm = placed_arm(None)
    with pytest.raises(ConfigurationError, match="goals"):
        plan_bidirectional_batch(arm, [START, START], [GOAL], *given)
    with pytest.raises(InputError, match="jobs"):
        plan_bidirectional_batch(arm, [START], [GOAL], *given, jobs=0)
    limited = settings(enforce_limits=True)
    with pytest.raises(ConfigurationError, match="goal"):
        plan_bidirectional_batch(arm, [START] * 2, [GOAL, GOAL + 99.0], given[0], limited)
