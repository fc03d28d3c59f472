"""Three readings of the master arm: matrices (2)-(7), Table 1 literally, the published robot."""

from __future__ import annotations

import numpy as np
from scipy.optimize import minimize

from ...arms import load_arm
from ...arms.robot_file import DHRobot, load_robot_file
from ...datafiles import data_path
from ...tracking import memo
from .scenario import SEED

READINGS = {"matrices": "es165d", "table": "es165d-table1", "published": "es165d-public"}
_LENGTHS = {
    "a1": ("a", 1),
    "a2": ("a", 2),
    "a3": ("a", 3),
    "d1": ("d", 0),
    "d4": ("d", 3),
    "d6": ("d", 5),
}


def robot(reading: str) -> DHRobot:
    """DH table of a reading."""
    return load_robot_file(data_path("robots", f"{READINGS[reading]}.yaml"))


def lengths(reading: str) -> dict[str, float]:
    """Link lengths a_1, a_2, a_3 and offsets d_1, d_4, d_6 in metres."""
    joints = robot(reading).joints
    return {name: getattr(joints[row], column) for name, (column, row) in _LENGTHS.items()}


@memo()
def reach(reading: str) -> float:
    """Largest distance of the flange from the origin of the base, joint limits left aside [m].

    Best of 20 000 random configurations, polished by quasi-Newton steps with the exact Jacobian.
    """
    arm = load_arm(READINGS[reading])
    q = np.random.default_rng(SEED).uniform(-np.pi, np.pi, (20_000, arm.nq))
    best = q[np.argmax(np.linalg.norm(arm.fk(q)[:, :3, 3], axis=1))]

    def negative_square(configuration: np.ndarray) -> tuple[float, np.ndarray]:
        point = arm.fk(configuration)[:3, 3]
        return -float(point @ point), -2.0 * point @ arm.jacobian(configuration)[:3]

    found = minimize(negative_square, best, jac=True, method="BFGS", options={"gtol": 1e-10})
    return float(np.sqrt(-found.fun))
