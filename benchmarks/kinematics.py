"""Kinematics of one arm: forward, Jacobian, manipulability, inverse, workspace."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from importlib.util import find_spec

import numba
import numpy as np
import pinocchio as pin
from timing import OURS, Row, timed

from dualarm_repro import load_arm
from dualarm_repro.arms import Arm
from dualarm_repro.arms.dh_model import FLANGE
from dualarm_repro.arms.workspace import sample_workspace

NAME = "irb120"
BATCH, LOOP, POINTS = 100_000, 2_000, 100_000
POSE, JACOBIAN = "pose of the flange", "Jacobian"
MEASURE = "manipulability by the Jacobian"
INVERSE, CLOUD = "inverse kinematics, all branches", "cloud of 100 000 flange positions"


def measure() -> Iterator[Row]:
    """Rows of this suite; peers that are not installed are left out."""
    arm, rng = load_arm(NAME), np.random.default_rng(0)
    q = arm.random_configurations(BATCH, rng)
    few = q[:LOOP]
    poses = arm.fk(few)
    yield timed(POSE, OURS, lambda: arm.fk(q), BATCH)
    yield timed(POSE, f"{OURS}, one at a time", lambda: [arm.fk(row) for row in few], LOOP)
    yield timed(POSE, "memory alone: read q, write poses", _touch(q), BATCH)
    yield timed(JACOBIAN, OURS, lambda: arm.jacobian(q), BATCH)
    yield timed(
        JACOBIAN, f"{OURS}, one at a time", lambda: [arm.jacobian(row) for row in few], LOOP
    )
    yield timed(MEASURE, OURS, lambda: arm.manipulability(q), BATCH)
    yield timed(
        MEASURE, f"{OURS}, one at a time", lambda: [arm.manipulability(row) for row in few], LOOP
    )
    yield from _pinocchio(arm, few)
    yield timed(INVERSE, OURS, lambda: arm.ik_branches(poses), LOOP)
    yield timed(INVERSE, f"{OURS}, one at a time", lambda: [arm.ik(T) for T in poses], LOOP)
    if find_spec("roboticstoolbox"):
        yield from _roboticstoolbox(few)
    if find_spec("eaik"):
        yield from _eaik(arm, poses)
    yield timed(CLOUD, OURS, lambda: sample_workspace(arm, POINTS, rng), 1)
    yield timed(CLOUD, "pinocchio, Python loop", _cloud_by_loop(arm, rng), 1)


def _touch(q: np.ndarray) -> Callable[[], np.ndarray]:
    """Reads every configuration and writes every pose, and computes a sum only."""

    @numba.njit
    def touch(flat: np.ndarray, joints: int) -> np.ndarray:
        out = np.empty((len(flat) // joints, 16))
        for k in range(len(out)):
            total = 0.0
            for j in range(joints):
                total += flat[joints * k + j]
            for e in range(16):
                out[k, e] = total
        return out

    return lambda: touch(q.reshape(-1), q.shape[1])


def _pinocchio(arm: Arm, q: np.ndarray) -> Iterator[Row]:
    model, data, flange = arm.model, arm.model.createData(), arm.model.getFrameId(FLANGE)
    axes = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED

    def pose() -> None:
        for row in q:
            pin.forwardKinematics(model, data, row)
            pin.updateFramePlacement(model, data, flange)

    def jacobian() -> None:
        for row in q:
            pin.computeFrameJacobian(model, data, row, flange, axes)

    def measure() -> list[float]:
        jacobians = (pin.computeFrameJacobian(model, data, row, flange, axes) for row in q)
        return [abs(np.linalg.det(one)) for one in jacobians]

    np.testing.assert_allclose(measure(), arm.manipulability(q), atol=1e-12)
    yield timed(POSE, "pinocchio, Python loop", pose, len(q))
    yield timed(JACOBIAN, "pinocchio, Python loop", jacobian, len(q))
    yield timed(MEASURE, "pinocchio, Python loop", measure, len(q))


def _roboticstoolbox(q: np.ndarray) -> Iterator[Row]:
    import roboticstoolbox as rtb

    from dualarm_repro.arms.robot_file import load_robot_file
    from dualarm_repro.datafiles import data_path

    table = load_robot_file(data_path("robots", f"{NAME}.yaml"))
    links = [
        rtb.RevoluteDH(d=j.d, a=j.a, alpha=float(j.alpha), offset=float(j.offset))
        for j in table.joints
    ]
    ets = rtb.DHRobot(links).ets().compile()
    np.testing.assert_allclose(ets.eval(q), load_arm(NAME).fk(q), atol=1e-9)
    yield timed(POSE, "roboticstoolbox ETS", lambda: ets.eval(q), len(q))
    yield timed(JACOBIAN, "roboticstoolbox ETS", lambda: [ets.jacob0(row) for row in q], len(q))
    yield timed(
        MEASURE,
        "roboticstoolbox ETS",
        lambda: [abs(np.linalg.det(ets.jacob0(row))) for row in q],
        len(q),
    )


def _eaik(arm: Arm, poses: np.ndarray) -> Iterator[Row]:
    from eaik.IK_HP import HPRobot

    zero, data = np.zeros(arm.nq), arm.model.createData()
    pin.forwardKinematics(arm.model, data, zero)
    axes = np.array([frame.rotation[:, 2] for frame in list(data.oMi)[1:]])
    steps = np.diff(arm.joint_positions(zero), axis=0, prepend=np.zeros((1, 3)))
    robot = HPRobot(axes, steps)
    # Its flange frame is parallel to the base at q = 0.
    targets = poses.copy()
    targets[:, :3, :3] = poses[:, :3, :3] @ arm.fk(zero)[:3, :3].T
    found = robot.IK(targets[0]).Q
    np.testing.assert_allclose(
        arm.fk(found), np.broadcast_to(poses[0], (len(found), 4, 4)), atol=1e-6
    )
    yield timed(INVERSE, "EAIK", lambda: robot.IK_batched(list(targets)), len(targets))
    yield timed(
        INVERSE, "EAIK, one at a time", lambda: [robot.IK(T) for T in targets], len(targets)
    )


def _cloud_by_loop(arm: Arm, rng: np.random.Generator) -> Callable[[], np.ndarray]:
    model, data, flange = arm.model, arm.model.createData(), arm.model.getFrameId(FLANGE)

    def cloud() -> np.ndarray:
        points = np.empty((POINTS, 3))
        for k, row in enumerate(arm.random_configurations(POINTS, rng)):
            pin.forwardKinematics(model, data, row)
            points[k] = pin.updateFramePlacement(model, data, flange).translation
        return points

    return cloud
