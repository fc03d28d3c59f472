"""Where the links of an arm are, for many configurations: joint frames and capsule cores."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import pinocchio as pin

from ..arguments import checked
from ..arms.arm import Arm
from ..arms.capsules import capsule_ends
from ..arms.chain import SlidingChain
from ..arms.sliding import sliding_frames
from ..copies import copy_rows
from ..kernel import kernel
from ..tracking import kept_with_owner


class Links(NamedTuple):
    """Capsules of an arm: ``joint`` (C,) that carries each (0: the base), core ends ``local``
    (C, 2, 3) in the frame of that joint as :func:`link_frames` has it, and ``radius`` (C,)."""

    names: tuple[str, ...]
    joint: np.ndarray
    local: np.ndarray
    radius: np.ndarray


@checked
@kept_with_owner
def links_of(arm: Arm) -> Links:
    """Capsules of ``arm.geometry``."""
    data = arm.model.createData()
    q = pin.neutral(arm.model)
    pin.forwardKinematics(arm.model, data, q)
    frames = frames_of(arm, np.eye(3, 4), q[np.newaxis])[0]
    shapes = list(arm.geometry.geometryObjects)
    local = np.empty((len(shapes), 2, 3))
    for row, shape in zip(local, shapes, strict=True):
        frame = frames[shape.parentJoint]
        placement = data.oMi[shape.parentJoint] * shape.placement
        for k, end in enumerate(capsule_ends(placement, shape.geometry)):
            row[k] = frame[:, :3].T @ (end - frame[:, 3])
    return Links(
        tuple(shape.name for shape in shapes),
        np.array([shape.parentJoint for shape in shapes], dtype=int),
        local,
        np.array([shape.geometry.radius for shape in shapes], dtype=float),
    )


def in_link_frames(arm: Arm, joint: int, points: np.ndarray) -> np.ndarray:
    """Points (V, 3) given in the frame that the model has of a joint, in that of
    :func:`link_frames`."""
    data, q = arm.model.createData(), pin.neutral(arm.model)
    pin.forwardKinematics(arm.model, data, q)
    frame, pose = frames_of(arm, np.eye(3, 4), q[np.newaxis])[0, joint], data.oMi[joint]
    found: np.ndarray = (points @ pose.rotation.T + pose.translation - frame[:, 3]) @ frame[:, :3]
    return found


def frames_of(arm: Arm, base: np.ndarray, q: np.ndarray) -> np.ndarray:
    """Frames (N, n+1, 3, 4) of the base (3, 4) and the joints of any arm for q (N, n), see
    :func:`link_frames`; a prismatic joint moves its frame along z."""
    chain = arm.motion
    if isinstance(chain, SlidingChain):
        frames: np.ndarray = sliding_frames(chain, base, q)
    else:
        frames = link_frames(chain, base, q)
    return frames


@kernel
def link_frames(chain, base, q):
    """Frames of the base and of the joints, F_0 = base, F_j = F_(j-1) C_(j-1) Rz(q_j).

    C_j are the constant transforms of :class:`dualarm_repro.arms.chain.Chain`; z is the axis of
    every joint.

    Parameters
    ----------
    base : (3, 4)
    q : (N, n) [rad]

    Returns
    -------
    ndarray (N, n+1, 3, 4)
        Rotation and origin in world coordinates.
    """
    frames = np.empty((len(q), q.shape[1] + 1, 3, 4))
    for n in range(len(q)):
        set_frames(chain, base, q[n], frames[n])
    return frames


@kernel
def set_frames(chain, base, q, frames):
    """The frames (n+1, 3, 4) of one configuration (n,) into ``frames``."""
    copy_rows(base, frames[0])
    for j in range(len(q)):
        s, c = np.sin(q[j]), np.cos(q[j])
        C, t = chain.rotation[j], chain.translation[j]
        for r in range(3):
            a, b, d = frames[j, r, 0], frames[j, r, 1], frames[j, r, 2]
            x = a * C[0, 0] + b * C[1, 0] + d * C[2, 0]
            y = a * C[0, 1] + b * C[1, 1] + d * C[2, 1]
            frames[j + 1, r, 0], frames[j + 1, r, 1] = c * x + s * y, c * y - s * x
            frames[j + 1, r, 2] = a * C[0, 2] + b * C[1, 2] + d * C[2, 2]
            frames[j + 1, r, 3] = a * t[0] + b * t[1] + d * t[2] + frames[j, r, 3]


def cores_in(frames: np.ndarray, joint: np.ndarray, local: np.ndarray) -> np.ndarray:
    """The ends (N, C, 2, 3) that :func:`place_cores` fills."""
    ends = np.empty((len(frames), *local.shape))
    place_cores(frames, joint, local, ends, 0)
    return ends


@kernel
def place_cores(frames, joint, local, ends, row):
    """ends = F_joint local, for frames (N, J, 3, 4) and local cores (C, 2, 3), into C rows of
    ``ends`` (N, R, 2, 3) from ``row`` on."""
    for n in range(len(frames)):
        for c in range(len(joint)):
            F = frames[n, joint[c]]
            for k in range(2):
                x, y, z = local[c, k]
                for r in range(3):
                    ends[n, row + c, k, r] = F[r, 0] * x + F[r, 1] * y + F[r, 2] * z + F[r, 3]
