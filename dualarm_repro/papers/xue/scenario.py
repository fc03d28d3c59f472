"""What the reproduction of `xue` feeds its methods with."""

from __future__ import annotations

import numpy as np
import pinocchio as pin

from ...arms import Arm, load_arm
from ...arms.angle import Angle
from ...arms.robot_file import DHRobot, load_robot_file
from ...datafiles import data_path
from ...tracking import memo

#: Start and goal angles of the master [rad], section 3.3.
MASTER_START = np.zeros(6)
MASTER_GOAL = np.pi * np.array([-1 / 2, -1 / 8, -1 / 2, 1 / 2, 1 / 4, 0])
#: Start and End of the slave [m], section 3.3; the frame they are given in is not printed.
SLAVE_START = np.array([0.75, 0.35, 0.5])
SLAVE_END = np.array([-0.45, 0.8, 0.15])
#: Gains k_a, k_r, k_w (also k_av) and the range d_0 [m], section 3.3.
GAINS = {"k_a": 3.0, "k_w": 2.0, "k_r": 1.0, "d_0": 0.3}
#: Random configurations of the master's workspace, section 3.2.
WORKSPACE_POINTS = 100_000
SEED = 20200344

#: Joint ranges by source; only axis U differs between the two public sources. In the document's
#: zero, q3 = -U, so the range -142.5..230 deg of the long-arm variant becomes -230..142.5 deg.
_RANGE_OF_U = {"bast165": None, "arte165": ("-230 deg", "142.5 deg")}


@memo()
def arm_in_use(joint_ranges: str = "bast165", upper_arm: float = 1.024) -> Arm:
    """The arm of matrices (2)-(7), with other joint ranges or another upper arm if asked for.

    Parameters
    ----------
    joint_ranges
        ``bast165`` or ``arte165``, as in the assumption of that name.
    upper_arm
        a_2 in metres.
    """
    limits = _RANGE_OF_U[joint_ranges]
    if limits is None and upper_arm == 1.024:
        return load_arm("es165d")
    robot = matrices_robot()
    joints = list(robot.joints)
    joints[2] = joints[2].model_copy(update={"a": upper_arm})
    if limits is not None:
        lower, upper = map(Angle.parse, limits)
        joints[2] = joints[2].model_copy(update={"lower": lower, "upper": upper})
    name = f"es165d-{joint_ranges}-{upper_arm:g}"
    return Arm.from_dh(name, robot.model_copy(update={"joints": joints}))


def matrices_robot() -> DHRobot:
    """DH table of the arm of matrices (2)-(7)."""
    return load_robot_file(data_path("robots", "es165d.yaml"))


def base_placements(distance: float) -> tuple[pin.SE3, pin.SE3]:
    """Master and mirrored slave, their bases ``distance`` apart along y, symmetric to the xz plane.

    The master reaches toward -y at its printed goal, so it stands on the +y side.
    """
    half = np.array([0.0, 0.5 * distance, 0.0])
    return pin.SE3(np.eye(3), half), pin.SE3(np.eye(3), -half)
