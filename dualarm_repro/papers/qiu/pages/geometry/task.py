"""Figure 3, equation (3) and the inputs of `qiu`: bases, obstacles, starts and goals, audited."""

from __future__ import annotations

from functools import partial

import numpy as np
import pandas as pd
import pinocchio as pin

from .....errors import InputError
from .....ledger import (
    REGISTRY,
    Adopts,
    Assumed,
    Bounded,
    Is,
    NoOriginal,
    Residual,
    Result,
    Role,
    Rounds,
)
from .....ledger.captions import point
from .....ledger.formula import parse
from .....ledger.printed import read_number
from .....ledger.printed_values import printed_numbers
from .....planning.field.control_points import end_effector
from .....planning.tasks.elbow_branches import BRANCHES, branch_posture, pulled_back, shoulder
from .....planning.tasks.tip_goal import tip_posture
from .....view.arm_drawings import stick_figure
from .....view.arm_scenes import standing
from ...document import (
    ARMS,
    PRINTED,
    SEED,
    goal_to_surface,
    placed,
    reach,
    shoulder_to_goal,
    value_of,
)
from ...reading import Goal, GoalBox, SlaveGoal
from .arm import flange_by_offsets

checks = partial(REGISTRY.checks, page="qiu/geometry")
_INPUT = {"tolerance": 1e-12, "reason": "difference of two printed inputs"}
_WAYS = {
    "pulled_back": "pulled back along the ray from the shoulder",
    "best_effort": "the nearest point that the arm reaches",
    "longer_tool": "reached with a tool",
    "moved_base": "reached from a base moved along x",
}


@checks(
    "qiu.eq03",
    rules=[
        Residual(
            "miss",
            "base that the printed formula gives misses the printed slave base by [m]",
            high=1e-12,
        )
    ],
)
def base_translation(assumed: Assumed) -> Result:
    """The printed formula with the printed master base and the assumed translation."""
    formula = parse(REGISTRY.printed("qiu.eq03")["formula"])
    bases, shift = PRINTED.bases, np.array([assumed["base_translation"], 0.0, 0.0])
    vectors = {"X_slaver": bases["slave"], "X_master": bases["master"], "T_trans": shift}
    given = {name: pin.SE3(np.eye(3), at).homogeneous for name, at in vectors.items()}
    left, right = (value_of(formula, side, given) for side in (0, 1))
    return Result(
        obtained={"translation": shift.tolist(), "miss": float(np.abs(left - right).max())},
        caption=(
            f"With a translation by {shift[0]:.3f} m along x the printed formula carries the "
            f"printed master base to within {np.abs(left - right).max():.0e} m of the printed "
            "slave base; no rotation is involved."
        ),
    )


@checks(
    "qiu.fig03",
    rules=[
        Rounds(key="base_master", to="base_master", label="base of the master [m]", **_INPUT),
        Rounds(key="base_slave", to="base_slave", label="base of the slave [m]", **_INPUT),
        Is(
            "turn_nearest_to_print",
            "of the quarter turns, this one brings the start tips nearest to print",
            value=True,
        ),
        NoOriginal("drawing", "the picture"),
    ],
)
def both_arms(assumed: Assumed) -> Result:
    """Both arms in their start posture on the printed bases."""
    arms = {name: placed(name, yaw=assumed["base_yaw"]) for name in ARMS}
    bases = {name: arm.placement.translation for name, arm in arms.items()}
    bases["slave"] = bases["master"] + np.array([assumed["base_translation"], 0.0, 0.0])
    zero, gaps = PRINTED.start, gap_by_turn()

    return Result(
        obtained={
            "base_master": bases["master"].tolist(),
            "base_slave": bases["slave"].tolist(),
            "turn_nearest_to_print": gaps[assumed["base_yaw"]] == min(gaps.values()),
            "gap_by_turn": {str(yaw): gap for yaw, gap in gaps.items()},
        },
        caption=(
            f"Both arms at zero joints, turned by {assumed['base_yaw']:g} deg about the vertical, "
            f"which puts the tip {1e3 * gaps[assumed['base_yaw']]:.0f} mm from the printed start; "
            f"another quarter turn at least {1e3 * sorted(gaps.values())[1]:.0f} mm. The bases "
            "mirror each other in the yz plane, yet the arms do not: one is the other moved "
            f"{abs(assumed['base_translation']):g} m along x."
        ),
        alt="Stick figures of two equal arms side by side, both reaching "
        "along y at the same height.",
        figure=lambda: stick_figure({n: (a.arm, zero, a.placement) for n, a in arms.items()}),
        scene=lambda: standing(
            "Both arms at zero joints on the printed bases.", arms.values(), zero, (1.6, 1.9, 1.3)
        ),
    )


def gap_by_turn() -> dict[int, float]:
    """Distance of the master's tip at the printed joints from the printed one, for the quarter
    turns of its base [m]."""
    wanted, q = printed_numbers("qiu.claim_start", "tcp"), PRINTED.start
    return {
        yaw: float(np.linalg.norm(end_effector(placed("master", yaw=yaw), q) - wanted))
        for yaw in (0, 90, 180, 270)
    }


@checks(
    "qiu.claim_bases",
    rules=[
        Adopts("master", "base of the master [m]", to="master"),
        Adopts("slave", "base of the slave [m]", to="slave"),
    ],
)
def bases(assumed: Assumed) -> Result:
    """Positions of the bases in the scenario."""
    arms = {name: placed(name).placement for name in ARMS}
    shift = float((arms["slave"].translation - arms["master"].translation)[0])
    return Result(
        obtained={name: placement.translation.tolist() for name, placement in arms.items()},
        caption=f"Both bases are used as printed, {abs(shift):.3f} m apart along x.",
    )


@checks(
    "qiu.claim_obstacles",
    rules=[
        Adopts("radius", "radius of the spheres [m]", to="radius"),
        Adopts("centres", "centres of the spheres [m]", to="centres"),
    ],
)
def obstacles(assumed: Assumed) -> Result:
    """Both spheres, and how they stand to the printed goal."""
    gaps = goal_to_surface()
    return Result(
        obtained={
            "radius": PRINTED.radius,
            "centres": PRINTED.centres.tolist(),
            "goal_to_surface": gaps.tolist(),
        },
        caption=(
            f"Both spheres are used as printed. Their surfaces are {gaps[0]:.3f} m and "
            f"{gaps[1]:.3f} m from the printed goal of the master, inside the range "
            f"{PRINTED.influence:g} m of the repulsion."
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
        )
    ],
)
def start(assumed: Assumed) -> Result:
    """The tip at the printed joints against the printed tip."""
    return _start(assumed, "master", REGISTRY.printed("qiu.claim_start")["tcp"])


def _start(assumed: Assumed, name: str, printed: list[str]) -> Result:
    angles, base = PRINTED.start, PRINTED.bases[name]
    turn = pin.rpy.rpyToMatrix(0.0, 0.0, np.deg2rad(assumed["base_yaw"]))
    tip = pin.SE3(turn, base).act(flange_by_offsets(angles, assumed["link_lengths"]).translation)
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
    reading, wanted = Goal.of(assumed), PRINTED.master_goal
    q = reading.posture()
    tip = end_effector(reading.arm(), q)
    distance, moved = shoulder_to_goal(), float(np.linalg.norm(tip - wanted))
    lower, upper = np.deg2rad(np.array(assumed["joint_limits"], dtype=float)).T
    best = tip_posture(placed("master"), wanted, q, best_effort=True)
    inside, branches = pulled_back(placed("master"), wanted, reading.goal_radius), {}
    for branch in BRANCHES:
        posture = branch_posture(placed("master"), inside, branch, reading.goal_wrist)
        branches[branch] = None if posture is None else np.rad2deg(posture).tolist()
    return Result(
        obtained={
            "tcp": tip.tolist(),
            "q_deg": np.rad2deg(q).tolist(),
            "branch": reading.goal_branch,
            "beyond_limits": float(np.maximum(lower - q, q - upper).max()),
            "printed_distance": distance,
            "reach": reach(),
            "beyond_reach": distance - reach(),
            "moved": moved,
            "refusal": _refusal(),
            "nearest_reachable": best.tip.tolist(),
            "nearest_residual": best.residual,
            "branches_deg": branches,
        },
        table=_changes(),
        caption=(
            f"The printed goal is {distance:.4f} m from the shoulder and the straight arm reaches "
            f"{reach():.4f} m: {1e3 * (distance - reach()):.1f} mm are missing, and the planner "
            f"refuses it. The nearest reachable point is ({point(best.tip, 3)}) m. The goal "
            f"planned to is ({point(tip, 3)}) m, {1e3 * moved:.0f} mm from print "
            f"({_WAYS[reading.master_goal]}), with joints "
            f"{', '.join(f'{x:.1f}' for x in np.rad2deg(q))} deg."
        ),
    )


def _refusal() -> str:
    """The message with which the printed goal is refused."""
    try:
        tip_posture(placed("master"), PRINTED.master_goal, PRINTED.start)
    except InputError as error:
        return str(error)
    return ""


def _changes() -> pd.DataFrame:
    """Least change of one input after which the printed goal is within reach."""
    missing = shoulder_to_goal() - reach()
    flat = PRINTED.master_goal - shoulder(placed("master"))
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
        )
    ],
)
def slave_task(assumed: Assumed) -> Result:
    """Start and goal of the slave, and the postures that reach the goal."""
    printed = REGISTRY.printed("qiu.claim_slave_task")["start"]
    begin = _start(assumed, "slave", printed)
    reading = SlaveGoal.of(assumed)
    q, found = reading.slave_posture(), reading.slave_postures()
    tip = end_effector(placed("slave"), q)
    limits = np.deg2rad(np.array(assumed["joint_limits"], dtype=float))
    inside = [b for b, p in found.items() if ((p >= limits[:, 0]) & (p <= limits[:, 1])).all()]
    away = float(np.linalg.norm(PRINTED.slave_goal - shoulder(placed("slave"))))
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
    drawn = GoalBox.of(assumed).draw(SEED)
    centre = printed_numbers("qiu.claim_goals15", "centre")
    nearer = float(np.linalg.norm(PRINTED.centres - centre, axis=1).min()) - PRINTED.radius
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
            f"{len(drawn.q)} goals in a box of half width "
            f"{assumed['goal_set']:g} m; rejected draws: "
            + ", ".join(f"{count} {reason}" for reason, count in drawn.rejected.items())
            + f". The farthest is {1e3 * farthest:.0f} mm from the printed goal, the nearer "
            f"sphere {1e3 * nearer:.0f} mm."
        ),
    )
