"""The default flange is the last link before a gripper: counted by hand from public files."""

from pathlib import Path

import pytest
from example_robot_data import getModelPath

from dualarm_repro.arms import load_arm

from .texts import joint, link, write


@pytest.mark.parametrize(
    ("file", "joints", "flange"),
    [
        ("panda_description/urdf/panda.urdf", 7, "panda_link8"),
        ("baxter_description/urdf/baxter.urdf", 7, None),
        ("kinova_description/robots/kinova.urdf", 6, "j2s6s200_end_effector"),
        ("so_arm_description/urdf/so100.urdf", 5, None),
        ("so_arm_description/urdf/so101.urdf", 5, None),
        ("bravo7_description/urdf/bravo7_gripper.urdf", 6, None),
        ("z1_description/urdf/z1.urdf", 6, "link06"),
        ("b1_description/urdf/b1-z1.urdf", 6, "link06"),
        ("pr2_description/urdf/pr2.urdf", 8, "l_wrist_roll_link"),
        ("ur_description/urdf/ur5_robot.urdf", 6, "tool0"),
        ("ur_description/urdf/ur5_gripper.urdf", 6, None),
        ("xarm_description/urdf/xarm7.urdf", 7, "link_eef"),
        ("tiago_description/robots/tiago.urdf", 8, None),
        ("talos_data/robots/talos_left_arm.urdf", 6, None),
    ],
)
def test_public_arms(file, joints, flange):
    arm = load_arm(Path(getModelPath(file)) / file, shapes="none")
    name = arm.model.frames[arm.flange_id].name
    assert arm.nq == joints, name
    assert flange in (None, name)
    assert not any(word in name for word in ("finger", "jaw", "thumb"))


def test_fingers_without_a_telling_name(tmp_path):
    """Two branches of one joint each at the end of five: five joints."""
    names = [f"l{k}" for k in range(6)]
    chain = [joint(f"j{k}", names[k], names[k + 1]) for k in range(5)]
    branches = [joint("m1", "l5", "x"), joint("m2", "l5", "y")]
    arm = load_arm(write(tmp_path, *map(link, (*names, "x", "y")), *chain, *branches))
    assert (arm.nq, arm.model.frames[arm.flange_id].name) == (5, "l5")


def test_two_arms_on_a_torso_are_no_fingers(tmp_path):
    names = ["b", "t", *(f"{side}{k}" for side in "ac" for k in range(5))]
    joints = [joint("jt", "b", "t")]
    for side in "ac":
        ends = ["t", *(f"{side}{k}" for k in range(5))]
        joints += [joint(f"j{side}{k}", ends[k], ends[k + 1]) for k in range(5)]
    arm = load_arm(write(tmp_path, *map(link, names), *joints), shapes="none")
    assert arm.nq == 6


def test_a_gripper_alone_is_an_arm(tmp_path):
    path = write(tmp_path, link("palm"), link("finger"), joint("finger_joint", "palm", "finger"))
    assert load_arm(path).nq == 1
