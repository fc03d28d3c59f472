"""Exact shapes move no faster than their certified distances rest on."""

import itertools

import numpy as np
import pinocchio as pin
import pytest
from arms.urdf.texts import joint, link, write

from dualarm_repro.arms import load_arm
from dualarm_repro.scene.certificate import reach
from dualarm_repro.scene.exact_shapes import _rates


def arm_of(tmp_path, aside, *kinds):
    """Columns beside the axes of their joints, one of each kind."""
    links = [link(f"l{k}", origin=f"<origin xyz='{aside} 0 0.15'/>") for k in range(len(kinds) + 1)]
    joints = [joint(f"j{k}", f"l{k}", f"l{k + 1}", kind) for k, kind in enumerate(kinds)]
    return load_arm(write(tmp_path, *links, *joints))


def test_a_prismatic_joint_moves_all_of_a_shape_as_far_as_itself(tmp_path):
    arm = arm_of(tmp_path, 0.0, "prismatic")
    assert _rates(arm, arm.solids, [(0, 1)], np.array([0.5])).tolist() == [[1.0]]


@pytest.mark.parametrize("aside", [0.005, 0.3])
def test_a_rim_moves_no_further_than_the_rate_of_its_pair(tmp_path, aside):
    """A column turns about an axis close to its own, or far from it."""
    arm = arm_of(tmp_path, aside, "revolute", "revolute")
    own = reach(arm)[1:].diagonal()
    np.testing.assert_allclose(own, aside, atol=1e-9, err_msg="the core of a column is its axis")
    shapes = arm.solids.geometryObjects
    pairs = list(itertools.combinations(range(len(shapes)), 2))
    rates = _rates(arm, arm.solids, pairs, np.zeros(arm.nq))
    assert rates.shape == (3, 2)
    angles = np.linspace(0.0, 2.0 * np.pi, 16)
    rim = 0.05 * np.array([np.cos(angles), np.sin(angles), np.zeros(16)]).T
    rng = np.random.default_rng(17)
    data, worst = arm.model.createData(), np.zeros_like(rates)
    for q in rng.uniform(-3.0, 3.0, (200, 2)):
        pin.forwardKinematics(arm.model, data, q)
        for row, (first, second) in zip(worst, pairs, strict=True):
            low, high = (shapes[k].parentJoint for k in (first, second))
            points = np.array([(data.oMi[high] * shapes[second].placement).act(p) for p in rim])
            for k in range(low, high):  # the joints between the two shapes
                centre, axis = data.oMi[k + 1].translation, data.oMi[k + 1].rotation[:, 2]
                lever = np.linalg.norm(np.cross(axis, points - centre), axis=1).max()
                row[k] = max(row[k], lever)
    assert np.all(worst <= rates + 1e-12)
    assert np.all((rates > 0.0) == (worst > 0.0))
