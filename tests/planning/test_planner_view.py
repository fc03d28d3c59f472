"""What planners are told: simpler, never smaller, nothing that makes them refuse wrongly."""

import time

import numpy as np
import pytest
from own_scenes import FLOOR, LEFT, RIGHT, both, written

from dualarm_repro.planning import load_tasks, plan_file
from dualarm_repro.planning.checks.truth import truth
from dualarm_repro.planning.planner_view import enclosing_box, planner_scene
from dualarm_repro.scene import Box, ConvexHull, Sphere, signed_distance

UP = "[0, 0, 0, 0, 0, 0]"
ASIDE = '["90 deg", 0, 0, 0, 0, 0]'
PLANAR = """<robot name="planar">
<link name="b"><collision><geometry><sphere radius="0.05"/></geometry></collision></link>
<link name="l1"><collision><origin xyz="{half}" rpy="{rpy}"/><geometry>
<cylinder radius="0.03" length="0.3"/></geometry></collision></link>
<link name="l2"><collision><origin xyz="{half}" rpy="{rpy}"/><geometry>
<cylinder radius="0.03" length="0.3"/></geometry></collision></link>
<link name="tip"/>
<joint name="j1" type="revolute"><parent link="b"/><child link="l1"/><origin xyz="0 0 0.1"/>
<axis xyz="0 0 1"/><limit lower="-2.5" upper="2.5" velocity="2" effort="1"/></joint>
<joint name="j2" type="revolute"><parent link="l1"/><child link="l2"/><origin xyz="{whole}"/>
<axis xyz="0 0 1"/><limit lower="-2.5" upper="2.5" velocity="2" effort="1"/></joint>
<joint name="e" type="fixed"><parent link="l2"/><child link="tip"/><origin xyz="{whole}"/></joint>
</robot>"""


def test_a_box_around_a_hull_holds_it_tightly():
    rng = np.random.default_rng(0)
    box = Box([0.3, -0.2, 0.5], [0.4, 0.2, 0.1], np.linalg.qr(rng.normal(size=(3, 3)))[0])
    if np.linalg.det(box.rotation) < 0:
        box = Box(box.center, box.size, -box.rotation)
    signs = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    found = enclosing_box(ConvexHull(box.center + (signs * box.half) @ box.rotation.T))
    assert np.sort(found.size) == pytest.approx(np.sort(box.size))
    for point in ConvexHull(rng.normal(size=(30, 3))).vertices:
        around = enclosing_box(ConvexHull(np.vstack([rng.normal(size=(20, 3)), point])))
        assert signed_distance(Sphere(point, 1e-9), around).distance <= 1e-8


def test_parked_arms_become_obstacles_and_mounts_are_left_out(tmp_path):
    text = f"arms:\n  {LEFT}\n  {RIGHT}\n{FLOOR.replace('floor: 0', 'floor: 0.2')}"
    given = load_tasks(written(tmp_path, text))
    starts = {"left": given.tasks["left"].start}
    told = planner_scene(given.scene, starts, given.parked)
    assert list(told.columns) == ["left"]
    assert list(told.moving) == ["right"]
    names = {body.name for body in told.bodies.all if body.owner == "left"}
    every = {body.name for body in given.scene.bodies.all if body.owner == "left"}
    assert "left/capsule_1_joint_1" in every - names
    assert every - names <= {"left/capsule_0_joint_0", "left/capsule_1_joint_1"}


def test_hulls_and_moving_shapes_can_be_planned_around(tmp_path):
    """A cylinder in the way: the planner sees a box, the report the prism."""
    rest = (
        "obstacles: {pole: {kind: cylinder, start: [0.05, 0.5, 0], end: [0.05, 0.5, 0.5], "
        "radius: 0.04}}\n"
    )
    left = f'start: {ASIDE}, goal: ["20 deg", 0.2, 0, 0, 0.3, 0]'
    path = written(tmp_path, both(left, f"start: {ASIDE}", rest))
    found = plan_file(path, "apf-improved")
    assert isinstance(found.scene.obstacles["pole"], ConvexHull)
    assert "pole" in found.plans["left"].obstacle_names
    assert truth(found.scene, found.paths).lower > 0.0


@pytest.mark.parametrize(
    ("whole", "half", "rpy"),
    [("0.4 0 0", "0.2 0 0", "0 1.5708 0"), ("0 0.4 0", "0 0.2 0", "1.5708 0 0")],
)
@pytest.mark.parametrize("name", ["apf-bidirectional", "apf-one-sided", "apf-improved"])
def test_a_planar_arm_can_be_the_master(tmp_path, name, whole, half, rpy):
    """Stretched at its start, so that all circles of its hull lie in one plane."""
    urdf = PLANAR.format(whole=whole, half=half, rpy=rpy)
    (tmp_path / "p.urdf").write_text(urdf, encoding="utf-8")
    far = f"right: {{robot: irb120, xyz: [5, 0, 0], start: {UP}, goal: [0.3, 0, 0, 0, 0, 0]}}"
    text = (
        f"arms:\n  left: {{robot: p.urdf, flange: tip, start: [0, 0], goal: [1.0, 0.3]}}\n  {far}\n"
    )
    found = plan_file(written(tmp_path, text), name)
    assert [plan.reached for plan in found.plans.values()] == [True, True]
    assert truth(found.scene, found.paths).collision_free


def test_three_arms_are_planned_and_judged_together(tmp_path):
    third = f"third: {{robot: irb120, xyz: [0, 1.5, 0], start: {UP}, goal: [0.5, 0, 0, 0, 0, 0]}}"
    ends = f'start: {ASIDE}, goal: ["70 deg", 0.1, 0, 0, 0, 0]'
    path = written(tmp_path, both(ends, ends) + f"  {third}\n")
    found = plan_file(path, "apf-improved")
    assert len(found.plans) == 3
    judged = truth(found.scene, found.paths)
    assert judged.collision_free
    assert set(judged.q) == {"left", "right", "third"}


def test_fourteen_joints_among_three_thousand_obstacles(tmp_path):
    """Two Pandas in a cloud of balls, from the file to the certified report."""
    rng = np.random.default_rng(7)
    at = rng.uniform([-4, -4, 0], [4, 4, 3], (6000, 3))
    near = np.linalg.norm(at[:, :2] - [0.0, 0.5], axis=1) < 1.7
    lines = [
        f"  ball{k}: {{kind: sphere, center: {np.round(p, 3).tolist()}, radius: 0.05}}\n"
        for k, p in enumerate(at[~near][:3000])
    ]
    home = "[%s, -0.3, 0, -1.8, 0, 1.5, 0]"
    text = "arms:\n" + "".join(
        f"  {name}: {{robot: panda, xyz: [0, {y}, 0], start: {home % 0.0}, goal: {home % goal}}}\n"
        for name, y, goal in (("left", 0.0, 0.4), ("right", 1.0, -0.4))
    )
    began = time.process_time()
    path = written(tmp_path, text + "obstacles:\n" + "".join(lines))
    found = plan_file(path, "apf-improved")
    judged = truth(found.scene, found.paths)
    assert time.process_time() - began < 60.0
    assert len(lines) == 3000
    assert found.scene.nq == 14
    assert judged.upper - judged.lower < 1.1e-3
    assert len(found.scene.obstacles) == 3000
