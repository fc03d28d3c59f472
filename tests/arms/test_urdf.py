"""Loading by name or path: URDF files, their flange, their locked joints and their defects."""

import math
import shutil

import numpy as np
import pinocchio as pin
import pytest
from example_robot_data import getModelPath
from numpy.testing import assert_allclose

from dualarm_repro.arms import arm_names, load_arm
from dualarm_repro.errors import DataFileError, UnknownNameError

PANDA = "panda_description/urdf/panda.urdf"
LINK = "<link name='{0}'/>"
JOINT = (
    "<joint name='{0}' type='{1}'><parent link='{2}'/><child link='{3}'/>"
    "<origin xyz='0.1 0 0.2' rpy='0.1 0.2 0.3'/><axis xyz='0 1 0'/>{4}</joint>"
)
BALL = "<collision><geometry><sphere radius='0.1'/></geometry></collision>"
LIMIT = "<limit lower='-1' upper='2' effort='1' velocity='3'/>"


@pytest.fixture
def urdf(tmp_path):
    """A URDF with the given joints (name, type, parent, child, limit)."""

    def write(*joints, head="<robot name='test'>", shapes=BALL):
        links = dict.fromkeys(name for joint in joints for name in joint[2:4])
        body = "".join(LINK.format(name) for name in links)
        body = body.replace("<link name='b'/>", f"<link name='b'>{shapes}</link>")
        path = tmp_path / "arm.urdf"
        path.write_text(
            head + body + "".join(JOINT.format(*joint) for joint in joints) + "</robot>",
            encoding="utf-8",
        )
        return path

    return write


def test_names():
    assert {"es165d", "irb120", "er16", "er20-1780", "kr16-2", "panda", "xarm7"} <= set(arm_names())
    with pytest.raises(UnknownNameError, match=r"'irb121': expected one of er16, .*, xarm7, or"):
        load_arm("irb121")


def test_path_gives_the_same_arm_as_the_name(rng):
    named = load_arm("panda")
    by_path = load_arm(f"{getModelPath(PANDA)}/{PANDA}", flange="panda_link8")
    q = named.random_configurations(20, rng)
    assert_allclose(by_path.fk(q), named.fk(q), atol=0)
    tool = load_arm("panda", flange="panda_hand_tcp").fk(q)
    assert_allclose(np.linalg.norm(tool[:, :3, 3] - named.fk(q)[:, :3, 3], axis=1), 0.1034)


def test_the_default_flange_is_the_end_of_the_longest_chain(urdf, rng):
    path = urdf(
        ("j1", "revolute", "a", "b", LIMIT),
        ("j2", "revolute", "b", "c", LIMIT),
        ("side", "revolute", "a", "d", LIMIT),
        ("tip", "fixed", "c", "e", ""),
    )
    arm = load_arm(path)
    assert arm.nq == 2
    assert arm.model.frames[arm.flange_id].name == "e"
    assert_allclose(arm.lower, -1)
    assert_allclose(arm.upper, 2)
    assert_allclose(arm.velocity_limit, 3)
    assert load_arm(path, flange="d").nq == 1
    q = arm.random_configurations(5, rng)
    full = pin.buildModelFromUrdf(str(path))
    data = full.createData()
    for row in q:
        pin.framesForwardKinematics(full, data, np.append(row, 0.0))
        assert_allclose(data.oMf[full.getFrameId("e")].homogeneous, arm.fk(row), atol=1e-14)


def test_locked_joint_keeps_its_angle(urdf):
    path = urdf(("j1", "revolute", "a", "b", LIMIT), ("j2", "revolute", "b", "c", LIMIT))
    free, locked = load_arm(path), load_arm(path, lock={"j1": 0.7})
    assert locked.nq == 1
    assert_allclose(locked.fk([0.3]), free.fk([0.7, 0.3]), atol=1e-14)
    with pytest.raises(UnknownNameError, match="lock = 'j9': expected one of j1, j2"):
        load_arm(path, lock={"j9": 0.0})
    with pytest.raises(UnknownNameError, match="flange = 'z': expected one of"):
        load_arm(path, flange="z")


@pytest.mark.parametrize("limit", ["", LIMIT, "<limit effort='1' velocity='3'/>"])
def test_continuous_joint_turns_for_ever(limit, urdf):
    arm = load_arm(urdf(("j1", "continuous", "a", "b", limit)))
    assert arm.nq == arm.model.nv == 1
    assert_allclose([arm.lower[0], arm.upper[0]], [-math.inf, math.inf])


@pytest.mark.parametrize(
    ("joint", "said"),
    [
        (("j1", "revolute", "a", "b", ""), "does not specify limits"),
        (("j1", "hinge", "a", "b", LIMIT), "hinge"),
        (("j1", "fixed", "a", "b", ""), "joints = 0"),
        (("j1", "revolute", "a", "b", LIMIT.replace("'2'", "'-2'")), "limit of joint j1"),
        (("j1", "revolute", "a", "b", LIMIT.replace("'2'", "'nan'")), "arm.urdf"),
    ],
)
def test_broken_joint(joint, said, urdf, capfd):
    with pytest.raises(DataFileError) as caught:
        load_arm(urdf(joint))
    assert "arm.urdf: " in str(caught.value)
    assert said in str(caught.value)
    assert capfd.readouterr().err == "", "the parser must not write to the terminal"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "well-formed XML"),
        ("<robot name='x'><link", "well-formed XML"),
        ("<model/>", "root element = 'model'"),
        ("<robot name='x'/>", "collision shapes = 0"),
        (b"\xff\xfe\x00", "well-formed XML"),
    ],
)
def test_broken_file(text, said, tmp_path):
    path = tmp_path / "broken.urdf"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    with pytest.raises(DataFileError, match=said):
        load_arm(path)


def test_missing_file(tmp_path):
    for name in ("none.urdf", "none.yaml", "folder/none.urdf"):
        with pytest.raises(DataFileError, match=r"none\..*No such file"):
            load_arm(tmp_path / name)
    with pytest.raises(DataFileError, match="file"):
        load_arm(tmp_path)


def test_kinematics_work_without_the_meshes(urdf):
    mesh = "<collision><geometry><mesh filename='package://gone/a.stl'/></geometry></collision>"
    arm = load_arm(urdf(("j1", "revolute", "a", "b", LIMIT), shapes=mesh))
    assert arm.fk([0.1]).shape == (4, 4)
    with pytest.raises(DataFileError, match="mesh of collision 0 of link b"):
        _ = arm.geometry


def test_robot_file_with_a_urdf_beside_it(urdf, tmp_path):
    path = urdf(("j1", "revolute", "a", "b", LIMIT))
    robot = tmp_path / "own.yaml"
    origin = "{source: own, evidence: assumed}"
    robot.write_text(
        "kind: urdf\ntitle: own arm\nevidence: own\nsources: {own: own}\n"
        f"urdf: arm.urdf\nflange: b\nprovenance: {{model: {origin}}}\n",
        encoding="utf-8",
    )
    arm = load_arm(robot)
    assert (arm.name, arm.title) == ("own", "own arm")
    assert_allclose(arm.fk([0.2]), load_arm(path).fk([0.2]), atol=0)
    shutil.move(path, tmp_path / "gone.urdf")
    with pytest.raises(DataFileError, match=r"own\.yaml: urdf = 'arm\.urdf': expected a URDF"):
        load_arm(robot)
