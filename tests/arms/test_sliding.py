"""Arms with prismatic joints: kinematics, distances of a scene, and what refuses them."""

import numpy as np
import pinocchio as pin
import pytest
from numpy.testing import assert_allclose

from dualarm_repro.arms import load_arm
from dualarm_repro.arms.reach import largest_reach
from dualarm_repro.differences import central_differences
from dualarm_repro.errors import ConfigurationError, UnsupportedArmError
from dualarm_repro.scene import PlacedArm, Scene, Sphere, clearance_gradient, distances
from dualarm_repro.scene.certificate import certified_minimum

from .urdf.texts import joint, link, write

LIFT = "<limit lower='0' upper='0.4' effort='1' velocity='1'/>"
RANGE = "<limit lower='-0.3' upper='0.4' effort='1' velocity='1'/>"


@pytest.fixture
def arm(tmp_path):
    """Turn, slide, turn, slide, turn, turn, turn."""
    names = [f"l{k}" for k in range(8)]
    kinds = ["revolute", "prismatic", "revolute", "prismatic", *["revolute"] * 3]
    axes = ["0 0 1", "0 0.6 0.8", "0 1 0", "1 0 0", "0 1 0", "1 0 0", "0 0 1"]
    joints = [
        joint(f"j{k}", names[k], names[k + 1], kind, axis, *([RANGE] if "p" in kind else []))
        for k, (kind, axis) in enumerate(zip(kinds, axes, strict=True))
    ]
    return load_arm(write(tmp_path, *map(link, names), *joints), shapes="enclosing")


def test_kernels_against_pinocchio(arm, rng):
    q = arm.random_configurations(20, rng)
    data = arm.model.createData()
    J, origins = arm.jacobian(q), arm.joint_positions(q)
    for row, jacobian, origin in zip(q, J, origins, strict=True):
        assert_allclose(arm.jacobian(row), jacobian, atol=1e-14)
        pin.forwardKinematics(arm.model, data, row)
        places = [data.oMi[k].translation for k in range(1, 8)]
        assert_allclose(origin[:-1], places, atol=1e-14)
        assert_allclose(origin[-1], arm.fk(row)[:3, 3], atol=1e-14)
        assert_allclose(arm.manipulability(row), arm.manipulability(row[None])[0], rtol=1e-9)
    by_differences = central_differences(lambda row: arm.positions(row), q[0], 1e-6)
    assert_allclose(by_differences.T, J[0, :3], atol=1e-8)


def test_distances_and_their_gradient(arm, rng):
    placed = PlacedArm("a", arm, pin.SE3(pin.rpy.rpyToMatrix(0.2, 0.1, -0.5), np.ones(3)))
    scene = Scene([placed], {"ball": Sphere((1.5, 1.2, 2.0), 0.1)})
    q = arm.random_configurations(5, rng)
    found, gradient = clearance_gradient(scene, q)
    for row, slope in zip(q, gradient, strict=True):
        numeric = central_differences(lambda x: distances(scene, x), row, 1e-6)
        assert_allclose(slope, numeric.T, atol=1e-6)
    assert_allclose(found.distance, [distances(scene, row) for row in q])


def test_a_lift_stands_where_it_says(tmp_path):
    """A ball 1 m above a rod that is lifted by 0.25 m: 1 - 0.25 - 0.3 - 0.1 - 0.05 by hand."""
    text = joint("up", "b", "l1", "prismatic", limit=LIFT)
    rod = link("l1", "<capsule radius='0.05' length='0.3'/>")
    path = write(tmp_path, link("b", None), rod, text.replace("rpy='0.1 0.2 0.3'", "rpy='0 0 0'"))
    scene = Scene([PlacedArm("a", load_arm(path))], {"ball": Sphere((0, 0, 1.3), 0.1)})
    assert_allclose(distances(scene, [0.25]).min(), 1.0 - 0.25 - 0.3 - 0.1 - 0.05, atol=1e-12)


def test_the_certificate_holds_between_samples(arm, rng):
    scene = Scene([PlacedArm("a", arm)], {"ball": Sphere((0.4, 0.3, 1.2), 0.1)})
    for _ in range(3):
        path = arm.random_configurations(2, rng)
        found = certified_minimum(scene, path, tolerance=5e-3)
        share = np.linspace(0, 1, 2001)[:, None]
        dense = distances(scene, path[0] + share * (path[1] - path[0])).min()
        assert found.lower <= dense <= found.upper + 1e-5
        assert found.upper - found.lower <= 5e-3 + 1e-12


def test_what_knows_turning_joints_only_refuses(arm):
    with pytest.raises(UnsupportedArmError, match=r"joint j1 is prismatic.*lock=\{'j1'"):
        _ = arm.chain
    with pytest.raises(UnsupportedArmError, match="prismatic"):
        arm.ik(np.eye(4))
    with pytest.raises(UnsupportedArmError, match="prismatic"):
        largest_reach(arm, np.random.default_rng(0), 10)
    with pytest.raises(ConfigurationError, match=r"\[rad, m for prismatic joints\]"):
        arm.fk([0.0])
