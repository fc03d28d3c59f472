"""Scenario of `qiu`: postures, goals, readings, scene file."""

from itertools import product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dualarm_repro.datafiles import data_path
from dualarm_repro.ledger import REGISTRY
from dualarm_repro.papers.qiu.goals import draw_goals
from dualarm_repro.papers.qiu.oscillation import chatter
from dualarm_repro.papers.qiu.readings import (
    IMPROVED,
    VARIANTS,
    balance_ratio,
    link_radii,
    master_arm,
    master_posture,
    reconstructed,
    settings,
    slave_posture,
    slave_postures,
)
from dualarm_repro.papers.qiu.scenario import (
    BRANCHES,
    MASTER_GOAL,
    SLAVE_GOAL,
    arm_in_use,
    branch_posture,
    placed,
    pulled_back,
    reach,
    shoulder,
    spheres,
)
from dualarm_repro.planning.field.control_points import end_effector
from dualarm_repro.scene import load_scene
from dualarm_repro.scene.posing import links_of


@pytest.fixture(scope="module")
def values():
    return REGISTRY.nominal("qiu")


@given(
    direction=st.lists(st.floats(-1, 1), min_size=3, max_size=3).filter(
        lambda v: np.linalg.norm(v) > 0.1 and np.hypot(v[0], v[1]) > 0.05
    ),
    radius=st.floats(0.2, 0.64),
    roll=st.floats(-3.0, 3.0),
    bend=st.floats(-1.0, 1.0),
)
def test_branch_postures_reach_their_point(direction, radius, roll, bend):
    arm = placed("master")
    point = shoulder(arm.placement.translation) + radius * np.array(direction) / np.linalg.norm(
        direction
    )
    found = [branch_posture(arm, point, branch, (roll, bend, 0.3)) for branch in BRANCHES]
    for q in found:
        if q is not None:
            assert end_effector(arm, q) == pytest.approx(point, abs=1e-9)
            assert q[3:] == pytest.approx([roll, bend, 0.3])
    assert bend != 0.0 or all(q is not None for q in found)


def test_reach_is_attained_and_never_passed():
    arm = placed("master")
    q = np.array([0.0, 0.4, np.arctan2(0.07, 0.302) - np.pi / 2, 0.0, 0.0, 0.0])
    q[4] = -np.arctan2(0.07, 0.302)
    away = np.linalg.norm(end_effector(arm, q) - shoulder(arm.placement.translation))
    assert away == pytest.approx(reach(), abs=1e-12)
    rows = arm.arm.random_configurations(2000, np.random.default_rng(1))
    far = np.linalg.norm(end_effector(arm, rows) - shoulder(arm.placement.translation), axis=1)
    assert far.max() <= reach() + 1e-12
    assert branch_posture(arm, MASTER_GOAL, "front_shallow") is None


def test_every_choice_of_the_goal_has_a_posture(values):
    choices = {key: REGISTRY.declared(f"qiu.{key}", "choices").choices for key in
               ("master_goal", "goal_branch", "goal_wrist")}  # fmt: skip
    for mode, branch, wrist in product(*choices.values()):
        for radius in REGISTRY.declared("qiu.goal_radius", "range").range:
            changed = values | {
                "master_goal": mode,
                "goal_branch": branch,
                "goal_wrist": wrist,
                "goal_radius": radius,
            }
            assert np.isfinite(master_posture(changed)).all()


def test_every_reading_of_the_goal(values):
    for mode in ("pulled_back", "longer_tool", "moved_base", "best_effort"):
        changed = values | {"master_goal": mode}
        tip = end_effector(master_arm(changed), master_posture(changed))
        if mode in ("longer_tool", "moved_base"):
            assert tip == pytest.approx(MASTER_GOAL, abs=1e-9)
        else:
            assert 0.02 < np.linalg.norm(tip - MASTER_GOAL) < 0.05
        assert abs(master_posture(changed)[0] - np.deg2rad(114)) < 0.1


def test_slave_goal_has_one_posture_within_the_limits(values):
    arm = placed("slave")
    inside = [q for q in slave_postures(values).values() if arm.arm.within_limits(q)]
    assert len(inside) == 1
    assert inside[0] == pytest.approx(slave_posture(values))
    assert end_effector(arm, inside[0]) == pytest.approx(SLAVE_GOAL, abs=1e-9)


def test_scene_file_is_the_scenario(values):
    scene = load_scene(data_path("scenes", "qiu.yaml"))
    goals = {"master": master_posture(values), "slave": slave_posture(values)}
    for arm in scene.arms:
        assert arm.placement.isApprox(placed(arm.name).placement, 1e-12)
        assert arm.goal == pytest.approx(goals[arm.name], abs=1e-9)
    for name, sphere in spheres().items():
        assert scene.obstacles[name].center == pytest.approx(sphere.center)
        assert scene.obstacles[name].radius == sphere.radius


def test_goals_are_seeded_and_keep_their_distance(values):
    one, two, other = (draw_goals(values, seed) for seed in (1, 1, 2))
    assert (one.q == two.q).all()
    assert not np.allclose(one.q, other.q)
    centre = end_effector(master_arm(values), master_posture(values))
    assert np.abs(one.points - centre).max() <= values["goal_set"]
    tips = end_effector(master_arm(values), one.q)
    assert tips == pytest.approx(one.points, abs=1e-9)


def test_variants_and_reconstruction(values):
    names = [variant.name for variant in VARIANTS]
    assert sorted(names) == sorted({"traditional", "V", "A", "B", "VA", "VB", "AB", "VAB"})
    for variant in VARIANTS:
        chosen = settings(values, variant)
        assert chosen.two_sided == ("B" in variant.name)
        assert (chosen.variable_gain.rule == "constant") == ("V" not in variant.name)
        assert (chosen.step.rule == "constant") == ("A" not in variant.name)
    changed = reconstructed(values, IMPROVED)
    assert 1e-4 < changed["gain_ratio"] == balance_ratio() < 1e-3
    assert settings(changed, VARIANTS[0]).radii[0] > 0.0


def test_assumed_radii_are_those_of_the_robot(values):
    assert links_of(arm_in_use()).radius == pytest.approx(values["link_radii"])
    thin = link_radii(values | {"link_radius_scale": 0.8})
    assert links_of(arm_in_use(radii=thin)).radius == pytest.approx(
        0.8 * np.array(values["link_radii"])
    )


def test_pulled_back_point_is_on_the_ray():
    base = np.array([0.35, 0.0, 0.0])
    point = pulled_back(MASTER_GOAL, base, 0.63) - shoulder(base)
    assert np.linalg.norm(point) == pytest.approx(0.63)
    assert np.cross(point, MASTER_GOAL - shoulder(base)) == pytest.approx(np.zeros(3), abs=1e-12)


@pytest.mark.parametrize("measure", ["sign_changes", "second_difference", "peak_to_peak"])
def test_chatter_tells_a_zigzag_from_a_slope(measure):
    slope = np.linspace(0.0, 1.0, 60)
    zigzag = 0.02 * (-1.0) ** np.arange(60)
    assert chatter(slope, measure) < 0.05
    assert chatter(zigzag, measure) > 0.5
