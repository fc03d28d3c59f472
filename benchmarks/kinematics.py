"""Kinematics of one arm: forward, Jacobian, manipulability, inverse, workspace."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from importlib.util import find_spec

import numpy as np
import pinocchio as pin
from equal_work import holds, reference, same
from robots import toolbox_chain
from timing import OURS, Row, timed

from dualarm_repro import load_arm
from dualarm_repro.arms import Arm
from dualarm_repro.arms.dh_model import FLANGE
from dualarm_repro.arms.workspace import sample_workspace

NAME = "irb120"
BATCH, SOME, LOOP, POINTS = 100_000, 20_000, 2_000, 100_000
CHECKED = 200  # poses whose branches are compared with those of a peer
POSE, JACOBIAN = "pose of the flange", "Jacobian and manipulability"
RESIDUAL = 1e-10  # of a pose that an inverse gives [m], [1]
INVERSE, CLOUD = "inverse kinematics, all branches", "cloud of 100 000 flange positions"


def measure() -> Iterator[Row]:
    """Rows of this suite; peers that are not installed are left out."""
    arm, rng = load_arm(NAME), np.random.default_rng(0)
    q = arm.random_configurations(BATCH, rng)
    some, few = q[:SOME], q[:LOOP]
    poses = arm.fk(few)
    yield timed(POSE, OURS, lambda: arm.fk(q), BATCH, check=reference())
    yield timed(POSE, f"{OURS}, one at a time", lambda: [arm.fk(row) for row in few], LOOP)
    yield timed(
        *(JACOBIAN, OURS, lambda: (arm.jacobian(some), arm.manipulability(some)), SOME),
        check=reference(),
    )
    yield from _pinocchio(arm, few)
    exact = holds(
        f"every branch reaches its pose to {RESIDUAL:.0e}",
        lambda: _residual(arm, poses) <= RESIDUAL,
    )
    yield timed(INVERSE, OURS, lambda: arm.ik_branches(poses), LOOP, check=exact)
    yield timed(INVERSE, f"{OURS}, one at a time", lambda: [arm.ik(T) for T in poses], LOOP)
    if find_spec("roboticstoolbox"):
        yield from _roboticstoolbox(arm, few)
    if find_spec("eaik"):
        yield from _eaik(arm, poses)
    yield timed(CLOUD, OURS, lambda: sample_workspace(arm, POINTS, rng), 1)
    yield timed(CLOUD, "pinocchio, Python loop", _cloud_by_loop(arm, rng), 1)


def _residual(arm: Arm, poses: np.ndarray) -> float:
    """max |T(q) - T| over all branches of all poses; infinite for a pose without one."""
    branches = arm.ik_branches(poses)
    found = np.isfinite(branches).all(axis=2)
    if not found.any(axis=1).all():
        return np.inf
    targets = np.broadcast_to(poses[:, None], (*found.shape, 4, 4))
    return float(np.abs(arm.fk(branches[found]) - targets[found]).max())


def _pinocchio(arm: Arm, q: np.ndarray) -> Iterator[Row]:
    model, data, flange = arm.model, arm.model.createData(), arm.model.getFrameId(FLANGE)
    axes = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED

    def pose() -> np.ndarray:
        out = np.empty((len(q), 4, 4))
        for k, row in enumerate(q):
            pin.forwardKinematics(model, data, row)
            out[k] = pin.updateFramePlacement(model, data, flange).homogeneous
        return out

    def jacobian() -> tuple[np.ndarray, np.ndarray]:
        out, measure = np.empty((len(q), 6, model.nv)), np.empty(len(q))
        for k, row in enumerate(q):
            out[k] = pin.computeFrameJacobian(model, data, row, flange, axes)
            measure[k] = abs(np.linalg.det(out[k]))
        return out, measure

    yield timed(
        *(POSE, "pinocchio, Python loop", pose, len(q)),
        check=same(lambda: arm.fk(q), pose, 1e-9),
    )
    yield timed(
        *(JACOBIAN, "pinocchio, Python loop", jacobian, len(q)),
        check=same(
            lambda: _flat(arm.jacobian(q), arm.manipulability(q)), lambda: _flat(*jacobian()), 1e-9
        ),
    )


def _flat(jacobian: np.ndarray, measure: np.ndarray) -> np.ndarray:
    """Jacobian and manipulability of each configuration in one row."""
    return np.hstack([jacobian.reshape(len(measure), -1), measure[:, None]])


def _roboticstoolbox(arm: Arm, q: np.ndarray) -> Iterator[Row]:
    ets = toolbox_chain(arm)

    def jacobian() -> tuple[np.ndarray, np.ndarray]:
        found = np.stack([ets.jacob0(row) for row in q])
        return found, np.array([abs(np.linalg.det(one)) for one in found])

    name = "roboticstoolbox ETS"
    yield timed(
        *(POSE, name, lambda: ets.eval(q), len(q)),
        check=same(lambda: arm.fk(q), lambda: ets.eval(q), 1e-9),
    )
    yield timed(
        *(JACOBIAN, name, jacobian, len(q)),
        check=same(
            lambda: _flat(arm.jacobian(q), arm.manipulability(q)), lambda: _flat(*jacobian()), 1e-9
        ),
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
    listed = list(targets)
    check = holds(
        "the same branches within the limits",
        lambda: all(
            _same_branches(arm, arm.ik(pose), robot.IK(target).Q)
            for pose, target in zip(poses[:CHECKED], targets, strict=False)
        ),
    )
    yield timed(INVERSE, "EAIK", lambda: robot.IK_batched(listed), len(targets), check=check)
    yield timed(
        INVERSE, "EAIK, one at a time", lambda: [robot.IK(T) for T in targets], len(targets)
    )


def _same_branches(arm: Arm, ours: np.ndarray, theirs: np.ndarray) -> bool:
    """Whether each of our branches is one of theirs, turned by whole turns, and the other way round
    for those of theirs that have a place within the limits."""
    lower, upper = arm.limits()
    turned = theirs - 2 * np.pi * np.ceil((theirs - upper) / (2 * np.pi))  # the highest below upper
    inside = (turned >= lower - 1e-9).all(axis=1)
    apart = np.abs(np.exp(1j * ours[:, None]) - np.exp(1j * theirs[None])).max(axis=2)
    return bool((apart.min(axis=1) < 1e-6).all() and (apart[:, inside].min(axis=0) < 1e-6).all())


def _cloud_by_loop(arm: Arm, rng: np.random.Generator) -> Callable[[], np.ndarray]:
    model, data, flange = arm.model, arm.model.createData(), arm.model.getFrameId(FLANGE)

    def cloud() -> np.ndarray:
        points = np.empty((POINTS, 3))
        for k, row in enumerate(arm.random_configurations(POINTS, rng)):
            pin.forwardKinematics(model, data, row)
            points[k] = pin.updateFramePlacement(model, data, flange).translation
        return points

    return cloud
