"""What the reproduction of `qiu` feeds its methods with: arms, obstacles, printed inputs,
postures.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pinocchio as pin

from ...arms import Arm, load_arm
from ...arms.robot_file import DHRobot, load_robot_file
from ...datafiles import data_path
from ...planning.field.obstacles import Obstacles, obstacles_of
from ...scene import HalfSpace, PlacedArm, Scene, Sphere
from ...tracking import memo

ROBOT = "irb120"
#: Section 4.1: bases, spheres, goal of the master, gains and lengths.
BASES = {"master": np.array([0.350, 0.0, 0.0]), "slave": np.array([-0.350, 0.0, 0.0])}
CENTRES = np.array([[-0.100, 0.200, 0.750], [-0.1, -0.03, 0.95]])
RADIUS = 0.1
START = np.zeros(6)
MASTER_GOAL = np.array([-0.100, -0.200, 0.750])
ZETA, ETA0 = 1000.0, 1000.0
ALPHA0, THRESHOLD, INFLUENCE = 0.05, 0.4, 0.4
GOALS = 15
#: Section 4.2: goal of the slave.
SLAVE_GOAL = np.array([0.100, -0.400, 0.300])

SEED = 20200527
FLOOR = 0.0  # the table the arms stand on, for checks of contact
REPELLING_FLOOR = -0.25  # of the assumption `floor`
TOOL = 0.03  # of the reading `longer_tool` [m]
MOVED_BASE = 0.30  # x of the master base of the reading `moved_base` [m]
BRANCHES = ("front_shallow", "front_deep", "back_shallow", "back_deep")


@memo()
def robot() -> DHRobot:
    """DH table of the arm."""
    return load_robot_file(data_path("robots", f"{ROBOT}.yaml"))


def lengths() -> dict[str, float]:
    """Link lengths and offsets of the arm [m]."""
    joints = robot().joints
    return {
        "d1": joints[0].d,
        "a2": joints[1].a,
        "a3": joints[2].a,
        "d4": joints[3].d,
        "d6": joints[5].d,
    }


@memo(64)
def arm_in_use(tool: float = 0.0, radii: tuple[float, ...] | None = None) -> Arm:
    """The arm, its flange moved out by ``tool`` [m] and its links of other ``radii`` [m]."""
    if tool == 0.0 and radii is None:
        return load_arm(ROBOT)
    made = robot()
    joints = [*made.joints[:-1], made.joints[-1].model_copy(update={"d": made.joints[-1].d + tool})]
    used = [c.radius for c in made.capsules] if radii is None else radii
    capsules = [
        capsule.model_copy(update={"radius": radius})
        for capsule, radius in zip(made.capsules, used, strict=True)
    ]
    changed = made.model_copy(update={"joints": joints, "capsules": capsules})
    thick = "" if radii is None else "-" + "-".join(f"{radius:g}" for radius in radii)
    return Arm.from_dh(f"{ROBOT}-{tool:g}{thick}", changed)


def placed(
    name: str,
    *,
    yaw: float = 90.0,
    base: np.ndarray | None = None,
    tool: float = 0.0,
    radii: tuple[float, ...] | None = None,
) -> PlacedArm:
    """An arm on its printed base, or on another one; ``yaw`` in degrees."""
    rotation = pin.rpy.rpyToMatrix(0.0, 0.0, np.deg2rad(yaw))
    origin = BASES[name] if base is None else base
    return PlacedArm(name, arm_in_use(tool, radii), pin.SE3(rotation, origin.copy()))


def shoulder(base: np.ndarray) -> np.ndarray:
    """Where axes 1 and 2 cross, in the world (3,) [m]."""
    return base + np.array([0.0, 0.0, lengths()["d1"]])


def reach() -> float:
    """Largest distance of the flange from the shoulder: the straight arm [m]."""
    size = lengths()
    return size["a2"] + float(np.hypot(size["d4"], size["a3"])) + size["d6"]


def spheres() -> dict[str, Sphere]:
    """The two printed obstacles."""
    return {f"sphere_{k}": Sphere(centre, RADIUS) for k, centre in enumerate(CENTRES, 1)}


@memo()
def repelling(floor: bool = False, with_spheres: bool = True) -> Obstacles:
    """What repels the arms: the spheres and, if assumed, the floor."""
    shapes: dict[str, Sphere | HalfSpace] = dict(spheres()) if with_spheres else {}
    if floor:
        shapes["floor_plane"] = HalfSpace((0.0, 0.0, 1.0), REPELLING_FLOOR)
    return obstacles_of(Scene([placed("master")], shapes))


def truth_scene(arms: Sequence[PlacedArm]) -> Scene:
    """The scene in which contact is judged: whole links, both spheres, the table.

    The shoulder turns about the vertical only and cannot come nearer to the table.
    """
    turning = [(f"{arm.name}/capsule_1_joint_1", "floor") for arm in arms]
    return Scene(list(arms), spheres(), floor=FLOOR, exempt=turning)


def branch_posture(
    arm: PlacedArm, point: np.ndarray, branch: str, wrist: Sequence[float] = (0.0, 0.0, 0.0)
) -> np.ndarray | None:
    """q (6,) with the flange at a point and given wrist angles, on a named branch; None beyond
    reach.

    The arm is a chain of two links in a vertical plane: the upper arm, and forearm and wrist as
    one, whose flange a rolled wrist puts ``aside`` of the plane. ``front`` faces the point,
    ``back`` reaches over the shoulder; ``deep`` bends the elbow the other way than ``shallow``.
    """
    size, twist = lengths(), wrist[2]
    roll, bend = wrist[0], wrist[1]
    outer, lag, aside = _outer_link(arm, wrist)
    yaw = pin.rpy.matrixToRpy(arm.placement.rotation)[2]
    x, y, z = point - shoulder(arm.placement.translation)
    back = branch.startswith("back")
    flat = x**2 + y**2 - aside**2
    if flat < 0.0:
        return None
    radius = -np.sqrt(flat) if back else np.sqrt(flat)
    square = radius**2 + z**2
    cosine = (square - size["a2"] ** 2 - outer**2) / (2.0 * size["a2"] * outer)
    if abs(cosine) > 1.0:
        return None
    fold = np.arccos(cosine) * (1.0 if branch.endswith("deep") else -1.0)
    lift = np.arctan2(z, radius) - np.arctan2(
        outer * np.sin(fold), size["a2"] + outer * np.cos(fold)
    )
    upper = np.pi / 2 - lift
    q = np.array(
        [
            np.arctan2(y, x) - np.arctan2(aside, radius) - yaw,
            upper,
            lag - lift - fold - upper,
            roll,
            bend,
            twist,
        ]
    )
    q[:3] = (q[:3] + np.pi) % (2.0 * np.pi) - np.pi
    return q


def _outer_link(arm: PlacedArm, wrist: Sequence[float]) -> tuple[float, float, float]:
    """Forearm and wrist as one link: its length in the plane of the upper arm [m], its angle to
    the forearm [rad], and how far the flange is beside the plane [m]."""
    size, (roll, bend, _) = lengths(), wrist
    tool = float(np.linalg.norm(arm.arm.chain.translation[-1]))
    along = size["d4"] + tool * np.cos(bend)
    across = size["a3"] - tool * np.sin(bend) * np.cos(roll)
    aside = tool * np.sin(bend) * np.sin(roll)
    return float(np.hypot(along, across)), float(np.arctan2(across, along)), float(aside)


def wrist_reach(arm: PlacedArm, wrist: Sequence[float]) -> float:
    """Largest distance of the flange from the shoulder with given wrist angles [m]."""
    outer, _, aside = _outer_link(arm, wrist)
    return float(np.hypot(lengths()["a2"] + outer, aside))


def pulled_back(point: np.ndarray, base: np.ndarray, radius: float) -> np.ndarray:
    """The point moved along the ray from the shoulder to a distance from it (3,) [m]."""
    ray = point - shoulder(base)
    return shoulder(base) + radius * ray / np.linalg.norm(ray)
