"""What redundancy leaves open, and what contains the links."""

from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest
from example_robot_data import getModelPath

from dualarm_repro import load_arm
from dualarm_repro.control.controller import VelocityController
from dualarm_repro.control.mesh_containment import mesh_excess
from dualarm_repro.control.redundancy import inertia_weighted, self_motion
from dualarm_repro.control.settings import ControllerSettings
from dualarm_repro.control.simulate import pseudo_inverse

XARM, PANDA = "xarm_description/urdf/xarm7.urdf", "panda_description/urdf/panda.urdf"


def test_self_motion_keeps_the_tips(system, q):
    other = self_motion(system, q)
    np.testing.assert_allclose(system.tips(other), system.tips(q), atol=1e-6)
    assert np.linalg.norm(other - q) > 0.1


def test_inertia_weighted_velocity_meets_the_task_with_the_least_kinetic_energy(system, q):
    controller = VelocityController(system, pseudo_inverse(ControllerSettings()))
    p = controller.problem(q, system.tips(q), np.array([[0.1, 0.0, 0.2], [0.0, -0.1, 0.1]]))
    x, least = inertia_weighted(system, q, p), np.linalg.pinv(p.A) @ p.b
    np.testing.assert_allclose(p.A @ x, p.b, atol=1e-12)
    assert kinetic_energy(system, q, x) < kinetic_energy(system, q, least)
    assert np.linalg.norm(x) > np.linalg.norm(least)


def test_meshes_lie_in_the_capsules_that_enclose_them():
    arm = load_arm("xarm7")
    excess = mesh_excess(arm, urdf(XARM), some_configurations(arm))
    assert len(excess) >= 7
    assert max(excess.values()) <= 1e-4


def test_a_link_that_another_covers_by_chance_sticks_out_elsewhere():
    arm = load_arm("panda")
    folded = mesh_excess(arm, urdf(PANDA), np.zeros((1, 7)))
    found = mesh_excess(arm, urdf(PANDA), some_configurations(arm))
    assert folded["panda_hand_0"] < 0.0
    assert found["panda_hand_0"] == pytest.approx(6.5e-3, abs=1e-4)


def urdf(name):
    return Path(getModelPath(name)) / name


def some_configurations(arm):
    return arm.random_configurations(3, np.random.default_rng(0))


def kinetic_energy(system, q, x):
    """x^T M x / 2 by the sum over the arms, from Pinocchio's own kinetic energy."""
    start, total = system.arrays.start, 0.0
    for k, placed in enumerate(system.arms):
        part = slice(start[k], start[k + 1])
        model = placed.arm.model
        total += pin.computeKineticEnergy(model, model.createData(), q[part], x[part])
    return total


def test_inertia_weighted_velocity_takes_the_whole_symmetric_inertia(system, q):
    """A velocity of the null space is conjugate to it: n^T M x = 0, M by unit velocities."""
    controller = VelocityController(system, pseudo_inverse(ControllerSettings()))
    p = controller.problem(q, system.tips(q), np.array([[0.1, 0.0, 0.2], [0.0, -0.1, 0.1]]))
    x = inertia_weighted(system, q, p)
    null = np.eye(system.nq) - np.linalg.pinv(p.A) @ p.A
    for n in null.T:
        mixed = kinetic_energy(system, q, x + n) - kinetic_energy(system, q, x - n)
        assert mixed == pytest.approx(0.0, abs=1e-12)
