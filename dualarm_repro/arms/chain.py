"""A serial chain: constant transforms C_0 ... C_n in which every joint axis is z."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import pinocchio as pin

from ..errors import UnsupportedArmError

_Z = np.array([0.0, 0.0, 1.0])


class Chain(NamedTuple):
    """T(q) = C_0 Rz(q_1) C_1 ... Rz(q_n) C_n: ``rotation`` (n+1, 3, 3) and ``translation``
    (n+1, 3) [m] of C_0 ... C_n."""

    rotation: np.ndarray
    translation: np.ndarray


class SlidingChain(NamedTuple):
    """Constant transforms as in :class:`Chain`, and which joints slide, Tz(q) for Rz(q): ``slides``
    (n,) of bool."""

    rotation: np.ndarray
    translation: np.ndarray
    slides: np.ndarray


def chain_of(name: str, model: pin.Model, flange: int) -> Chain | SlidingChain:
    """T(q) = C_0 M(q_1) C_1 ... M(q_n) C_n of the chain from the base to the flange.

    M is Rz(q), or Tz(q) for a joint that slides. The frame of each joint is turned so that its axis
    is z; its origin stays.

    Raises
    ------
    UnsupportedArmError
        The model is no serial chain of joints that turn or slide, or the flange is not on its last
        link.
    """
    n = model.njoints - 1
    serial = list(model.parents)[1:] == list(range(n))
    if not serial or model.nq != n or model.nv != n or model.frames[flange].parentJoint != n:
        raise UnsupportedArmError(
            f"arm {name}: not a serial chain of revolute or prismatic joints to the flange"
        )
    data = model.createData()
    pin.computeJointJacobians(model, data, pin.neutral(model))
    constants, slides = [], []
    turn = np.eye(3)
    for joint in range(1, n + 1):
        jacobian = pin.getJointJacobian(model, data, joint, pin.ReferenceFrame.LOCAL)
        column = jacobian.reshape(6, n)[:, joint - 1]  # Pinocchio drops the axis of a single joint
        slides.append(not np.any(column[3:]))
        axis = column[:3] if slides[-1] else column[3:]
        if not np.isclose(np.linalg.norm(axis), 1.0):
            joint_name = model.names[joint]
            raise UnsupportedArmError(f"arm {name}: joint {joint_name} neither turns nor slides")
        placement = model.jointPlacements[joint]
        following = pin.Quaternion.FromTwoVectors(_Z, axis).matrix()
        constants.append((turn.T @ placement.rotation @ following, turn.T @ placement.translation))
        turn = following
    placement = model.frames[flange].placement
    constants.append((turn.T @ placement.rotation, turn.T @ placement.translation))
    rotation, translation = zip(*constants, strict=True)
    if any(slides):
        return SlidingChain(np.array(rotation), np.array(translation), np.array(slides))
    return Chain(np.array(rotation), np.array(translation))
