"""Links that are seen but have no collision shape, beside links that have one."""

import pytest

from dualarm_repro.arms import load_arm

BALL = "<geometry><sphere radius='0.1'/></geometry>"
BOX = "<geometry><box size='1 2 3'/></geometry>"
JOINT = (
    "<joint name='j{0}' type='revolute'><parent link='{1}'/><child link='{2}'/>"
    "<axis xyz='0 0 1'/><limit lower='-1' upper='1' effort='1' velocity='1'/></joint>"
)


def robot(folder, seen):
    """Three links: one with a collision shape, one only ``seen``, one of which there is nothing."""
    made = f"<link name='b'><collision>{BALL}</collision></link><link name='l1'>{seen}</link>"
    made += "<link name='l2'/>" + JOINT.format(1, "b", "l1") + JOINT.format(2, "l1", "l2")
    path = folder / "robot.urdf"
    path.write_text(f"<robot name='r'>{made}</robot>", encoding="utf-8")
    return path


@pytest.mark.parametrize("shapes", ["fitted", "enclosing"])
def test_visual_shapes_stand_in_and_are_listed(tmp_path, shapes):
    arm = load_arm(robot(tmp_path, f"<visual>{BOX}</visual><visual>{BALL}</visual>"), shapes=shapes)
    names = [one.name for one in arm.solids.geometryObjects]
    assert names == ["b_0", "l1_0", "l1_1"]
    assert arm.solids.geometryObjects[1].geometry.halfSide.tolist() == [0.5, 1.0, 1.5]
    assert arm.remarks == ("visual shapes stand in for missing collision shapes of links l1",)
    assert {one.name.partition("_")[0] for one in arm.geometry.geometryObjects} == {"b", "l1"}


@pytest.mark.parametrize(
    "seen", ["<mesh filename='gone.stl'/>", "<cone radius='1'/>", "<box size='1 2'/>"]
)
def test_what_cannot_stand_in_is_named(tmp_path, seen):
    arm = load_arm(robot(tmp_path, f"<visual><geometry>{seen}</geometry></visual>"))
    assert [one.name for one in arm.solids.geometryObjects] == ["b_0"]
    (remark,) = arm.remarks
    assert remark.startswith("not represented")
    assert "l1 (visual 0" in remark


def test_a_link_of_which_nothing_is_seen_says_nothing(tmp_path):
    assert load_arm(robot(tmp_path, "")).remarks == ()
