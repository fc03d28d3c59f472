"""Inputs of `qiu`: obstacles, starts and goals, audited against the arm."""

from __future__ import annotations

from functools import partial

import numpy as np
import pandas as pd
import pinocchio as pin

from ...errors import InputError
from ...ledger import REGISTRY, Adopts, Assumed, Bounded, Result, Role
from ...ledger.printed import read_number
from ...planning.field.control_points import end_effector
from ...planning.tasks.tip_goal import tip_posture
from ..wording import point
from .goals import draw_goals
from .kinematics import offset_chain
from .printed_points import printed_tip
from .readings import master_arm, master_posture, slave_posture, slave_postures
from .scenario import (
    BASES,
    BRANCHES,
    CENTRES,
    INFLUENCE,
    MASTER_GOAL,
    RADIUS,
    SEED,
    SLAVE_GOAL,
    START,
    branch_posture,
    placed,
    pulled_back,
    reach,
    shoulder,
)

checks = partial(REGISTRY.checks, page="qiu/geometry")
_WAYS = {
    "pulled_back": "pulled back along the ray from the shoulder",
    "best_effort": "the nearest point that the arm reaches",
    "longer_tool": "reached with a tool",
    "moved_base": "reached from a base moved along x",
}


@checks(
    "qiu.claim_obstacles",
    rules=[
        Adopts("radius", "radius of the spheres [m]", to="radius"),
        Adopts("centres", "centres of the spheres [m]", to="centres"),
    ],
)
def obstacles(assumed: Assumed) -> Result:
    """Both spheres, and how they stand to the printed goal."""
    gaps = np.linalg.norm(MASTER_GOAL - CENTRES, axis=1) - RADIUS
    return Result(
        obtained={"radius": RADIUS, "centres": CENTRES.tolist(), "goal_to_surface": gaps.tolist()},
        caption=(
            f"Both spheres are used as printed. Their surfaces are {gaps[0]:.3f} m and "
            f"{gaps[1]:.3f} m "
            f"from the printed goal of the master, inside the range {INFLUENCE:g} m of the "
            "repulsion."
        ),
    )


@checks(
    "qiu.claim_start",
    rules=[
        Bounded(
            "beyond_digits",
            "printed tip against the tip at the printed joints, beyond the printed digits [m]",
            low=0.0,
            role=Role.CONTRADICTS,
        ),
    ],
)
def start(assumed: Assumed) -> Result:
    """The tip at the printed joints against the printed tip."""
    return _start(assumed, "master", REGISTRY.printed("qiu.claim_start")["tcp"])


def _start(assumed: Assumed, name: str, printed: list[str]) -> Result:
    angles = np.array([float(text) for text in REGISTRY.printed("qiu.claim_start")["q"]])
    base = np.array([float(text) for text in REGISTRY.printed("qiu.claim_bases")[name]])
    turn = pin.rpy.rpyToMatrix(0.0, 0.0, np.deg2rad(assumed["base_yaw"]))
    tip = pin.SE3(turn, base).act(offset_chain(angles, assumed["link_lengths"]).translation)
    read = [read_number(text) for text in printed]
    gaps = [abs(value - there) for value, (there, _) in zip(tip, read, strict=True)]
    beyond = [gap - half for gap, (_, half) in zip(gaps, read, strict=True)]
    distance = float(np.linalg.norm(gaps))
    return Result(
        obtained={
            "q": angles.tolist(),
            "tcp": tip.tolist(),
            "gap": distance,
            "beyond_digits": float(max(beyond)),
        },
        caption=(
            f"At the printed joints the flange of the {name} is at ({point(tip, 3)}) m, "
            f"{1e3 * distance:.1f} mm from the printed tip: {1e3 * gaps[1]:.0f} mm in y and "
            f"{1e3 * gaps[2]:.0f} mm in height. "
            + (
                "Joints and tip of one start contradict each other; the joints are used."
                if max(beyond) >= 0.0
                else "Joints and tip agree to the printed digits."
            )
        ),
    )


@checks(
    "qiu.claim_goal",
    samples=32,
    rules=[
        Adopts("tcp", "flange at the goal that is planned to [m]", to="tcp"),
        Bounded("beyond_limits", "goal posture beyond the joint limits [rad]", high=0.0),
    ],
    change="replaced by a goal that the arm reaches, by the way that the caption states",
)
def goal(assumed: Assumed) -> Result:
    """Distance of the printed goal, what the planner says to it, and the change made."""
    arm = master_arm(assumed)
    q = master_posture(assumed)
    tip = end_effector(arm, q)
    distance = float(np.linalg.norm(MASTER_GOAL - shoulder(BASES["master"])))
    lower, upper = np.deg2rad(np.array(assumed["joint_limits"], dtype=float)).T
    error, best = _refusal(), tip_posture(placed("master"), MASTER_GOAL, q, best_effort=True)
    branches = {}
    for branch in BRANCHES:
        inside = pulled_back(MASTER_GOAL, BASES["master"], assumed["goal_radius"])
        posture = branch_posture(placed("master"), inside, branch, assumed["goal_wrist"])
        branches[branch] = None if posture is None else np.rad2deg(posture).tolist()
    return Result(
        obtained={
            "tcp": tip.tolist(),
            "q_deg": np.rad2deg(q).tolist(),
            "branch": assumed["goal_branch"],
            "beyond_limits": float(np.maximum(lower - q, q - upper).max()),
            "printed_distance": distance,
            "reach": reach(),
            "beyond_reach": distance - reach(),
            "moved": float(np.linalg.norm(tip - MASTER_GOAL)),
            "refusal": error,
            "nearest_reachable": best.tip.tolist(),
            "nearest_residual": best.residual,
            "branches_deg": branches,
        },
        table=_changes(),
        caption=(
            f"The printed goal is {distance:.4f} m from the shoulder and the straight arm reaches "
            f"{reach():.4f} m: {1e3 * (distance - reach()):.1f} mm are missing, and the planner "
            "refuses "
            f"it. The nearest reachable point is ({point(best.tip, 3)}) m. The goal planned to is "
            f"({point(tip, 3)}) m, {1e3 * np.linalg.norm(tip - MASTER_GOAL):.0f} mm from print "
            f"({_WAYS[assumed['master_goal']]}), with "
            f"joints {', '.join(f'{x:.1f}' for x in np.rad2deg(q))} deg."
        ),
    )


def _refusal() -> str:
    """The message with which the printed goal is refused."""
    try:
        tip_posture(placed("master"), MASTER_GOAL, START)
    except InputError as error:
        return str(error)
    return ""


def _changes() -> pd.DataFrame:
    """Least change of one input after which the printed goal is within reach."""
    missing = float(np.linalg.norm(MASTER_GOAL - shoulder(BASES["master"]))) - reach()
    flat = MASTER_GOAL - shoulder(BASES["master"])
    across = np.sqrt(reach() ** 2 - flat[1] ** 2 - flat[2] ** 2)
    height = np.sqrt(reach() ** 2 - flat[0] ** 2 - flat[1] ** 2)
    rows = [
        ("goal pulled towards the shoulder", missing),
        ("tool of at least this length", missing),
        ("base moved along x", abs(flat[0]) - across),
        ("goal lowered at the same x, y", flat[2] - height),
    ]
    return pd.DataFrame(rows, columns=["change", "least_amount_m"])


@checks(
    "qiu.claim_slave_task",
    rules=[
        Bounded(
            "beyond_digits",
            "printed start against the tip at the printed joints, beyond the printed digits [m]",
            low=0.0,
            role=Role.CONTRADICTS,
        ),
    ],
)
def slave_task(assumed: Assumed) -> Result:
    """Start and goal of the slave, and the postures that reach the goal."""
    printed = REGISTRY.printed("qiu.claim_slave_task")["start"]
    begin = _start(assumed, "slave", printed)
    q = slave_posture(assumed)
    tip = end_effector(placed("slave"), q)
    limits = np.deg2rad(np.array(assumed["joint_limits"], dtype=float))
    found = slave_postures(assumed)
    inside = [b for b, p in found.items() if ((p >= limits[:, 0]) & (p <= limits[:, 1])).all()]
    away = float(np.linalg.norm(SLAVE_GOAL - shoulder(BASES["slave"])))
    return Result(
        obtained={
            "start": begin.obtained["tcp"],
            "beyond_digits": begin.obtained["beyond_digits"],
            "goal": tip.tolist(),
            "q_deg": np.rad2deg(q).tolist(),
            "distance": away,
            "branches_within_limits": inside,
        },
        caption=(
            f"{begin.caption} Its goal is {away:.3f} m from the shoulder, within reach; of the "
            f"{len(found)} postures with the assumed wrist angles {len(inside)} is within the "
            f"joint limits ({', '.join(inside)}); the one used has joints "
            f"{', '.join(f'{x:.1f}' for x in np.rad2deg(q))} deg."
        ),
    )


@checks(
    "qiu.claim_goals15",
    rules=[
        Adopts("count", "number of different goals", to="count"),
        Bounded(
            "beyond_neighbourhood",
            "farthest goal from the printed one, beyond the nearer sphere [m]",
            high=0.0,
        ),
    ],
)
def goals_15(assumed: Assumed) -> Result:
    """A seeded set of goals with its rejections.

    Near the printed goal means nearer to it than the nearer sphere is.
    """
    drawn = draw_goals(assumed, SEED)
    centre = printed_tip("qiu.claim_goals15", "centre")
    spheres = REGISTRY.printed("qiu.claim_obstacles")
    middles = np.array(spheres["centres"], dtype=float)
    nearer = float(np.linalg.norm(middles - centre, axis=1).min()) - float(spheres["radius"])
    farthest = float(np.linalg.norm(drawn.points - centre, axis=1).max(initial=0.0))
    table = pd.DataFrame(drawn.points, columns=["x_m", "y_m", "z_m"])
    table[[f"q{j}_deg" for j in range(1, 7)]] = np.rad2deg(drawn.q)
    return Result(
        obtained={
            "count": len(np.unique(drawn.points, axis=0)),
            "beyond_neighbourhood": farthest - nearer,
            "farthest": farthest,
            "rejected": drawn.rejected,
        },
        table=table,
        caption=(
            f"{len(drawn.q)} goals in a box of half width {assumed['goal_set']:g} m; rejected "
            "draws: "
            + ", ".join(f"{count} {reason}" for reason, count in drawn.rejected.items())
            + f". The farthest is {1e3 * farthest:.0f} mm from the printed goal, the nearer sphere "
            f"{1e3 * nearer:.0f} mm."
        ),
    )
