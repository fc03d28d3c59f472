"""Pinocchio model of a DH table.

Every joint of a serial chain is (fixed transform) Rz(q) (fixed transform); the fixed transforms
between two joints are merged into the placement of the second.
"""

from __future__ import annotations

import numpy as np
import pinocchio as pin

from .robot_file import DHRobot, Joint

FLANGE = "flange"


def build_model(robot: DHRobot, name: str) -> pin.Model:
    """Model of the arm with limits, speeds and a frame named ``flange``; it has no inertia."""
    model = pin.Model()
    model.name = name
    after = pin.SE3.Identity()
    parent = 0
    for joint in robot.joints:
        before, following = _around_joint(robot.convention, joint)
        parent = model.addJoint(
            parent,
            pin.JointModelRZ(),
            after * before,
            joint.name,
            np.zeros(1),
            np.array([float(joint.velocity)]),
            np.array([float(joint.lower)]),
            np.array([float(joint.upper)]),
        )
        model.addJointFrame(parent)
        after = following
    if robot.flange:
        rotation = pin.rpy.rpyToMatrix(*map(float, robot.flange.rpy))
        after = after * pin.SE3(rotation, np.array(robot.flange.translation))
    model.addFrame(pin.Frame(FLANGE, parent, after, pin.FrameType.OP_FRAME))
    return model


def _around_joint(convention: str, joint: Joint) -> tuple[pin.SE3, pin.SE3]:
    """Fixed transforms before and after Rz(q) in the link transform of the convention."""
    turn = pin.SE3(pin.utils.rotate("x", float(joint.alpha)), np.array([joint.a, 0.0, 0.0]))
    zero = pin.SE3(pin.utils.rotate("z", float(joint.offset)), np.array([0.0, 0.0, joint.d]))
    if convention == "modified":
        return turn * zero, pin.SE3.Identity()
    offset = pin.SE3(zero.rotation, np.zeros(3))
    shift = pin.SE3(np.eye(3), zero.translation)
    return offset, shift * turn
