"""What `qiu` prints for its runs, read from the ledger, and the arms and scenes made of it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pinocchio as pin

from ...arms import Arm, load_arm
from ...arms.robot_file import DHRobot, load_robot_file
from ...datafiles import data_path
from ...errors import DataFileError
from ...ledger import REGISTRY
from ...ledger.formula import Formula
from ...planning.field.obstacles import Obstacles, obstacles_of
from ...planning.tasks.random_tasks import blocked_task
from ...scene import HalfSpace, PlacedArm, Scene, Sphere
from ...tracking import memo

ROBOT = "irb120"
ARMS = ("master", "slave")
SEED = 20200527
FLOOR = 0.0  # the table the arms stand on, for checks of contact
REPELLING_FLOOR = -0.25  # of the assumption `floor`
TOOL = 0.03  # of the reading `longer_tool` [m]
MOVED_BASE = 0.30  # x of the master base of the reading `moved_base` [m]
MARGIN = 0.03  # clearance of the ends of random tasks [m]
#: Names of the two readings that are drawn beside each other.
FACE_VALUE, RECONSTRUCTION = "face value", "reconstruction"


def printed(item: str, *keys: str) -> np.ndarray:
    """Numbers that an item prints under one key, or under each of several keys."""
    found = REGISTRY.printed(f"qiu.{item}")
    rows = np.array([found[key] for key in keys], dtype=float)
    return rows[0] if len(keys) == 1 else rows


class _Printed:
    """Inputs and points of sections 4.1 and 4.2 under their symbols; lengths in metres."""

    @property
    def bases(self) -> dict[str, np.ndarray]:
        """Positions (3,) of both bases."""
        return dict(zip(ARMS, printed("claim_bases", *ARMS), strict=True))

    @property
    def start(self) -> np.ndarray:
        """Joints of both arms at the start (6,) [rad]."""
        return printed("claim_start", "q")

    @property
    def master_goal(self) -> np.ndarray:
        """Goal of the master's tip (3,)."""
        return printed("claim_goal", "tcp")

    @property
    def slave_goal(self) -> np.ndarray:
        """Goal of the slave's tip (3,)."""
        return printed("claim_slave_task", "goal")

    @property
    def centres(self) -> np.ndarray:
        """Of the spheres (2, 3)."""
        return printed("claim_obstacles", "centres")

    @property
    def radius(self) -> float:
        """Of the spheres."""
        return float(printed("claim_obstacles", "radius"))

    @property
    def zeta(self) -> float:
        """Attractive gain."""
        return float(printed("claim_zeta", "zeta"))

    @property
    def eta0(self) -> float:
        """Initial repulsive gain."""
        return float(printed("claim_eta0", "eta0"))

    @property
    def alpha0(self) -> float:
        """First step, in the unit that is assumed for it."""
        return float(printed("claim_alpha0", "alpha0"))

    @property
    def threshold(self) -> float:
        """d of the attraction."""
        return float(printed("claim_d", "d"))

    @property
    def influence(self) -> float:
        """rho_0, the range of the repulsion."""
        return float(printed("claim_rho0", "rho0"))

    @property
    def goals(self) -> int:
        """How many goals the methods are compared on."""
        return int(printed("claim_goals15", "count"))

    @property
    def trap(self) -> np.ndarray:
        """Where the one-way search is said to be trapped (3,)."""
        return printed("claim_trad_stuck", "tcp")

    @property
    def meeting(self) -> np.ndarray:
        """Where the halves of the master are said to end, forward and backward (2, 3)."""
        return printed("claim_bi_meet", "forward", "backward")

    @property
    def slave_meeting(self) -> np.ndarray:
        """Where the halves of the slave are said to end, forward and backward (2, 3)."""
        return printed("claim_slave_meet", "forward", "backward")


PRINTED = _Printed()


def value_of(formula: Formula, side: int, given: Mapping[str, Any]) -> Any:
    """Value of one side of a printed formula; NaN where there is no such side or it holds other
    names than the code."""
    try:
        return formula.value(side, given)
    except (DataFileError, IndexError, TypeError, ValueError):
        return np.nan


@memo()
def robot() -> DHRobot:
    """DH table of the arm."""
    return load_robot_file(data_path("robots", f"{ROBOT}.yaml"))


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
    yaw: float | None = None,
    base: np.ndarray | None = None,
    tool: float = 0.0,
    radii: tuple[float, ...] | None = None,
) -> PlacedArm:
    """An arm on its printed base, or on another one, turned by ``yaw`` [deg] or as assumed."""
    turn = REGISTRY.assumption("qiu.base_yaw") if yaw is None else yaw
    rotation = pin.rpy.rpyToMatrix(0.0, 0.0, np.deg2rad(turn))
    origin = PRINTED.bases[name] if base is None else base
    return PlacedArm(name, arm_in_use(tool, radii), pin.SE3(rotation, origin))


def master_arm(goal: str = "pulled_back", radii: tuple[float, ...] | None = None) -> PlacedArm:
    """The master on its base, with the change to arm or base that the reading ``goal`` of
    `master_goal` makes."""
    base = np.array([MOVED_BASE, 0.0, 0.0]) if goal == "moved_base" else None
    tool = TOOL if goal == "longer_tool" else 0.0
    return placed("master", base=base, tool=tool, radii=radii)


def spheres() -> dict[str, Sphere]:
    """The two printed obstacles."""
    radius = PRINTED.radius
    return {f"sphere_{k}": Sphere(centre, radius) for k, centre in enumerate(PRINTED.centres, 1)}


@memo()
def repelling(floor: bool = False, with_spheres: bool = True) -> Obstacles:
    """What repels the arms: the spheres and, if assumed, the floor."""
    shapes: dict[str, Sphere | HalfSpace] = dict(spheres()) if with_spheres else {}
    if floor:
        shapes["floor_plane"] = HalfSpace((0.0, 0.0, 1.0), REPELLING_FLOOR)
    return obstacles_of(Scene([placed("master")], shapes))


def truth_scene(arms: Sequence[PlacedArm]) -> Scene:
    """The scene in which contact is judged: whole links, both spheres, the table."""
    return Scene(list(arms), spheres(), floor=FLOOR, exempt=[_turning(arm) for arm in arms])


@memo(8)
def dual_scene(goal: str = "pulled_back", radii: tuple[float, ...] | None = None) -> Scene:
    """Both arms, spheres and table; the master as its goal is read, links of other radii."""
    return truth_scene([master_arm(goal, radii), placed("slave", radii=radii)])


def random_task(count: int, rng: np.random.Generator) -> tuple[Scene, np.ndarray, np.ndarray]:
    """Scene of the master with ``count`` spheres, a start and a goal (6,): both clear, the straight
    line blocked."""
    arm = placed("master")
    centre = shoulder(arm.placement.translation)
    return blocked_task(arm, centre, count, MARGIN, rng, [_turning(arm)])


def _turning(arm: PlacedArm) -> tuple[str, str]:
    """The shoulder turns about the vertical only and cannot come nearer to the table."""
    return (f"{arm.name}/capsule_1_joint_1", "floor")


def lengths() -> dict[str, float]:
    """Link lengths and offsets of the arm [m]."""
    joints = robot().joints
    names = (("d1", 0, "d"), ("a2", 1, "a"), ("a3", 2, "a"), ("d4", 3, "d"), ("d6", 5, "d"))
    return {name: getattr(joints[k], kind) for name, k, kind in names}


def shoulder(base: np.ndarray) -> np.ndarray:
    """Where axes 1 and 2 cross, in the world (3,) [m]."""
    return base + np.array([0.0, 0.0, lengths()["d1"]])


def reach() -> float:
    """Largest distance of the flange from the shoulder: the straight arm [m]."""
    size = lengths()
    return size["a2"] + float(np.hypot(size["d4"], size["a3"])) + size["d6"]


def shoulder_to_goal() -> float:
    """Distance of the printed goal of the master from its shoulder [m]."""
    return float(np.linalg.norm(PRINTED.master_goal - shoulder(PRINTED.bases["master"])))


def goal_to_surface() -> np.ndarray:
    """Distances of the printed goal of the master from both spheres (2,) [m]."""
    return np.linalg.norm(PRINTED.master_goal - PRINTED.centres, axis=1) - PRINTED.radius


def full_step() -> float:
    """Way of the straight arm's flange in one printed step [m]."""
    return PRINTED.alpha0 * reach()
