"""What `qiu` prints for its runs, read from the ledger, and the arms and scenes made of it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pinocchio as pin

from ...arms import Arm, load_arm
from ...arms.altered import altered
from ...arms.robot_file import DHRobot
from ...datafiles import data_path, read_yaml
from ...errors import DataFileError
from ...ledger import REGISTRY
from ...ledger.formula import parse
from ...ledger.printed_values import PrintedValue, printed_numbers
from ...planning.field.obstacles import Obstacles, obstacles_of
from ...planning.tasks.elbow_branches import shoulder, straight_reach
from ...planning.tasks.random_tasks import blocked_task
from ...scene import HalfSpace, PlacedArm, Scene, Sphere
from ...tracking import memo

ROBOT = "irb120"
ARMS = ("master", "slave")
SEED = 20200527
FLOOR = 0.0  # height of the table under the bases in the reading of `floor` that has one [m]
TOOL = 0.03  # of the reading `longer_tool` [m]
MOVED_BASE = 0.30  # x of the master base of the reading `moved_base` [m]
MARGIN = 0.03  # clearance of the ends of random tasks [m]
#: Names of the two readings that are drawn beside each other.
FACE_VALUE, CALIBRATED = "face value", "calibrated"


class _Printed:
    """Inputs and points of sections 4.1 and 4.2 under their symbols; lengths in metres."""

    start = PrintedValue("qiu.claim_start", "q")  # joints of both arms (6,) [rad]
    master_goal = PrintedValue("qiu.claim_goal", "tcp")  # of the tip (3,)
    slave_goal = PrintedValue("qiu.claim_slave_task", "goal")
    centres = PrintedValue("qiu.claim_obstacles", "centres")  # of the spheres (2, 3)
    radius = PrintedValue("qiu.claim_obstacles", "radius")
    zeta = PrintedValue("qiu.claim_zeta", "zeta")  # attractive gain
    eta0 = PrintedValue("qiu.claim_eta0", "eta0")  # initial repulsive gain
    alpha0 = PrintedValue("qiu.claim_alpha0", "alpha0")  # first step, in the unit assumed for it
    threshold = PrintedValue("qiu.claim_d", "d")  # of the attraction
    influence = PrintedValue("qiu.claim_rho0", "rho0")  # range of the repulsion
    goals = PrintedValue("qiu.claim_goals15", "count")  # that the methods are compared on
    trap = PrintedValue("qiu.claim_trad_stuck", "tcp")  # of the one-way search (3,)
    #: Where the halves of both arms are said to end, forward and backward (2, 3).
    meeting = PrintedValue("qiu.claim_bi_meet", "forward", "backward")
    slave_meeting = PrintedValue("qiu.claim_slave_meet", "forward", "backward")

    @property
    def bases(self) -> dict[str, np.ndarray]:
        """Positions (3,) of both bases."""
        return dict(zip(ARMS, printed_numbers("qiu.claim_bases", *ARMS), strict=True))


PRINTED = _Printed()


def printed_side(item: str, side: int, given: Mapping[str, Any], key: str = "formula") -> Any:
    """Value of one side of a printed formula; NaN where there is no such side or it holds other
    names than the code."""
    formula = parse(REGISTRY.printed(f"qiu.{item}")[key])
    try:
        return formula.value(side, given)
    except (DataFileError, IndexError, TypeError, ValueError):
        return np.nan


@memo()
def robot() -> DHRobot:
    """DH table of the arm."""
    path = data_path("robots", f"{ROBOT}.yaml")
    return DHRobot.checked(path, read_yaml(path))


@memo(64)
def arm_in_use(tool: float = 0.0, radii: tuple[float, ...] | None = None) -> Arm:
    """The arm, its flange moved out by ``tool`` [m] and its links of other ``radii`` [m]."""
    if tool == 0.0 and radii is None:
        return load_arm(ROBOT)
    return altered(ROBOT, robot(), tool, radii)


def placed(
    name: str, yaw: float | None = None, base: np.ndarray | None = None, arm: Arm | None = None
) -> PlacedArm:
    """The arm, or an altered one, on its printed base, or on another one, turned by ``yaw`` [deg]
    or as assumed."""
    turn = REGISTRY.assumption("qiu.base_yaw") if yaw is None else yaw
    rotation = pin.rpy.rpyToMatrix(0.0, 0.0, np.deg2rad(turn))
    origin = PRINTED.bases[name] if base is None else base
    return PlacedArm(name, arm_in_use() if arm is None else arm, pin.SE3(rotation, origin))


def master_arm(goal: str = "pulled_back", radii: tuple[float, ...] | None = None) -> PlacedArm:
    """The master on its base, with the change to arm or base that the reading ``goal`` of
    `master_goal` makes."""
    base = np.array([MOVED_BASE, 0.0, 0.0]) if goal == "moved_base" else None
    arm = arm_in_use(TOOL if goal == "longer_tool" else 0.0, radii)
    return placed("master", base=base, arm=arm)


def spheres() -> dict[str, Sphere]:
    """The two printed obstacles."""
    radius = PRINTED.radius
    return {f"sphere_{k}": Sphere(centre, radius) for k, centre in enumerate(PRINTED.centres, 1)}


@memo()
def repelling(floor: bool = False, with_spheres: bool = True) -> Obstacles:
    """What repels the arms: the spheres and, if assumed, the table."""
    shapes: dict[str, Sphere | HalfSpace] = dict(spheres()) if with_spheres else {}
    if floor:
        shapes["floor_plane"] = HalfSpace((0.0, 0.0, 1.0), FLOOR)
    return obstacles_of(Scene([placed("master")], shapes))


def truth_scene(arms: Sequence[PlacedArm], floor: bool = False) -> Scene:
    """The scene in which contact is judged: whole links, both spheres and, if assumed, the
    table."""
    if not floor:
        return Scene(list(arms), spheres())
    return Scene(list(arms), spheres(), floor=FLOOR, exempt=[_turning(arm) for arm in arms])


@memo(8)
def dual_scene(
    goal: str = "pulled_back", radii: tuple[float, ...] | None = None, floor: bool = False
) -> Scene:
    """Both arms, spheres and, if assumed, the table; the master as its goal is read, links of other
    radii."""
    arms = [master_arm(goal, radii), placed("slave", arm=arm_in_use(0.0, radii))]
    return truth_scene(arms, floor)


def random_task(count: int, rng: np.random.Generator) -> tuple[Scene, np.ndarray, np.ndarray]:
    """Scene of the master with ``count`` spheres, a start and a goal (6,): both clear, the straight
    line blocked."""
    arm = placed("master")
    return blocked_task(arm, shoulder(arm), count, MARGIN, rng)


def _turning(arm: PlacedArm) -> tuple[str, str]:
    """The shoulder turns about the vertical only and cannot come nearer to the table."""
    return (f"{arm.name}/capsule_1_joint_1", "floor")


def reach() -> float:
    """Largest distance of the flange from the shoulder [m]."""
    return straight_reach(load_arm(ROBOT))


def shoulder_to_goal() -> float:
    """Distance of the printed goal of the master from its shoulder [m]."""
    return float(np.linalg.norm(PRINTED.master_goal - shoulder(placed("master"))))


def goal_to_surface() -> np.ndarray:
    """Distances of the printed goal of the master from both spheres (2,) [m]."""
    return np.linalg.norm(PRINTED.master_goal - PRINTED.centres, axis=1) - PRINTED.radius


def full_step() -> float:
    """Way of the straight arm's flange in one printed step [m]."""
    return PRINTED.alpha0 * reach()
