"""What `xue` prints as inputs, its arms, and the arrangement it does not print, as a scene."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import pinocchio as pin
from scipy.optimize import minimize

from ...arms import Arm, load_arm
from ...arms.angle import Angle
from ...arms.robot_file import DHRobot, load_robot_file
from ...datafiles import data_path
from ...ledger import REGISTRY
from ...ledger.assumptions import FromAssumptions
from ...ledger.printed import read_number
from ...scene import PlacedArm, Scene, facing, window_frame
from ...tracking import memo

SEED = 20200344
METHODS_OF_TABLE_2 = ("traditional", "improved")
#: Robot files of the master: matrices (2)-(7), Table 1 literally, the published robot.
READINGS = {"matrices": "es165d", "table": "es165d-table1", "published": "es165d-public"}
#: Rows of a DH table that hold the link lengths a_1, a_2, a_3 and offsets d_1, d_4, d_6.
LENGTHS = {"a1": ("a", 1), "a2": ("a", 2), "a3": ("a", 3),
           "d1": ("d", 0), "d4": ("d", 3), "d6": ("d", 5)}  # fmt: skip
#: Limits of joints other than in the file of the robot. The two public sources differ in axis U;
#: in the document's zero, q3 = -U, so that -142.5 to 230 deg of the long-arm variant are these.
_LIMITS = {
    "bast165": {},
    "arte165": {2: ("-230 deg", "142.5 deg")},
    "full_turns": dict.fromkeys(range(6), ("-180 deg", "180 deg")),
}
_ELBOW = 2  # row of frame 3 among the joint origins
_DOWN = np.array([0.0, 0.0, -1.0])


def assumption(name: str) -> Any:
    """The value of an assumption of the document."""
    return REGISTRY.assumption(f"xue.{name}")


@memo()
def printed_vector(item: str, field: str) -> np.ndarray:
    """Numbers that a statement prints, as an array."""
    return np.array([read_number(text)[0] for text in REGISTRY.printed(f"xue.{item}")[field]])


def master_start() -> np.ndarray:
    """Start angles of the master (6,) [rad], section 3.3."""
    return printed_vector("claim_master_start", "q")


def master_goal() -> np.ndarray:
    """Goal angles of the master (6,) [rad], section 3.3."""
    return printed_vector("claim_master_goal", "q")


def slave_start() -> np.ndarray:
    """Start of the slave (3,) [m], section 3.3; the frame it is given in is not printed."""
    return printed_vector("claim_slave_start", "position")


def slave_end() -> np.ndarray:
    """End of the slave (3,) [m], in the same frame."""
    return printed_vector("claim_slave_end", "position")


@memo()
def gains() -> dict[str, float]:
    """Gains k_a, k_r, k_w (also k_av) and the range d_0 [m], section 3.3."""
    return {key: read_number(text)[0] for key, text in REGISTRY.printed("xue.claim_gains").items()}


def table_counts() -> dict[str, int]:
    """The trap column of Table 2 by row."""
    printed = REGISTRY.printed("xue.tab02")
    return {name: int(printed[name]["trapped"]) for name in METHODS_OF_TABLE_2}


def text_counts() -> dict[str, int]:
    """The same by the text: how often the traditional method is trapped, the improved one fails."""
    success = REGISTRY.printed("xue.claim_success_10")
    trials = int(success["trials"])
    arrived = trials if success["successes"] == "all" else int(success["successes"])
    trapped = int(REGISTRY.printed("xue.claim_trapped_8")["trapped"])
    return {"traditional": trapped, "improved": trials - arrived}


def workspace_points() -> int:
    """Random configurations of the master's workspace, section 3.2."""
    return int(REGISTRY.printed("xue.claim_mc_points")["points"])


def robot(reading: str) -> DHRobot:
    """DH table of a reading."""
    return load_robot_file(data_path("robots", f"{READINGS[reading]}.yaml"))


def lengths(reading: str) -> dict[str, float]:
    """Link lengths a_1, a_2, a_3 and offsets d_1, d_4, d_6 in metres."""
    joints = robot(reading).joints
    return {name: getattr(joints[row], column) for name, (column, row) in LENGTHS.items()}


@memo()
def arm_in_use(joint_ranges: str, upper_arm: float) -> Arm:
    """The arm of matrices (2)-(7) with some joint ranges and an upper arm a_2 [m].

    Parameters
    ----------
    joint_ranges
        Of a public source, or full turns, as in the assumption of that name.
    """
    made = robot("matrices")
    if joint_ranges == "bast165" and upper_arm == made.joints[2].a:
        return load_arm("es165d")
    joints = list(made.joints)
    joints[2] = joints[2].model_copy(update={"a": upper_arm})
    for k, ends in _LIMITS[joint_ranges].items():
        limits = dict(zip(("lower", "upper"), map(Angle.parse, ends), strict=True))
        joints[k] = joints[k].model_copy(update=limits)
    name = f"es165d-{joint_ranges.replace('_', '-')}-{upper_arm:g}"
    return Arm.from_dh(name, made.model_copy(update={"joints": joints}))


@memo()
def arms_of(dh_source: str) -> tuple[Arm, Arm]:
    """Master by the matrices or by Table 1, and the slave, its mirror image."""
    master = load_arm(READINGS[dh_source])
    return master, load_arm("es165d-slave") if dh_source == "matrices" else master.mirrored()


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


def base_placements(distance: float) -> tuple[pin.SE3, pin.SE3]:
    """Master and mirrored slave, their bases ``distance`` apart along y, symmetric to the xz plane.

    The master reaches toward -y at its printed goal, so it stands on the +y side.
    """
    half = np.array([0.0, 0.5 * distance, 0.0])
    return pin.SE3(np.eye(3), half), pin.SE3(np.eye(3), -half)


@dataclass(frozen=True)
class Layout(FromAssumptions):
    """One arrangement; every field is the assumption of that name. Lengths in metres."""

    dh_source: str
    master_base_x: float
    master_base_y: float
    master_base_z: float
    base_distance: float
    window_centre_x: float
    window_centre_y: float
    window_centre_z: float
    window_normal: str
    window_opening_width: float
    window_opening_height: float
    window_bar: float
    slave_frame: str
    slave_postures: str

    @property
    def master_base(self) -> np.ndarray:
        """Origin of the master's base (3,) [m]."""
        return np.array([self.master_base_x, self.master_base_y, self.master_base_z])

    @property
    def slave_base(self) -> np.ndarray:
        """Origin of the slave's base (3,) [m]: that of the master moved along -y."""
        return self.master_base - np.array([0.0, self.base_distance, 0.0])

    @property
    def frame_origin(self) -> np.ndarray:
        """Origin of the frame that Start and End are given in (3,) [m]."""
        return self.slave_base if self.slave_frame == "slave_base" else np.zeros(3)

    @property
    def window_centre(self) -> np.ndarray:
        """Middle of the opening, which is the virtual attraction point (3,) [m]."""
        return np.array([self.window_centre_x, self.window_centre_y, self.window_centre_z])

    @property
    def normal(self) -> np.ndarray:
        """Direction in which the window is passed (3,)."""
        chord = slave_end() - slave_start()
        level = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "chord": (chord[0], chord[1], 0.0)}
        return np.array(level[self.window_normal])

    def window(self) -> tuple:
        """The four bars."""
        size = (self.window_opening_width, self.window_opening_height)
        return window_frame(
            self.window_centre, facing(self.normal), *size, self.window_bar, self.window_bar
        )

    def slave_points(self) -> tuple[np.ndarray, np.ndarray]:
        """Start and End in the world, (3,) each [m]."""
        return self.frame_origin + slave_start(), self.frame_origin + slave_end()


@memo(512)
def placed_master(layout: Layout) -> PlacedArm:
    """The master on its base, with the printed start and goal."""
    placement = pin.SE3(np.eye(3), layout.master_base)
    ends = master_start(), master_goal()
    return PlacedArm("master", arms_of(layout.dh_source)[0], placement, *ends)


@memo(512)
def placed_slave(layout: Layout) -> PlacedArm | None:
    """The slave on its base, with postures at Start and End; None where one is out of reach."""
    arm, base = arms_of(layout.dh_source)[1], layout.slave_base
    points = layout.slave_points()
    start, goal = (posture(arm, point - base, layout.slave_postures) for point in points)
    if start is None or goal is None:
        return None
    return PlacedArm("slave", arm, pin.SE3(np.eye(3), base), start, goal)


def scene_of(layout: Layout, floor: float | None = None) -> Scene:
    """Both arms and the window; links of one arm are not watched against each other."""
    arms = [placed for placed in (placed_master(layout), placed_slave(layout)) if placed]
    return Scene(arms, {"window": layout.window()}, floor=floor, self_collision=False)


def posture(arm: Arm, point: np.ndarray, choice: str) -> np.ndarray | None:
    """Configuration that brings the flange to ``point``, or None out of reach.

    The pose is completed by the direction of the tool: level and away from axis 1
    (``radial_horizontal``, ``nearest_branch``) or down (``tool_down``). Turning the tool about its
    own axis changes neither point nor direction, so that theta_6 = 0 can be had. Of the branches
    that one is taken whose elbow is highest, with the shoulder turned to the point and
    |theta_4| <= pi/2, or the one nearest to the zero configuration (``nearest_branch``).

    Parameters
    ----------
    point : (3,)
        In the frame of the base [m].
    """
    radial = np.array([point[0], point[1], 0.0])
    axis = _DOWN if choice == "tool_down" else radial / np.linalg.norm(radial)
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = _frame_along(axis), point
    found = arm.ik_branches(pose[np.newaxis], reference=np.zeros(arm.nq), within_limits=False)[0]
    found = found[~np.isnan(found).any(axis=1)]
    if choice != "nearest_branch":
        found = found[(np.abs(found[:, 3]) <= 0.5 * np.pi + 1e-9) & _forward(found, point)]
    if not len(found):
        return None
    found[:, 5] = 0.0
    if choice == "nearest_branch":
        return found[np.linalg.norm(found, axis=1).argmin()]
    height = arm.joint_positions(found)[:, _ELBOW, 2]
    highest = found[height > height.max() - 1e-9]
    return highest[np.linalg.norm(highest, axis=1).argmin()]


def _forward(q: np.ndarray, point: np.ndarray) -> np.ndarray:
    """Whether axis 1 turns the arm toward the point and not away from it (N,)."""
    return np.cos(q[:, 0]) * point[0] + np.sin(q[:, 0]) * point[1] > 0.0


def _frame_along(axis: np.ndarray) -> np.ndarray:
    """A rotation whose third column is ``axis``."""
    across = np.cross(axis, [1.0, 0.0, 0.0] if abs(axis[2]) > 0.5 else [0.0, 0.0, 1.0])
    across /= np.linalg.norm(across)
    return np.column_stack([across, np.cross(axis, across), axis])
