"""What `xue` prints as inputs, its arms, and the arrangement it does not print, as a scene."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import pinocchio as pin

from ...arms import Arm, load_arm
from ...arms.angle import Angle
from ...arms.reach import largest_reach
from ...arms.robot_file import DHRobot
from ...arms.tool_postures import ToolRule, tool_posture
from ...datafiles import data_path, read_yaml
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
_LIMITS: dict[str, dict[int, tuple[str, str]]] = {
    "bast165": {},
    "arte165": {2: ("-230 deg", "142.5 deg")},
    "full_turns": dict.fromkeys(range(6), ("-180 deg", "180 deg")),
}


def assumption(name: str) -> Any:
    """The value of an assumption of the document."""
    return REGISTRY.assumption(f"xue.{name}")


def assumptions(*names: str) -> dict[str, Any]:
    """The values of some of them."""
    return {name: assumption(name) for name in names}


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
    path = data_path("robots", f"{READINGS[reading]}.yaml")
    return DHRobot.checked(path, read_yaml(path))


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
    """Largest distance of the flange from the base, joint limits left aside [m]."""
    return largest_reach(load_arm(READINGS[reading]), np.random.default_rng(SEED))


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
    slave_postures: ToolRule

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

    @property
    def opening(self) -> tuple[float, float]:
        """Width and height of the opening [m]."""
        return self.window_opening_width, self.window_opening_height

    def window(self) -> tuple:
        """The four bars."""
        bar = self.window_bar
        return window_frame(self.window_centre, facing(self.normal), *self.opening, bar, bar)

    def slave_points(self) -> tuple[np.ndarray, np.ndarray]:
        """Start and End in the world, (3,) each [m]."""
        return self.frame_origin + slave_start(), self.frame_origin + slave_end()


@dataclass(frozen=True, eq=False, kw_only=True)
class Posed(PlacedArm):
    """An arm on its base, with a start and a goal [rad]."""

    start: np.ndarray
    goal: np.ndarray


@memo(512)
def placed_master(layout: Layout) -> Posed:
    """The master on its base, with the printed start and goal."""
    arm, placement = arms_of(layout.dh_source)[0], pin.SE3(np.eye(3), layout.master_base)
    return Posed("master", arm, placement, start=master_start(), goal=master_goal())


@memo(512)
def placed_slave(layout: Layout) -> Posed | None:
    """The slave on its base, with postures at Start and End; None where one is out of reach."""
    arm, base = arms_of(layout.dh_source)[1], layout.slave_base
    points = layout.slave_points()
    start, goal = (tool_posture(arm, point - base, layout.slave_postures) for point in points)
    if start is None or goal is None:
        return None
    return Posed("slave", arm, pin.SE3(np.eye(3), base), start=start, goal=goal)


def scene_of(layout: Layout, floor: float | None = None) -> Scene:
    """Both arms and the window; links of one arm are not watched against each other."""
    arms = [placed for placed in (placed_master(layout), placed_slave(layout)) if placed]
    return Scene(arms, {"window": layout.window()}, floor=floor, self_collision=False)
