"""Joint vectors for a wanted position of the flange and direction of the tool."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ...arguments import checked
from ...arms.poses import homogeneous
from ...errors import InputError
from ...scene import PlacedArm, facing
from ...scene.configuration_entry import Elbow, Tool
from ...scene.quantities import unit3, vector3
from ..field.control_points import end_effector
from .tip_goal import REACHED, nearest_posture

_UP, _AHEAD = np.array([0.0, 0.0, 1.0]), np.array([1.0, 0.0, 0.0])


@checked
def posture(
    placed: PlacedArm,
    position: ArrayLike,
    tool: Tool | ArrayLike,
    *,
    elbow: Elbow | None = None,
    last_joint: float = 0.0,
    reference: ArrayLike | None = None,
) -> np.ndarray:
    """q with X(q) = position and the axis of the last joint along ``tool``, for a spherical wrist.

    Of the branches with that elbow the one nearest to the reference is taken, by Euclidean norm.

    Parameters
    ----------
    position : (3,)
        In the world [m].
    tool : "radial", "down" or (3,)
        Horizontal and away from the first axis; against the world's z; a direction in the world.
    elbow : "up" or "down", optional
        Whether joint 3 is the higher or the lower one of the two branches that differ in it only.
    last_joint : float
        [rad]; it turns the tool about its own axis.
    reference : (nq,), optional
        Default: all zero.

    Returns
    -------
    ndarray (nq,)

    Raises
    ------
    InputError
        Out of reach, by how much; or within reach, but not with this tool direction.
    UnsupportedArmError
        The arm has no closed form.
    """
    target = vector3(f"arm {placed.name}", "position", position)
    near = np.zeros(placed.arm.nq) if reference is None else placed.arm.configurations(reference)
    axis = tool_direction(placed, target, tool)
    upright = facing(axis, _UP if abs(axis[2]) < 0.9 else _AHEAD)
    flange = homogeneous(upright @ placed.arm.chain.rotation[-1], target)
    pose = placed.placement.inverse().homogeneous @ flange
    branches = placed.arm.ik_branches(pose[np.newaxis], reference=near, within_limits=False)[0]
    branches[:, -1] = np.where(np.isnan(branches[:, 0]), np.nan, last_joint)
    if elbow is not None:
        branches = _with_elbow(placed, branches, elbow)
    found = branches[~np.isnan(branches).any(axis=1)]
    miss = np.linalg.norm(end_effector(placed, found) - target, axis=1)
    found = found[miss < REACHED]
    if not len(found):
        raise _unreachable(placed, target, tool, near)
    return found[np.linalg.norm(found - near, axis=1).argmin()]


def _unreachable(
    placed: PlacedArm, target: np.ndarray, tool: object, near: np.ndarray
) -> InputError:
    """What is wrong: the position, by how much, or only the direction of the tool."""
    source, missing = f"arm {placed.name}", nearest_posture(placed, target, near).residual
    if missing > REACHED:
        expected = f"a position within reach; this one is out of reach by {missing:.4f} m"
        return InputError(source, "position", target.tolist(), expected)
    expected = "a direction that the arm can turn its tool to at this position"
    return InputError(source, "tool", tool, expected)


def tool_direction(placed: PlacedArm, target: np.ndarray, tool: Tool | ArrayLike) -> np.ndarray:
    """Unit vector (3,) in the world along which the last joint of an arm at ``target`` points."""
    if isinstance(tool, str):
        if tool == "down":
            return -_UP
        axis = placed.placement.rotation[:, 2]
        offset = target - placed.placement.translation
        tool = offset - (offset @ axis) * axis
    return unit3(f"arm {placed.name}", "tool", tool)


def _with_elbow(placed: PlacedArm, branches: np.ndarray, elbow: Elbow) -> np.ndarray:
    """Of each two branches that differ in the elbow, the one with joint 3 higher or lower."""
    height = np.full(8, np.nan)
    there = ~np.isnan(branches).any(axis=1)
    origins = placed.arm.joint_positions(branches[there])[:, 2]
    height[there] = origins @ placed.placement.rotation[2]
    kept = branches.copy()
    for k in range(8):
        other = height[k ^ 2]
        worse = other > height[k] if elbow == "up" else other < height[k]
        if worse:
            kept[k] = np.nan
    return kept
