"""Scenario files, capsules of arms, arm systems and motions."""

from dataclasses import replace

import numpy as np
import pytest
import yaml

from dualarm_repro import load_arm
from dualarm_repro.control.link_capsules import sticking_out, with_capsules
from dualarm_repro.control.motion import FOLLOWED, JointLimits, Motion
from dualarm_repro.control.scenario import load_scenario
from dualarm_repro.control.system import ArmSystem
from dualarm_repro.datafiles import data_path
from dualarm_repro.errors import ConfigurationError, DataFileError, InputError

FILE = data_path("scenes", "patent_crossing.yaml")
LIMITS = JointLimits(np.full(2, -3.0), np.full(2, 3.0), np.full(2, 8.0))


@pytest.mark.parametrize(
    ("field", "value"),
    [("radius", -0.1), ("duration", "long"), ("base_distance", float("nan")), ("speed", 1.0)],
)
def test_bad_scenario_files_name_the_field(tmp_path, field, value):
    content = yaml.safe_load(FILE.read_text(encoding="utf-8")) | {field: value}
    path = tmp_path / "scene.yaml"
    path.write_text(yaml.safe_dump(content), encoding="utf-8")
    with pytest.raises(DataFileError, match=rf"scene\.yaml: {field}"):
        load_scenario(path)


def test_scenario_file_is_read():
    scenario = load_scenario(FILE)
    assert scenario.robot == "panda"
    assert len(scenario.left.q) == len(scenario.right.q) == 7


def test_contained_capsules_are_left_out_and_radii_replaced():
    arm = load_arm("panda")
    fewer = with_capsules(arm, widened={"panda_hand_0": 0.06}, dropped=["panda_leftfinger_0"])
    names = {g.name: g.geometry.radius for g in fewer.geometry.geometryObjects}
    assert len(names) < len(arm.geometry.geometryObjects)
    assert names["panda_hand_0"] == 0.06
    assert "panda_link2_1" not in names
    assert "panda_leftfinger_0" not in names
    rng = np.random.default_rng(0)
    q = arm.random_configurations(1, rng)[0]
    for g in arm.geometry.geometryObjects:
        if "finger" not in g.name:
            ends = [g.placement.act(np.array([0, 0, s * g.geometry.halfLength])) for s in (-1, 1)]
            assert (
                sticking_out(fewer, q, g.parentJoint, np.array(ends)) <= -g.geometry.radius + 1e-4
            )


def test_added_capsules_and_points_outside():
    arm = load_arm("xarm7")
    wider = with_capsules(arm, added=[("ball", 7, np.zeros(3), np.zeros(3), 0.5)])
    point = np.array([[0.0, 0.0, 0.7]])
    assert sticking_out(wider, np.zeros(7), 7, point) == pytest.approx(0.2)
    assert sticking_out(arm, np.zeros(7), 7, point) > 0.2


@pytest.mark.parametrize("points", [np.empty((0, 3)), np.zeros(3), np.zeros((4, 2))])
def test_nothing_sticks_out_of_what_has_no_points(points):
    line = r"sticking_out: points \(its shape\) = .*: expected finite numbers \(N, 3\), not empty"
    with pytest.raises(InputError, match=line):
        sticking_out(load_arm("xarm7"), np.zeros(7), 7, points)


@pytest.mark.parametrize("q", [np.zeros((1, 7)), np.zeros((7, 1)), 0.0])
def test_points_stick_out_at_one_configuration(q):
    with pytest.raises(InputError, match=r"sticking_out: q \(its shape\) = .*\(n,\)"):
        sticking_out(load_arm("xarm7"), q, 7, np.zeros((1, 3)))


@pytest.mark.parametrize("end", [np.zeros(2), np.zeros((1, 3)), [np.nan] * 3, "origin"])
def test_an_added_capsule_has_two_ends(end):
    for ends in ((end, np.zeros(3)), (np.zeros(3), end)):
        line = r"with_capsules: added\[0\]\[[23]\].* = .*: expected finite numbers \(3,\)"
        with pytest.raises(InputError, match=line):
            with_capsules(load_arm("xarm7"), added=[("ball", 7, *ends, 0.5)])


def test_systems_check_their_input(system, q):
    with pytest.raises(InputError, match="arms"):
        ArmSystem([])
    for wrong in (np.zeros(3), np.full(14, np.inf), np.zeros((2, 14))):
        with pytest.raises(ConfigurationError):
            system.configuration(wrong)
    assert system.nq == 14


def test_motion_measures():
    t = 0.1 * np.arange(21)
    q = np.column_stack([np.sin(2 * np.pi * t), t])
    x = np.diff(q, axis=0) / 0.1
    motion = Motion(
        0.1, t, q, x, np.zeros((21, 2)), np.ones(21), np.zeros(20), np.zeros(20), LIMITS
    )
    assert motion.completed
    assert motion.drift(1.0) == pytest.approx([1.0, 2.0])
    assert motion.peak_speed == pytest.approx(np.abs(x).max())
    assert motion.energy == pytest.approx(0.05 * np.sum(x**2))
    assert motion.peak_acceleration == pytest.approx(np.abs(np.diff(x, axis=0)).max() / 0.1)


@pytest.mark.parametrize(
    ("name", "change"),
    [
        ("angle", {"q": np.array([[0.0, 0.0], [0.0, 3.1], [0.0, 0.0]])}),
        ("angle", {"q": np.array([[-3.2, 0.0], [0.0, 0.0], [0.0, 0.0]])}),
        ("speed", {"x": np.array([[0.0, 0.0], [-8.5, 0.0]])}),
        ("contact", {"distance": np.array([0.1, 0.0, 0.1])}),
        ("path", {"error": np.array([[0.0, 0.0], [0.0, 2 * FOLLOWED], [0.0, 0.0]])}),
    ],
)
def test_a_motion_that_breaks_a_bound_is_not_completed(name, change):
    still = np.zeros((3, 2)), np.zeros((2, 2)), np.zeros((3, 2)), np.ones(3)
    plain = Motion(0.1, 0.1 * np.arange(3), *still, np.zeros(2), np.zeros(2), LIMITS)
    assert plain.completed
    assert plain.speed_excess == -8.0
    found = replace(plain, **change)
    assert found.finished
    assert found.broken == (name,)
    assert not found.completed
    assert not replace(plain, stopped="at once").completed
