"""The audit of an arm sees what is wrong with it."""

import coal
import numpy as np
import pinocchio as pin
import pytest

from dualarm_repro.arms import load_arm
from dualarm_repro.scene.audit import audit, excess, fk_error, outside

PLATE = "<collision><geometry><box size='0.3 0.2 0.1'/></geometry></collision>"
JOINT = (
    "<joint name='j{0}' type='{1}'><parent link='l{0}'/><child link='l{2}'/>"
    "<origin xyz='0 0 {3}'/><axis xyz='0 1 0'/>"
    "<limit lower='-1' upper='1' effort='1' velocity='1'/></joint>"
)


@pytest.fixture
def urdf(tmp_path):
    """Two plates and a joint that turns, one that slides and one that turns for ever."""

    def write(height=0.4, name="arm.urdf"):
        shapes = (PLATE, "", "", PLATE)
        links = "".join(f"<link name='l{k}'>{shape}</link>" for k, shape in enumerate(shapes))
        kinds = ("revolute", "prismatic", "continuous")
        joints = "".join(JOINT.format(k, kind, k + 1, height) for k, kind in enumerate(kinds))
        path = tmp_path / name
        path.write_text(f"<robot name='r'>{links}{joints}</robot>", encoding="utf-8")
        return path

    return write


def test_a_sound_arm(urdf):
    found = audit(urdf(), np.random.default_rng(1), 100)
    assert (found["loads"], found["joints"], found["prismatic"], found["continuous"]) == (
        True, 3, 1, 1,
    )  # fmt: skip
    assert found["fk"] <= 1e-12
    assert found["outside"] <= 1e-9
    assert (found["home_clear"], found["home_flagged"]) == (True, False)
    assert found["missed"] == 0
    assert found["clear"] + found["missed"] <= 100


def test_wrong_kinematics_and_small_capsules_are_seen(urdf):
    path = urdf()
    arm = load_arm(path)
    q = arm.random_configurations(5, np.random.default_rng(0))
    assert fk_error(urdf(0.5, "taller.urdf"), arm, q) > 0.05

    def smaller():
        made = pin.GeometryModel()
        for one in arm.geometry.geometryObjects:
            solid = coal.Capsule(one.geometry.radius - 0.01, 2.0 * one.geometry.halfLength)
            made.addGeometryObject(
                pin.GeometryObject(one.name, one.parentJoint, one.placement, solid)
            )
        return made

    assert 0.005 < outside(arm.reshaped(smaller)) < 0.011


def test_a_capsule_of_the_radius_of_a_rod_contains_it(tmp_path):
    rod = PLATE.replace("<box size='0.3 0.2 0.1'/>", "<cylinder radius='0.05' length='0.6'/>")
    path = tmp_path / "rod.urdf"
    text = f"<link name='l0'/><link name='l1'>{rod}</link>{JOINT.format(0, 'revolute', 1, 0.4)}"
    path.write_text(f"<robot name='r'>{text}</robot>", encoding="utf-8")
    assert outside(load_arm(path)) <= 1e-12
    # the hull of a round rod is a prism around it
    assert excess(load_arm(path)) == pytest.approx(1.0 + 4.0 / 3.0 * 0.05 / 0.6, rel=0.03)


def test_capsules_are_larger_than_the_parts_in_them(urdf):
    assert 1.2 < excess(load_arm(urdf())) < 3.0


def test_lost_contacts_are_seen(urdf, monkeypatch):
    """With no pair watched, every posture in which the plates touch is missed."""
    monkeypatch.setattr("dualarm_repro.scene.audit._flagged", lambda _, q: np.zeros(len(q), bool))
    found = audit(urdf(0.05), np.random.default_rng(1), 100)
    assert found["missed"] == 100 - found["clear"] > 0
