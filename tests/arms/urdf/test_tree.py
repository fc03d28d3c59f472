"""Joints that form no tree, and wrong arguments, are named before Pinocchio sees them."""

import pytest

from dualarm_repro.arms import load_arm
from dualarm_repro.errors import DataFileError, DualArmError

BALL = "<collision><geometry><sphere radius='.1'/></geometry></collision>"


def robot(folder, joints, links="b l1 l2"):
    made = [f"<link name='{name}'>{BALL}</link>" for name in links.split()]
    for k, (parent, child) in enumerate(joints):
        made.append(
            f"<joint name='j{k}' type='revolute'><parent link='{parent}'/><child link='{child}'/>"
            "<axis xyz='0 0 1'/><limit lower='-1' upper='1' effort='1' velocity='1'/></joint>"
        )
    path = folder / "robot.urdf"
    path.write_text(f"<robot name='r'>{''.join(made)}</robot>", encoding="utf-8")
    return path


BROKEN = {
    "two parents": (["b l1", "b l2", "l1 l2"], "parent joints of link l2 = 'j1 and j2'"),
    "loop to the root": (["b l1", "l1 l2", "l2 b"], "joints = .*not in a loop"),
    "loop beside": (["b b", "l1 l2"], "not in a loop"),
    "two roots": (["b l1"], r"links without parent joint = \['b', 'l2'\]"),
    "no such child": (["b l1", "l1 l9"], "child of joint j1 = 'l9'"),
    "no such parent": (["b l1", "l9 l2"], "parent of joint j1 = 'l9'"),
}


@pytest.mark.parametrize(("joints", "told"), BROKEN.values(), ids=BROKEN)
def test_what_is_no_tree_is_named(tmp_path, joints, told):
    with pytest.raises(DataFileError, match=told) as caught:
        load_arm(robot(tmp_path, [pair.split() for pair in joints]))
    assert "\n" not in str(caught.value)


def test_a_tree_loads(tmp_path):
    path = robot(tmp_path, [("b", "l1"), ("l1", "l2")])
    assert load_arm(path, shapes="enclosing").nq == 2
    for wrong in ({"flange": []}, {"flange": 3}, {"lock": [1]}, {"lock": {3: 1}}, {"shapes": []},
                  {"packages": 3}, {"packages": [3]}, {"packages": ["a\0b"]}):  # fmt: skip
        with pytest.raises(DualArmError):
            load_arm(path, **wrong)


def test_elements_inside_each_other_are_bounded(tmp_path):
    path = tmp_path / "deep.urdf"
    path.write_text("<robot>" + "<a>" * 20000 + "</a>" * 20000 + "</robot>")
    with pytest.raises(DataFileError, match="at most 100 elements inside each other"):
        load_arm(path)
