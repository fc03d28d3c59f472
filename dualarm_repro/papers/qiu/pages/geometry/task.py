"""Figure 3, equation (3) and the inputs of `qiu`: bases, obstacles, starts and goals, audited."""

from __future__ import annotations

from functools import partial
from itertools import product
from typing import Any

import numpy as np
import pandas as pd
import pinocchio as pin

from .....errors import InputError
from .....ledger import REGISTRY, Adopts, Assumed, Bounded, Is, NoOriginal, Residual, Result, Rounds
from .....ledger.assumptions import alternatives, hashable
from .....ledger.captions import captions
from .....ledger.printed import read_number
from .....ledger.printed_values import printed_numbers
from .....ledger.rules import Role
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
    printed_side,
    reach,
    shoulder_to_goal,
)
from ...ends import JOINT_COLUMNS, TIP_COLUMNS
from ...reading import Goal, GoalBox, SlaveGoal
from .arm import flange_by_offsets

checks = partial(REGISTRY.checks, page="qiu/geometry")
caption = captions(__file__)
_SETS = 4  # of goals that Table 2 is made of
_given = partial(Rounds, tolerance=1e-12, reason="difference of two printed inputs")


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
    bases, shift = PRINTED.bases, np.array([assumed["base_translation"], 0.0, 0.0])
    vectors = {"X_slaver": bases["slave"], "X_master": bases["master"], "T_trans": shift}
    given = {name: pin.SE3(np.eye(3), at).homogeneous for name, at in vectors.items()}
    left, right = (printed_side("eq03", side, given) for side in (0, 1))
    return Result(
        obtained={"translation": shift.tolist(), "miss": float(np.abs(left - right).max())},
        caption=caption("eq03"),
    )


@checks(
    "qiu.fig03",
    rules=[
        _given("base_master", "base of the master [m]", to="base_master"),
        _given("base_slave", "base of the slave [m]", to="base_slave"),
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
        caption=caption(
            "fig03", yaw=assumed["base_yaw"], gaps=gaps, shift=abs(assumed["base_translation"])
        ),
        alt="Stick figures of two equal arms side by side, both reaching along y at the same "
        "height.",
        figure=lambda: stick_figure({n: (a.arm, zero, a.placement) for n, a in arms.items()}),
        scene=lambda: standing(
            "Both arms at zero joints on the printed bases.", arms.values(), zero, (1.6, 1.9, 1.3)
        ),
    )


def _start_tips() -> dict[str, np.ndarray]:
    """The printed start tips of both arms (3,) [m]."""
    master = printed_numbers("qiu.claim_start", "tcp")
    return {"master": master, "slave": printed_numbers("qiu.claim_slave_task", "start")}


@checks(
    "qiu.claim_same_posture",
    rules=[
        Residual("tips", "start tips seen from their bases, difference [m]", high=1e-12),
        Residual(
            "postures",
            "joints of both arms at their start tips, difference by branch and wrist [rad]",
            high=1e-9,
        ),
        Bounded("reached", "branches and wrists that take both arms to their tips", low=1.0),
    ],
)
def same_posture(assumed: Assumed) -> Result:
    """The printed start tips, each seen from its own base, and the postures that reach them."""
    seen = {name: tip - PRINTED.bases[name] for name, tip in _start_tips().items()}
    postures = start_postures()
    both = [(q, postures["slave"][case]) for case, q in postures["master"].items()]
    apart = [_turned(*pair) for pair in both if any(q is not None for q in pair)]
    return Result(
        obtained={
            "tips": float(np.abs(seen["master"] - seen["slave"]).max()),
            "postures": max(apart, default=np.inf),
            "reached": len(apart),
            "tried": len(both),
            "seen": {n: at.tolist() for n, at in seen.items()},
        },
        caption=caption("claim_same_posture"),
    )


def start_postures() -> dict[str, dict[tuple[str, tuple[float, ...]], np.ndarray | None]]:
    """Postures (6,) [rad] that take each arm on its base to its printed start tip, by branch and
    declared wrist; None beyond reach."""
    cases = list(product(BRANCHES, map(hashable, alternatives("qiu.goal_wrist", 0))))
    return {
        name: {(b, wrist): branch_posture(placed(name), tip, b, wrist) for b, wrist in cases}
        for name, tip in _start_tips().items()
    }


def _turned(one: np.ndarray | None, other: np.ndarray | None) -> float:
    """Largest difference of a joint [rad], by the shorter way; unbounded if one is missing."""
    if one is None or other is None:
        return np.inf
    return float(np.abs((one - other + np.pi) % (2.0 * np.pi) - np.pi).max())


@checks(
    "qiu.claim_symmetric",
    rules=[
        Bounded(
            "about_x",
            "slave base from the master base mirrored at the X axis [m]",
            low="apart",
            role=Role.CONTRADICTS,
        )
    ],
)
def symmetric(assumed: Assumed) -> Result:
    """The printed bases and start tips, mirrored at the X axis and at the YZ plane."""
    miss = {}
    for name, signs in (("about_x", (1, -1, -1)), ("in_yz", (-1, 1, 1))):
        pairs = [PRINTED.bases, _start_tips()]
        gaps = [np.linalg.norm(pair["master"] * signs - pair["slave"]) for pair in pairs]
        miss[name], miss[f"{name}_tip"] = map(float, gaps)
    return Result(obtained=miss, caption=caption("claim_symmetric"))


@checks(
    "qiu.claim_overlap",
    rules=[Bounded("overlap", "twice the reach minus the distance of the bases [m]", low=0.0)],
)
def overlap(assumed: Assumed) -> Result:
    """Distance of the printed bases against the reach of both arms."""
    size = assumed["link_lengths"]
    long = size["a2"] + float(np.hypot(size["a3"], size["d4"])) + size["d6"]
    apart = float(np.linalg.norm(np.subtract(*PRINTED.bases.values())))
    return Result(
        obtained={"overlap": 2.0 * long - apart, "apart": apart, "reach": long},
        caption=caption("claim_overlap"),
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
    return Result(
        obtained={
            "radius": PRINTED.radius,
            "centres": PRINTED.centres.tolist(),
            "goal_to_surface": goal_to_surface().tolist(),
        },
        caption=caption("claim_obstacles", reach=PRINTED.influence),
    )


def _contradiction(printed: str) -> Bounded:
    """The rule that the printed start and the printed joints exclude each other."""
    label = f"{printed} against the tip at the printed joints, beyond the printed digits [m]"
    return Bounded("beyond_digits", label, low=0.0, role=Role.CONTRADICTS)


@checks("qiu.claim_start", rules=[_contradiction("printed tip")])
def start(assumed: Assumed) -> Result:
    """The tip at the printed joints against the printed tip."""
    begin = _start(assumed, "master", REGISTRY.printed("qiu.claim_start")["tcp"])
    obtained = {key: begin[key] for key in ("tcp", "gap", "beyond_digits")}
    return Result({"q": PRINTED.start.tolist(), **obtained}, caption("start", **begin))


def _start(assumed: Assumed, name: str, printed: list[str]) -> dict[str, Any]:
    """The tip of an arm at the printed joints, how far it is from the printed one along each axis
    and in all, and the largest part of that beyond the printed digits [m]."""
    turn = pin.rpy.rpyToMatrix(0.0, 0.0, np.deg2rad(assumed["base_yaw"]))
    flange = flange_by_offsets(PRINTED.start, assumed["link_lengths"]).translation
    tip = pin.SE3(turn, PRINTED.bases[name]).act(flange)
    there, half = np.transpose([read_number(text) for text in printed])
    gaps = abs(tip - there)
    return {
        "arm": name,
        "tcp": tip.tolist(),
        "gaps": gaps,
        "gap": float(np.linalg.norm(gaps)),
        "beyond_digits": float(max(gaps - half)),
    }


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
    distance = shoulder_to_goal()
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
            "moved": float(np.linalg.norm(tip - wanted)),
            "refusal": _refusal(),
            "nearest_reachable": best.tip.tolist(),
            "nearest_residual": best.residual,
            "branches_deg": branches,
        },
        table=_changes(),
        caption=caption("claim_goal", reading=reading.master_goal),
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


@checks("qiu.claim_slave_task", rules=[_contradiction("printed start")])
def slave_task(assumed: Assumed) -> Result:
    """Start and goal of the slave, and the postures that reach the goal."""
    printed, reading = REGISTRY.printed("qiu.claim_slave_task")["start"], SlaveGoal.of(assumed)
    begin = _start(assumed, "slave", printed)
    q, found = reading.slave_posture(), reading.slave_postures()
    limits = np.deg2rad(np.array(assumed["joint_limits"], dtype=float))
    inside = [b for b, p in found.items() if ((p >= limits[:, 0]) & (p <= limits[:, 1])).all()]
    return Result(
        obtained={
            "start": begin["tcp"],
            "beyond_digits": begin["beyond_digits"],
            "goal": end_effector(placed("slave"), q).tolist(),
            "q_deg": np.rad2deg(q).tolist(),
            "distance": float(np.linalg.norm(PRINTED.slave_goal - shoulder(placed("slave")))),
            "branches_within_limits": inside,
        },
        caption=caption("start", **begin, postures=len(found)),
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
    """A seeded set of goals with its rejections; near means nearer than the nearer sphere is."""
    drawn = GoalBox.of(assumed).draw(SEED)
    centre = printed_numbers("qiu.claim_goals15", "centre")
    nearer = float(np.linalg.norm(PRINTED.centres - centre, axis=1).min()) - PRINTED.radius
    farthest = float(np.linalg.norm(drawn.points - centre, axis=1).max(initial=0.0))
    box, tables = GoalBox.of(assumed), []
    for seed in range(SEED, SEED + _SETS):
        one = drawn if seed == SEED else box.draw(seed)
        points = pd.DataFrame(one.points, columns=TIP_COLUMNS).assign(seed=seed)
        points[JOINT_COLUMNS] = np.rad2deg(one.q)
        tables.append(points)
    return Result(
        obtained={
            "count": len(np.unique(drawn.points, axis=0)),
            "beyond_neighbourhood": farthest - nearer,
            "farthest": farthest,
            "rejected": drawn.rejected,
        },
        table=pd.concat(tables, ignore_index=True),
        caption=caption(
            "claim_goals15", goals=len(drawn.q), width=assumed["goal_set"], nearer=nearer
        ),
    )
