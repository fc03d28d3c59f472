"""The DH tables against what the documents print and what the makers' chains give."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from dualarm_repro.arms import load_arm
from dualarm_repro.arms.robot_file import load_robot_file
from dualarm_repro.datafiles import data_path

GOAL = np.pi * np.array([-1 / 2, -1 / 8, -1 / 2, 1 / 2, 1 / 4, 0])

#: Chains as the makers publish them: origin [m] in the parent, axis; all frames parallel at zero.
CHAINS = {
    "irb120": [
        ((0, 0, 0), "0 0 1"),
        ((0, 0, 0.29), "0 1 0"),
        ((0, 0, 0.27), "0 1 0"),
        ((0, 0, 0.07), "1 0 0"),
        ((0.302, 0, 0), "0 1 0"),
        ((0.072, 0, 0), "1 0 0"),
        (0, 0, 0),
    ],
    "er20-1780": [
        ((0, 0, 0.5), "0 0 -1"),
        ((0.2, 0, 0), "0 1 0"),
        ((0, 0, 0.79), "0 1 0"),
        ((0, 0, 0.14), "-1 0 0"),
        ((0.78, 0, 0), "0 1 0"),
        ((0, 0, 0), "-1 0 0"),
        (0.124, 0, 0),
    ],
    "kr16-2": [
        ((0, 0, 0.675), "0 0 -1"),
        ((0.26, 0, 0), "0 1 0"),
        ((0.68, 0, 0), "0 1 0"),
        ((0.67, 0, -0.035), "-1 0 0"),
        ((0, 0, 0), "0 1 0"),
        ((0, 0, 0), "-1 0 0"),
        (0.158, 0, 0),
    ],
    "irb2400": [
        ((0, 0, 0), "0 0 1"),
        ((0.1, 0, 0.615), "0 1 0"),
        ((0, 0, 0.705), "0 1 0"),
        ((0.258, 0, 0.135), "1 0 0"),
        ((0.497, 0, 0), "0 1 0"),
        ((0.085, 0, 0), "1 0 0"),
        (0, 0, 0),
    ],
    "es165d-public": [
        ((0, 0, 0.65), "0 0 1"),
        ((0.285, 0, 0), "0 1 0"),
        ((0, 0, 1.15), "0 -1 0"),
        ((1.225, 0, 0.25), "-1 0 0"),
        ((0, 0, 0), "0 -1 0"),
        ((0.225, 0, 0), "-1 0 0"),
        (0, 0, 0),
    ],
}
#: Sign of the maker's joints against ours.
SIGNS = {
    "irb120": (1, 1, 1, 1, 1, 1),
    "er20-1780": (-1, 1, 1, -1, 1, -1),
    "kr16-2": (-1, 1, 1, -1, 1, -1),
    "irb2400": (1, 1, 1, 1, 1, 1),
    "es165d-public": (1, 1, -1, -1, -1, -1),
}


def maker_urdf(chain):
    joints = "".join(
        f"<link name='l{k + 1}'/><joint name='j{k + 1}' type='revolute'><parent link='l{k}'/>"
        f"<child link='l{k + 1}'/><origin xyz='{' '.join(map(str, origin))}'/><axis xyz='{axis}'/>"
        "<limit lower='-7' upper='7' effort='1' velocity='1'/></joint>"
        for k, (origin, axis) in enumerate(chain[:-1])
    )
    tool = f"<origin xyz='{' '.join(map(str, chain[-1]))}'/>"
    return (
        f"<robot name='maker'><link name='l0'/>{joints}<link name='tool'/>"
        f"<joint name='fixed' type='fixed'><parent link='l6'/><child link='tool'/>{tool}</joint>"
        "</robot>"
    )


@pytest.mark.parametrize("name", list(CHAINS))
def test_table_equals_the_chain_of_the_maker(name, tmp_path, rng):
    path = tmp_path / "maker.urdf"
    path.write_text(maker_urdf(CHAINS[name]), encoding="utf-8")
    arm, maker = load_arm(name), load_arm(path, shapes="none")
    assert maker.nq == 6
    q = arm.random_configurations(200, rng)
    theirs = q * SIGNS[name]
    if name == "es165d-public":
        theirs[:, 1] += np.pi / 2  # L counts from the upright upper arm
    ours, chain = arm.fk(q), maker.fk(theirs)
    assert_allclose(ours[:, :3, 3], chain[:, :3, 3], atol=1e-12)
    # The tool axis is z in the tables and x in the chains; the rest is one fixed rotation.
    assert_allclose(ours[:, :3, 2], chain[:, :3, 0], atol=1e-12)
    relative = np.swapaxes(ours[:, :3, :3], 1, 2) @ chain[:, :3, :3]
    assert_allclose(relative, np.broadcast_to(relative[0], relative.shape), atol=1e-12)


@pytest.mark.parametrize(
    ("name", "q", "position"),
    [
        ("es165d", np.zeros(6), (1.559, 0.0, -1.450)),
        ("es165d", GOAL, (0.15910, -2.41412, 1.15251)),
        ("es165d-table1", np.zeros(6), (1.559, 0.0, -1.450)),
        ("es165d-table1", GOAL, (0.44410, -2.53371, 0.62534)),
        ("es165d-slave", -GOAL, (0.15910, 2.41412, 1.15251)),
    ],
)
def test_flange_of_the_printed_configurations(name, q, position):
    assert_allclose(load_arm(name).fk(q)[:3, 3], position, atol=5e-6)


def test_limits_of_the_es165d_in_the_zero_of_the_document():
    arm = load_arm("es165d")
    shoulder, upper_arm, forearm = np.radians([(-180, 180), (-60, 76), (-81, 196.5)])
    assert_allclose([arm.lower[0], arm.upper[0]], shoulder)
    assert_allclose([arm.lower[1], arm.upper[1]], upper_arm - np.pi / 2)
    assert_allclose([arm.lower[2], arm.upper[2]], -forearm[::-1])
    assert not arm.within_limits(np.zeros(6)), "the printed start is outside of the real range"
    assert arm.within_limits(GOAL)


def test_stand_in_lies_between_its_neighbours():
    """One third of the way from the iER12-1510 to the ER20-1780-A6, ranges of both."""
    small = {"a": (0, 0.160, 0.615, 0.140, 0, 0), "d": (0.430, 0, 0, 0.739, 0, 0.113)}
    large = load_robot_file(data_path("robots", "er20-1780.yaml")).joints
    er16 = load_robot_file(data_path("robots", "er16.yaml")).joints
    for column, lengths in small.items():
        for joint, length, other in zip(er16, lengths, large, strict=True):
            between = (2 * length + getattr(other, column)) / 3
            assert getattr(joint, column) == pytest.approx(between, abs=5e-5)
    small_ranges = np.radians([170, 90, 155, 145, 85, 200, 135, 360])
    lower = np.maximum(-small_ranges[[0, 1, 3, 5, 6, 7]], load_arm("er20-1780").lower)
    upper = np.minimum(small_ranges[[0, 2, 4, 5, 6, 7]], load_arm("er20-1780").upper)
    assert_allclose(load_arm("er16").lower, lower)
    assert_allclose(load_arm("er16").upper, upper)
