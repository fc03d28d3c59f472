import numpy as np
import pinocchio as pin
import pytest

from dualarm_repro.arms import load_arm
from dualarm_repro.scene.posing import link_frames, links_of, place_cores
from examples import random_placement


def cores_by_pinocchio(arm, base, q):
    """Core ends of the capsules in the world, one configuration, from Pinocchio's placements."""
    data, geometry_data = arm.model.createData(), arm.geometry.createData()
    pin.updateGeometryPlacements(arm.model, data, arm.geometry, geometry_data, q)
    ends = []
    for placement, shape in zip(geometry_data.oMg, arm.geometry.geometryObjects, strict=True):
        half = np.array([0, 0, shape.geometry.halfLength])
        ends.append([(base * placement).act(-half), (base * placement).act(half)])
    return np.array(ends)


@pytest.mark.parametrize("name", ["irb120", "es165d-slave", "panda", "ur5"])
def test_cores_are_where_pinocchio_has_them(name):
    rng = np.random.default_rng(0)
    arm, base = load_arm(name), random_placement(rng)
    q = arm.random_configurations(50, rng)
    links = links_of(arm)
    assert links.names == tuple(shape.name for shape in arm.geometry.geometryObjects)
    ends = np.empty((50, len(links.names), 2, 3))
    place_cores(link_frames(arm.chain, base.homogeneous[:3], q), links.joint, links.local, ends, 0)
    for row, configuration in zip(ends, q, strict=True):
        expected = cores_by_pinocchio(arm, base, configuration)
        np.testing.assert_allclose(row, expected, atol=1e-12)


def test_frames_have_the_joint_axes_and_origins():
    rng = np.random.default_rng(1)
    arm = load_arm("irb2400")
    q = arm.random_configurations(20, rng)
    frames = link_frames(arm.chain, np.eye(3, 4), q)
    np.testing.assert_allclose(frames[:, 1:, :, 3], arm.joint_positions(q)[:, :-1], atol=1e-12)
    jacobian = arm.jacobian(q)
    np.testing.assert_allclose(frames[:, 1:, :, 2], np.swapaxes(jacobian[:, 3:], 1, 2), atol=1e-12)
    rotation = frames[..., :3]
    identity = np.broadcast_to(np.eye(3), rotation.shape)
    np.testing.assert_allclose(rotation @ np.swapaxes(rotation, -1, -2), identity, atol=1e-12)


def test_no_index_leaves_an_array():
    """Compiled code checks no bounds; the same code in Python does."""
    rng = np.random.default_rng(2)
    arm, base = load_arm("panda"), random_placement(rng).homogeneous[:3]
    q, links = arm.random_configurations(2, rng), links_of(arm)
    frames = link_frames.py_func(arm.chain, base, q)
    np.testing.assert_allclose(frames, link_frames(arm.chain, base, q), atol=1e-14)
    checked, compiled = np.empty((2, 2, len(links.names), 2, 3))
    place_cores.py_func(frames, links.joint, links.local, checked, 0)
    place_cores(frames, links.joint, links.local, compiled, 0)
    np.testing.assert_allclose(checked, compiled, atol=1e-14)
