"""Joints: what moves, what is locked where, what follows what."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from dualarm_repro.arms import JointType, load_arm
from dualarm_repro.errors import DataFileError, DualArmError, UnknownNameError

from .texts import forward, joint, link, write

LIFT = "<limit lower='0' upper='0.4' effort='1' velocity='1'/>"
MIMIC = "<mimic joint='{}' multiplier='-2' offset='0.1'/>"


@pytest.fixture
def lift(tmp_path):
    """A lift, a joint that turns for ever and an ordinary one."""
    return write(
        tmp_path,
        *map(link, ("b", "l1", "l2", "l3")),
        joint(
            "up",
            "b",
            "l1",
            "prismatic",
            limit=LIFT,
        ),
        joint("turn", "l1", "l2", "continuous", "0 1 0", limit=""),
        joint("bend", "l2", "l3", "revolute", "1 0 0"),
    )


def test_kinds_limits_and_kinematics(lift, rng):
    arm = load_arm(lift)
    assert arm.types == (JointType.PRISMATIC, JointType.CONTINUOUS, JointType.REVOLUTE)
    assert_allclose(arm.lower, (0, -np.inf, -2.5))
    assert_allclose(arm.upper, (0.4, np.inf, 2.5))
    q = arm.random_configurations(50, rng)
    assert arm.within_limits(q).all()
    assert arm.within_limits([0.2, 100.0, 0.0]), "it turns for ever"
    assert np.abs(q[:, 1]).max() <= math.pi
    right = [forward(lift, "l3", dict(zip(("up", "turn", "bend"), row, strict=True))) for row in q]
    assert_allclose(arm.fk(q), right, atol=1e-14)
    assert_allclose([arm.fk(row) for row in q], right, atol=1e-14)


@pytest.mark.parametrize(
    ("lower", "upper", "kind"),
    [
        ("-1e16", "1e16", JointType.CONTINUOUS),
        ("-1e16", "3", JointType.REVOLUTE),
        ("-900", "900", JointType.REVOLUTE),
    ],
)
def test_limits_that_say_there_are_none(lower, upper, kind, tmp_path):
    limit = f"<limit lower='{lower}' upper='{upper}' effort='1' velocity='1'/>"
    links = (*map(link, ("b", "l1")), joint("turn", "b", "l1", "revolute", "0 1 0", limit=limit))
    arm = load_arm(write(tmp_path, *links))
    assert arm.types == (kind,)
    expected = np.inf if kind is JointType.CONTINUOUS else float(upper)
    assert arm.upper[0] == expected


@pytest.mark.parametrize(
    ("value", "angle"), [(0.7, 0.7), ("90 deg", math.pi / 2), ("-pi/4", -math.pi / 4)]
)
def test_an_angle_to_lock_at(value, angle, lift):
    locked = load_arm(lift, lock={"bend": value, "up": np.float64(0.25)})
    assert locked.nq == 1
    right = forward(lift, "l3", {"up": 0.25, "turn": 1.0, "bend": angle})
    assert_allclose(locked.fk([1.0]), right, atol=1e-14)


@pytest.mark.parametrize(
    ("lock", "said"),
    [
        ({"bend": math.nan}, "lock: bend = nan: expected an angle"),
        ({"bend": "fast"}, "lock: bend = 'fast': expected an angle"),
        ({"bend": None}, "lock: bend = None: expected an angle"),
        ({"bend": 9.0}, "lock: bend = 9.0: expected a value within its limits -2.5 ... 2.5 rad"),
        ({"up": 0.5}, "lock: up = 0.5: expected a value within its limits 0 ... 0.4 m"),
        ({"up": "30 deg"}, "lock: up = '30 deg': expected a length"),
        ({"up": math.inf}, "lock: up = inf: expected a length"),
        ({"side": 0.0}, "lock = 'side': expected one of up, turn, bend"),
    ],
)
def test_what_no_joint_can_be_locked_at(lock, said, lift):
    with pytest.raises((DataFileError, UnknownNameError)) as caught:
        load_arm(lift, lock=lock)
    assert said in str(caught.value)


@pytest.mark.parametrize("kind", ["planar", "floating"])
def test_a_joint_that_is_not_represented_is_named_with_the_remedy(kind, tmp_path):
    parts = [*map(link, ("b", "l1", "l2")), joint("j1", "b", "l1", kind)]
    path = write(tmp_path, *parts, joint("j2", "l1", "l2"))
    with pytest.raises(DataFileError, match=rf"type of joint j1 = '{kind}'.*flange=.*lock="):
        load_arm(path)
    assert load_arm(path, lock={"j1": 0}).nq == 1


def test_an_unknown_kind_of_joint_is_named(tmp_path):
    path = write(tmp_path, link("b"), link("l1"), joint("j1", "b", "l1", "screw"))
    with pytest.raises(DataFileError, match="type of joint j1 = 'screw': expected one of revolute"):
        load_arm(path)


def test_gears(tmp_path):
    """q_j2 = -2 q_j1 + 0.1: locked with its master, refused where only one of them moves."""
    parts = [*map(link, ("b", "l1", "l2", "l3"))]
    geared = joint("j2", "l1", "l2", extra=MIMIC.format("j1"))
    path = write(tmp_path, *parts, joint("j1", "b", "l1"), geared, joint("j3", "l2", "l3"))
    with pytest.raises(DataFileError, match=r"mimic of joint j2 = 'j1': .*flange=.*lock="):
        load_arm(path, flange="l3")
    arm = load_arm(path, flange="l3", lock={"j1": 0.3})
    assert list(arm.model.names)[1:] == ["j3"]
    right = forward(path, "l3", {"j1": 0.3, "j2": -0.5, "j3": 0.2})
    assert_allclose(arm.fk([0.2]), right, atol=1e-14)
    aside = joint("j2", "b", "l2", extra=MIMIC.format("j1"))
    path = write(tmp_path, *parts[:3], joint("j1", "b", "l1"), aside)
    with pytest.raises(DataFileError, match=r"mimic of joint j2 = 'j1': .*lock=\{'j2'"):
        load_arm(path, flange="l1")
    assert load_arm(path, flange="l1", lock={"j2": 0.0}).nq == 1
    for wrong in ("<mimic joint='j9'/>", "<mimic joint='j2' multiplier='x'/>"):
        broken = joint("j1", "b", "l1", extra=wrong)
        with pytest.raises(DataFileError, match="mimic of joint j1"):
            load_arm(write(tmp_path, *parts[:3], broken, joint("j2", "l1", "l2")))


def test_links_and_joints_of_one_name(tmp_path):
    names = ["b", *(f"j{k}" for k in range(1, 4))]
    joints = [joint(f"j{k + 1}", names[k], names[k + 1], axis="0 1 0") for k in range(3)]
    path = write(tmp_path, *map(link, names), *joints)
    arm = load_arm(path, shapes="enclosing")
    q = {f"j{k}": 0.1 * k for k in range(1, 4)}
    assert arm.model.frames[arm.flange_id].name == "j3"
    assert_allclose(arm.fk([*q.values()]), forward(path, "j3", q), atol=1e-14)
    assert {one.name for one in arm.geometry.geometryObjects} == {f"{name}_0" for name in names}


@pytest.mark.parametrize(
    "text",
    [
        "<!DOCTYPE r [<!ENTITY a 'aaaa'>]><robot name='r'/>",
        "<robot name='r' xmlns:xacro='http://www.ros.org/wiki/xacro'><xacro:arm/></robot>",
        "<robot name='r'><joint name='j'/></robot>",
        "<robot name='r'><link/><joint type='revolute'/></robot>",
        "<robot name='r'><link name='a'/><link name='b'/><joint name='j' type='revolute'/></robot>",
    ],
)
def test_nothing_but_errors_of_our_own(text, tmp_path, capfd):
    path = tmp_path / "arm.urdf"
    path.write_text(text)
    for options in ({}, {"shapes": "none"}):
        with pytest.raises(DualArmError) as caught:
            load_arm(path, **options)
        assert "\n" not in str(caught.value)
    assert capfd.readouterr().err == ""
