"""Random tasks and goals: seeded, as stated, and rejected for what they are rejected for."""

import numpy as np
import pytest
from two_spheres import placed_arm

from dualarm_repro.planning.checks.contact_check import contact_check
from dualarm_repro.planning.field.control_points import end_effector
from dualarm_repro.planning.tasks.random_goals import draw_goals
from dualarm_repro.planning.tasks.random_tasks import blocked_goal, blocked_task
from dualarm_repro.planning.tasks.tip_goal import REACHED, nearest_posture
from dualarm_repro.scene import Scene, Sphere, distances

SHOULDER = np.array([0.35, 0.0, 0.29])
TURNING = [("arm/capsule_1_joint_1", "floor")]
BENT = np.array([1.99, 0.52, -0.87, 0.0, 0.0, 0.0])


def _task(seed, count=3):
    rng = np.random.default_rng(seed)
    return blocked_task(placed_arm(), SHOULDER, count, 0.03, rng, 0.0, TURNING)


def test_tasks_are_blocked_and_their_ends_are_clear():
    scene, start, goal = _task(4)
    assert contact_check(scene, np.array([start, goal])).smallest < 0.0
    assert distances(scene, np.array([start, goal])).min() > 0.03
    assert len(scene.obstacles) == 3
    for sphere in scene.obstacles.values():
        assert 0.06 <= sphere.radius <= 0.14
        assert sphere.center[2] >= 0.15
        assert sphere.center[2] == 0.15 or (
            0.25 <= np.linalg.norm(sphere.center - SHOULDER) <= 0.65
        )


def test_tasks_follow_their_seed():
    (_, *one), (_, *two), (_, *other) = (_task(seed) for seed in (4, 4, 5))
    assert np.array_equal(one, two)
    assert not np.allclose(one, other)


def test_a_blocked_goal_is_clear_and_the_straight_line_is_not():
    scene = Scene([placed_arm()], {"ball": Sphere([0.35, 0.4, 0.5], 0.12)}, floor=0.0,
                  exempt=TURNING)  # fmt: skip
    goal = blocked_goal(scene, np.zeros(6), 0.05, np.random.default_rng(2))
    assert distances(scene, goal).min() > 0.05
    assert contact_check(scene, np.array([np.zeros(6), goal])).smallest < 0.0


def _drawn(posture, count=4, scene=None):
    arm = placed_arm()
    chosen = Scene([arm], {}) if scene is None else scene
    rng = np.random.default_rng(1)
    return draw_goals(chosen, posture, end_effector(arm, BENT), 0.05, count, rng)


def _nearest(point):
    found = nearest_posture(placed_arm(), point, BENT)
    return found.q if found.residual <= REACHED else None


def test_goals_are_where_they_were_drawn():
    goals = _drawn(_nearest)
    assert goals.q.shape == (4, 6)
    centre = end_effector(placed_arm(), BENT)
    assert np.abs(goals.points - centre).max() <= 0.05
    assert end_effector(placed_arm(), goals.q) == pytest.approx(goals.points, abs=1e-6)


@pytest.mark.parametrize(
    ("posture", "reason"),
    [(lambda _: None, "beyond reach"), (lambda _: np.full(6, 9.0), "outside limits")],
)
def test_a_set_that_cannot_be_filled_says_why(posture, reason):
    goals = _drawn(posture)
    assert goals.q.shape == (0, 6)
    assert goals.points.shape == (0, 3)
    assert goals.rejected[reason] == 1000 == sum(goals.rejected.values())


def test_goals_in_contact_are_rejected():
    around = Scene([placed_arm()], {"ball": Sphere(end_effector(placed_arm(), BENT), 0.2)})
    assert _drawn(lambda _: BENT, scene=around).rejected["in contact"] == 1000
