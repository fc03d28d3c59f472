"""Distances of exact shapes along a motion, against what they are by hand."""

import numpy as np
import pinocchio as pin
import pytest

from dualarm_repro.arms import Evidence, Exclusion, load_arm
from dualarm_repro.errors import UnsupportedArmError
from dualarm_repro.planning.checks.mesh_replay import mesh_distance
from dualarm_repro.scene import PlacedArm, Scene

BALL = "<collision><geometry><sphere radius='{}'/></geometry></collision>"
JOINT = (
    "<joint name='j{0}' type='revolute'><parent link='l{0}'/><child link='l{1}'/>"
    "<origin xyz='{2} 0 0'/><axis xyz='0 0 1'/>"
    "<limit lower='-3' upper='3' effort='1' velocity='1'/></joint>"
)


@pytest.fixture
def arm(tmp_path):
    """Balls of 0.1 m at the base and the tip, 1 m away, and of 0.02 m at joints 1 and 2."""
    balls = ("0.1", "0.02", "0.02", "0.1")
    links = "".join(f"<link name='l{k}'>{BALL.format(r)}</link>" for k, r in enumerate(balls))
    joints = "".join(JOINT.format(k, k + 1, x) for k, x in enumerate((0, 0.5, 0.5)))
    path = tmp_path / "arm.urdf"
    path.write_text(f"<robot name='r'>{links}{joints}</robot>", encoding="utf-8")
    return load_arm(path)


def test_one_arm_by_itself(arm):
    """|l0 l2| = 0.5, |l0 l3| = cos(q/2); the nearest of the rows counts, contact is 0."""
    scene = Scene([PlacedArm("a", arm)])
    rows = np.array([[0.0, 0.0, 0.0], [0.3, 1.0, 0.0], [0.3, 2.4, 0.0]])
    assert mesh_distance(scene, rows[:2]) == pytest.approx(0.5 - 0.12, abs=1e-6)
    assert mesh_distance(scene, rows) == pytest.approx(np.cos(1.2) - 0.2, abs=1e-6)
    assert mesh_distance(scene, np.array([0.0, 2.9, 0.0])) == 0.0


@pytest.mark.parametrize(
    ("evidence", "contact"), [(Evidence.NEVER, 0.0), (Evidence.HOME, np.cos(1.45) - 0.12)]
)
def test_pairs_that_are_left_out(arm, evidence, contact):
    """Of shapes that never meet only contact counts, of shapes that say nothing not even that; the
    ball of joint 1 is where that of the base is, and smaller."""
    arm.__dict__["exclusions"] = (Exclusion("l0_0", "l3_0", evidence, 0, 10, 10),)
    scene = Scene([PlacedArm("a", arm)])
    assert mesh_distance(scene, np.array([0.3, 2.4, 0.0])) == pytest.approx(
        np.cos(1.2) - 0.12, abs=1e-6
    )
    assert mesh_distance(scene, np.array([0.0, 2.9, 0.0])) == pytest.approx(contact, abs=1e-6)


def test_two_arms(arm):
    """Stretched towards each other from 2.3 m apart they leave 0.3 m minus two radii."""
    turned = pin.SE3(pin.rpy.rpyToMatrix(0.0, 0.0, np.pi), np.array([2.3, 0.0, 0.0]))
    scene = Scene([PlacedArm("a", arm), PlacedArm("b", arm, turned)])
    assert mesh_distance(scene, np.zeros((1, 6))) == pytest.approx(0.1, abs=1e-6)


def test_an_arm_of_a_table_has_no_exact_shapes():
    scene = Scene([PlacedArm("a", load_arm("irb120"))])
    with pytest.raises(UnsupportedArmError, match="irb120: its exact shapes are not known"):
        mesh_distance(scene, np.zeros((1, 6)))
