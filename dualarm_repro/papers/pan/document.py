"""What `pan` prints of its cell, read from the ledger, and the arm that stands in for its robot."""

from __future__ import annotations

from typing import Any

import numpy as np

from ...arms import Arm
from ...arms.robot_file import DHRobot, load_robot_file
from ...datafiles import data_path
from ...errors import UnknownNameError, UnsupportedArmError
from ...ledger.printed_values import printed_numbers
from ...tracking import memo
from ...welding import base_poses

SEED = 17
BASES = ("base1", "base2", "base3")
_ORIENTATIONS = ("identity", "facing_workpiece")


def printed_optimum() -> np.ndarray:
    """C as printed (3,) [m]."""
    return printed_numbers("pan.claim_optimum", "C")


def printed_bases() -> np.ndarray:
    """Positions of the three bases as printed (3, 3) [m]."""
    return printed_numbers("pan.claim_bases", *BASES)


def printed_base_matrix() -> np.ndarray:
    """The one matrix printed for base 1 (4, 4)."""
    return printed_numbers("pan.eq_base", "matrix")


def placed_bases(reading: str, orientation: str) -> np.ndarray:
    """Poses of the bases in the world (3, 4, 4): listed positions read as matrices, then turned.

    Parameters
    ----------
    reading : str
        As in ``base_poses``.
    orientation : str
        ``identity``, or ``facing_workpiece``: the x axis points to the axis z of the world.
    """
    if orientation not in _ORIENTATIONS:
        expected = f"one of {', '.join(_ORIENTATIONS)}"
        raise UnknownNameError("pan", "base_orientation", orientation, expected)
    matrices = np.tile(np.eye(4), (3, 1, 1))
    matrices[:, :3, 3] = printed_bases()
    poses = base_poses(matrices, reading)
    if orientation == "facing_workpiece":
        for pose in poses:
            x, y = -pose[:2, 3] / np.linalg.norm(pose[:2, 3])
            pose[:2, :2] = [[x, -y], [y, x]]
    return poses


def robot_table(name: str) -> DHRobot:
    """The file of a stand-in arm, which is given by a table.

    Raises
    ------
    UnsupportedArmError
        It is given in another way.
    """
    robot = load_robot_file(data_path("robots", f"{name}.yaml"))
    if not isinstance(robot, DHRobot):
        raise UnsupportedArmError(f"{name}: the cell needs an arm that is given by a table")
    return robot


@memo()
def stand_in(name: str, shoulder_height: float | None = None, scale: float = 1.0) -> Arm:
    """One of the stand-in arms, its shoulder moved and its capsules scaled if asked for.

    The height applies where that of the file is a stand-in; a documented robot keeps its own.
    """
    robot = robot_table(name)
    first, *rest = robot.joints
    free = robot.provenance["d"].evidence == "stand-in"
    raised = shoulder_height - first.d if free and shoulder_height is not None else 0.0

    def moved(capsule: Any) -> Any:
        start = capsule.start
        if capsule.joint == 1 and start[2] == -first.d:  # the column keeps its foot on the base
            start = (start[0], start[1], start[2] - raised)
        return capsule.model_copy(update={"start": start, "radius": scale * capsule.radius})

    joints = [first.model_copy(update={"d": first.d + raised}), *rest]
    capsules = [moved(capsule) for capsule in robot.capsules]
    return Arm.from_dh(name, robot.model_copy(update={"joints": joints, "capsules": capsules}))
