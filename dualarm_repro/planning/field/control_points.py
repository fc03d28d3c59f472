"""Control points: what of an arm the obstacles repel.

A control point is the core of a capsule fixed to a link. Its ends coincide for a point in the
strict sense; the same formulas serve whole links and, with a radius, the capsules of collision
checks.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, get_args

import numpy as np
from numpy.typing import ArrayLike

from ...arguments import checked
from ...arms import Arm
from ...errors import InputError, UnknownNameError
from ...scene import posing
from ...scene.bodies import PlacedArm
from ...scene.posing import Links, cores_in, links_of
from ..settings import PointSet


class ControlPoints(NamedTuple):
    """K cores on an arm, from the base to the flange.

    Attributes
    ----------
    names : tuple of str
    joint : ndarray (K,) of int
        Joint whose frame carries the core; 0 is the base.
    local : ndarray (K, 2, 3)
        Ends in that frame [m].
    radius : ndarray (K,)
        [m]
    weight : ndarray (K,)
        Factor of its repulsive potential.
    """

    names: tuple[str, ...]
    joint: np.ndarray
    local: np.ndarray
    radius: np.ndarray
    weight: np.ndarray


@checked
def control_points(
    arm: Arm,
    choice: PointSet | Sequence[int],
    weights: Sequence[float] | None = None,
    radius: float | None = None,
) -> ControlPoints:
    """Control points of an arm by the name of their set or by frame numbers.

    ``frames_a_b`` are the origins of joint frames a ... b, ``five_links`` the segments between the
    origins of frames 1 ... 6, ``end_effector`` the flange, ``capsules`` the links as collision
    checks see them. Frame number nq + 1 is the flange.

    Parameters
    ----------
    weights : sequence of K, optional
        Default: all one.
    radius : float, optional
        For every point [m]; default 0, or the radii of the capsules.

    Raises
    ------
    InputError
        A frame the arm does not have, or as many weights as there are no points.
    """
    if choice == "capsules":
        names, joint, local, radii = links_of(arm)
    elif choice == "five_links":
        names, joint, local, radii = _links(arm, range(1, 6))
    elif isinstance(choice, str):
        named = {"end_effector": [arm.nq + 1], "frames_2_6": range(2, 7), "frames_1_5": range(1, 6)}
        if choice not in named:
            known = f"one of {', '.join(get_args(PointSet))}"
            raise UnknownNameError(f"arm {arm.name}", "control points", choice, known)
        names, joint, local, radii = _origins(arm, named[choice])
    else:
        names, joint, local, radii = _origins(arm, choice)
    if radius is not None:
        radii = np.full(len(names), radius)
    weight = np.ones(len(names)) if weights is None else np.array(weights, dtype=float)
    if len(weight) != len(names):
        expected = f"{len(names)} weights, one for each of {', '.join(names)}"
        raise InputError(f"arm {arm.name}", "weights", weights, expected)
    order = np.argsort(joint, kind="stable")
    names = tuple(names[k] for k in order)
    return ControlPoints(names, joint[order], local[order], radii[order], weight[order])


def ends_of(placed: PlacedArm, points: ControlPoints | Links, q: np.ndarray) -> np.ndarray:
    """Ends of the cores in the world for configurations (N, nq), (N, K, 2, 3) [m]."""
    return cores_in(frames_of(placed, q), points.joint, points.local)


def frames_of(placed: PlacedArm, q: np.ndarray) -> np.ndarray:
    """Frames of base and joints in the world for configurations (N, nq), (N, nq + 1, 3, 4)."""
    return posing.frames_of(placed.arm, base_of(placed), q)


def base_of(placed: PlacedArm) -> np.ndarray:
    """Upper part (3, 4) of the pose of the base."""
    return np.ascontiguousarray(placed.placement.homogeneous[:3])


def end_effector(placed: PlacedArm, q: ArrayLike) -> np.ndarray:
    """X(q), the flange in the world [m], (nq,) -> (3,) or (N, nq) -> (N, 3)."""
    placement = placed.placement
    return placed.arm.positions(q) @ placement.rotation.T + placement.translation


def _origins(arm: Arm, frames: Sequence[int]) -> tuple:
    """The origin of frame k is fixed to the link before it: frame k - 1 carries it."""
    frame = np.array(_checked(arm, frames), dtype=np.int64)
    origin = arm.chain.translation[frame - 1]
    local = np.repeat(origin[:, np.newaxis], 2, axis=1)
    names = tuple("flange" if k > arm.nq else f"frame_{k}" for k in frame)
    return names, frame - 1, local, np.zeros(len(frame))


def _links(arm: Arm, frames: Sequence[int]) -> tuple:
    """The segment from the origin of frame k to that of frame k + 1, both fixed to link k."""
    frame = np.array(_checked(arm, frames), dtype=np.int64)
    local = np.zeros((len(frame), 2, 3))
    local[:, 1] = arm.chain.translation[frame]
    return tuple(f"link_{k}" for k in frame), frame, local, np.zeros(len(frame))


def _checked(arm: Arm, frames: Sequence[int]) -> list[int]:
    known = range(1, arm.nq + 2)
    for frame in frames:
        if frame not in known:
            expected = f"a frame from 1 to {arm.nq + 1}, the flange"
            raise InputError(f"arm {arm.name}", "control point", frame, expected)
    return list(frames)
