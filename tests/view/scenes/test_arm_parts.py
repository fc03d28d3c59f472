"""What is drawn of an arm lies within what is checked of it."""

import numpy as np
import pytest

from dualarm_repro.arms import arm_names, load_arm
from dualarm_repro.arms.robot_file import URDFRobot, load_robot_file
from dualarm_repro.datafiles import data_path
from dualarm_repro.view.scenes.arm_parts import arm_parts, checked_parts, joint_axis, mixed
from dualarm_repro.view.scenes.surfaces import surface


def gaps(arm, joint, points):
    """How far points in the frame of a joint stick out of its capsules [m]."""
    found = []
    for capsule in arm.geometry.geometryObjects:
        if capsule.parentJoint == joint:
            local = (points - capsule.placement.translation) @ capsule.placement.rotation
            half = capsule.geometry.halfLength
            axis = np.clip(local[:, 2], -half, half)
            local[:, 2] -= axis
            found.append(np.linalg.norm(local, axis=1) - capsule.geometry.radius)
    return np.min(found, axis=0)


@pytest.mark.parametrize("name", [n for n in arm_names() if n not in ("kinova-j2s6s200",)])
def test_links_and_barrels_lie_within_the_capsules(name):
    arm = load_arm(name)
    parts = [part for part in arm_parts("a", arm, "#0072B2", 1.0, "a/0") if part.body]
    assert {part.kind for part in parts} >= {"tapered", "rod"}
    for part in parts:
        joint = int(part.node.removeprefix("a/"))
        assert gaps(arm, joint, surface(part).vertices).max() < 1e-9


def test_a_barrel_that_is_too_long_would_be_seen():
    arm = load_arm("es165d")
    rod = next(p for p in arm_parts("a", arm, "#0072B2", 1.0, "a/0") if p.kind == "rod" and p.body)
    longer = surface(rod).vertices * 1.5
    assert gaps(arm, int(rod.node.removeprefix("a/")), longer).max() > 1e-3


def test_checked_parts_are_the_capsules():
    arm = load_arm("irb120")
    parts = list(checked_parts("a", arm, "#0072B2", "a/0"))
    assert len(parts) == arm.geometry.ngeoms
    for part, capsule in zip(parts, arm.geometry.geometryObjects, strict=True):
        assert part.node == f"a/{capsule.parentJoint}"
        made, shape = surface(part), capsule.geometry
        cores = made.vertices - shape.radius * made.normals - part.pose[:3, 3]
        cores = cores @ part.pose[:3, :3]
        assert np.allclose(cores[:, :2], 0.0)
        assert np.allclose(abs(cores[:, 2]), shape.halfLength)


def test_axes_of_joints():
    assert np.allclose(joint_axis(load_arm("es165d"), 3), [0.0, 0.0, 1.0])
    robot = load_robot_file(data_path("robots", "ur5.yaml"))
    assert isinstance(robot, URDFRobot)
    assert np.allclose(joint_axis(load_arm("ur5"), 2), [0.0, 1.0, 0.0])


def test_colours_are_mixed():
    assert mixed("#000000", "#FFFFFF", 0.5) == "#808080"
