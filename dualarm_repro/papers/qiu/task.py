"""Inputs of `qiu`: obstacles, starts, goals, gains and lengths, audited against the arm."""

from __future__ import annotations

from functools import partial

import numpy as np
import pandas as pd

from ...errors import InputError
from ...ledger import REGISTRY, Adopts, Assumed, Bounded, Is, Result, Role
from ...planning.control_points import end_effector
from ...planning.tip_goal import tip_posture
from ...scene import distances
from ..wording import point
from .goals import draw_goals
from .readings import master_arm, master_posture, slave_posture, slave_postures
from .scenario import (
    ALPHA0,
    BASES,
    BRANCHES,
    CENTRES,
    INFLUENCE,
    MASTER_GOAL,
    RADIUS,
    SEED,
    SLAVE_GOAL,
    START,
    THRESHOLD,
    ZETA,
    branch_posture,
    lengths,
    placed,
    pulled_back,
    reach,
    shoulder,
    truth_scene,
)

checks = partial(REGISTRY.checks, page="qiu/geometry")
inputs = partial(REGISTRY.checks, page="qiu/field")
_SCALE = {"rad": 1.0, "deg": np.pi / 180.0}


@checks(
    "qiu.claim_obstacles",
    rules=[
        Adopts(key="radius", to="radius", label="radius of the spheres [m]"),
        Adopts(key="centres", to="centres", label="centres of the spheres [m]"),
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
        Adopts(key="q", to="q", label="start angles used"),
        Bounded(
            key="excess", high=0.0, label="distance to the printed tip beyond the tolerance [m]"
        ),
    ],
    samples=32,
)
def start(assumed: Assumed) -> Result:
    """The tip at zero joints against the printed tip."""
    return _start(assumed, "master", REGISTRY.printed("qiu.claim_start")["tcp"])


def _start(assumed: Assumed, name: str, printed: list[str]) -> Result:
    arm = placed(name, yaw=assumed["base_yaw"])
    tip = end_effector(arm, START)
    wanted = np.array([float(text) for text in printed])
    gap = float(np.linalg.norm(tip - wanted))
    used = {"zero_joints": START, "printed_tip": None}[assumed["start_pose"]]
    known = max(abs(lengths()[key] - value) for key, value in assumed["link_lengths"].items())
    return Result(
        obtained={
            "q": None if used is None else used.tolist(),
            "tcp": tip.tolist(),
            "gap": gap,
            "excess": gap - assumed["start_tolerance"],
            "length_difference": known,
        },
        caption=(
            f"At zero joints the flange of the {name} is at ({point(tip, 3)}) m, "
            f"{1e3 * gap:.1f} mm from the printed tip: {1e3 * abs(tip[1] - wanted[1]):.0f} mm in y "
            "and "
            f"{1e3 * abs(tip[2] - wanted[2]):.0f} mm in height. The joint angles are used."
        ),
    )


@checks(
    "qiu.claim_goal",
    samples=32,
    rules=[
        Adopts(key="tcp", to="tcp", label="flange at the goal that is planned to [m]"),
        Is(key="within_limits", value=True, label="the goal posture is within the joint limits"),
    ],
    change="moved along the ray from the shoulder into the reach of the arm, 44 mm towards it",
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
    known = max(abs(lengths()[key] - value) for key, value in assumed["link_lengths"].items())
    return Result(
        obtained={
            "tcp": tip.tolist(),
            "q_deg": np.rad2deg(q).tolist(),
            "branch": assumed["goal_branch"],
            "within_limits": bool(((q >= lower) & (q <= upper)).all()),
            "printed_distance": distance,
            "reach": reach(),
            "beyond_reach": distance - reach(),
            "moved": float(np.linalg.norm(tip - MASTER_GOAL)),
            "refusal": error,
            "nearest_reachable": best.tip.tolist(),
            "nearest_residual": best.residual,
            "branches_deg": branches,
            "length_difference": known,
        },
        table=_changes(),
        caption=(
            f"The printed goal is {distance:.4f} m from the shoulder and the straight arm reaches "
            f"{reach():.4f} m: {1e3 * (distance - reach()):.1f} mm are missing, and the planner "
            "refuses "
            f"it. The nearest reachable point is ({point(best.tip, 3)}) m. The goal planned to is "
            f"({point(tip, 3)}) m, {1e3 * np.linalg.norm(tip - MASTER_GOAL):.0f} mm from print, "
            "with "
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
        Adopts(key="goal", to="goal", label="flange of the slave at its goal [m]"),
        Bounded(
            key="excess", high=0.0, label="distance to the printed start beyond the tolerance [m]"
        ),
        Is(
            key="branches_within_limits",
            value=1,
            label="postures to the goal within the joint limits",
        ),
    ],
    samples=32,
)
def slave_task(assumed: Assumed) -> Result:
    """Start and goal of the slave, and the postures that reach the goal."""
    printed = REGISTRY.printed("qiu.claim_slave_task")["start"]
    begin = _start(assumed, "slave", printed)
    q = slave_posture(assumed)
    tip = end_effector(placed("slave", yaw=assumed["base_yaw"]), q)
    limits = np.deg2rad(np.array(assumed["joint_limits"], dtype=float))
    found = slave_postures(assumed)
    inside = [b for b, p in found.items() if ((p >= limits[:, 0]) & (p <= limits[:, 1])).all()]
    shift = float((BASES["slave"] - BASES["master"])[0]) - assumed["base_translation"]
    away = float(np.linalg.norm(SLAVE_GOAL - shoulder(BASES["slave"])))
    return Result(
        obtained={
            "start": begin.obtained["tcp"],
            "excess": begin.obtained["excess"],
            "goal": tip.tolist(),
            "q_deg": np.rad2deg(q).tolist(),
            "distance": away,
            "branches_within_limits": len(inside),
            "branch": inside[0] if inside else None,
            "translation_error": shift,
        },
        caption=(
            f"{begin.caption} Its goal is {away:.3f} m from the shoulder, within reach; of the "
            f"{len(found)} postures with zero wrist angles {len(inside)} is within the joint "
            "limits: "
            f"{', '.join(f'{x:.1f}' for x in np.rad2deg(q))} deg."
        ),
    )


@checks(
    "qiu.claim_goals15",
    samples=32,
    rules=[
        Adopts(key="count", to="count", label="number of goals"),
        Bounded(
            key="smallest_clearance", low=0.0, label="smallest clearance of a goal posture [m]"
        ),
    ],
)
def goals_15(assumed: Assumed) -> Result:
    """A seeded set of goals with its rejections."""
    drawn = draw_goals(assumed, SEED)
    scene = truth_scene([master_arm(assumed)])
    clearance = distances(scene, drawn.q).min(axis=1)
    table = pd.DataFrame(drawn.points, columns=["x_m", "y_m", "z_m"])
    table[[f"q{j}_deg" for j in range(1, 7)]] = np.rad2deg(drawn.q)
    return Result(
        obtained={
            "count": len(drawn.q),
            "rejected": drawn.rejected,
            "smallest_clearance": float(clearance.min()),
        },
        table=table,
        caption=(
            f"{len(drawn.q)} goals in a box of half width {assumed['goal_set']:g} m; rejected "
            "draws: "
            + ", ".join(f"{count} {reason}" for reason, count in drawn.rejected.items())
            + f". Goal postures are at least {1e3 * clearance.min():.0f} mm clear."
        ),
    )


@inputs(
    "qiu.claim_alpha0", samples=32, rules=[Adopts(key="alpha0", to="alpha0", label="first step")]
)
def first_step(assumed: Assumed) -> Result:
    """The first step, and whether its unit makes sense."""
    unit = assumed["angle_unit"]
    straight = float(np.linalg.norm(np.deg2rad([114.0, 29.8, -50.1])))
    needed = straight / (ALPHA0 * _SCALE[unit])
    return Result(
        obtained={"alpha0": ALPHA0, "unit": unit, "steps_for_the_straight_line": needed},
        caption=(
            f"The step is used as printed, in {unit}: the straight line of {straight:.2f} rad from "
            "start "
            f"to goal then takes {needed:.0f} steps, or half as many searches from both ends; 31 "
            "are "
            "printed."
        ),
    )


@inputs(
    "qiu.claim_d", samples=32, rules=[Adopts(key="d", to="d", label="threshold of the attraction")]
)
def threshold(assumed: Assumed) -> Result:
    """The threshold d, and the bound on the attraction it gives."""
    unit, measure = assumed["angle_unit"], assumed["attraction_form"]
    bound = THRESHOLD * _SCALE[unit] * ZETA
    return Result(
        obtained={"d": THRESHOLD, "unit": unit, "measure": measure, "largest_attraction": bound},
        caption=f"The threshold is used as printed, in {unit}; the attraction never exceeds "
        f"{bound:g}.",
    )


@inputs(
    "qiu.claim_zeta", samples=32, rules=[Adopts(key="zeta", to="zeta", label="attractive gain")]
)
def attractive_gain(assumed: Assumed) -> Result:
    """The attractive gain."""
    ratio = assumed["gain_ratio"]
    return Result(
        obtained={"zeta": ZETA, "ratio": ratio},
        caption=(
            "The gain is used as printed. As every step has the same length, only the ratio of the "
            f"repulsive gain to it counts, here {ratio:g}."
        ),
    )


@inputs(
    "qiu.claim_eta0",
    rules=[Adopts(key="eta0", to="eta0", label="initial repulsive gain")],
    change="another ratio to the attractive gain",
    samples=32,
)
def repulsive_gain(assumed: Assumed) -> Result:
    """The initial repulsive gain."""
    eta0 = assumed["gain_ratio"] * ZETA
    return Result(
        obtained={"eta0": eta0},
        caption=f"The initial repulsive gain of the runs at face value is {eta0:g}, as printed.",
    )


@inputs("qiu.claim_rho0", rules=[Adopts(key="rho0", to="rho0", label="range of the repulsion [m]")])
def repulsion_range(assumed: Assumed) -> Result:
    """The range of the repulsion."""
    centres = np.linalg.norm(MASTER_GOAL - CENTRES, axis=1) - RADIUS
    return Result(
        obtained={"rho0": INFLUENCE, "spheres_within": int((centres < INFLUENCE).sum())},
        caption=(
            "The range is used as printed, as the greatest distance; "
            f"{(centres < INFLUENCE).sum()} of "
            "the spheres are within it of the printed goal."
        ),
    )


@inputs(
    "qiu.claim_kappa_range",
    samples=32,
    rules=[
        Is(key="inside", value=True, role=Role.ADOPTS, label="kappa lies in the printed interval"),
    ],
)
def kappa_range(assumed: Assumed) -> Result:
    """The constant of the variable gain lies in the printed interval."""
    kappa, rule = assumed["kappa"], assumed["gain_rule"]
    return Result(
        obtained={"inside": 0.0 < kappa <= 1.0, "kappa": kappa, "rule": rule},
        caption=(
            f"kappa = {kappa:g} is inside the printed interval (0, 1]. Under the rule {rule} its "
            "upper "
            "end leaves the gain constant, which is a reason to include it in the interval."
        ),
    )


@inputs(
    "qiu.claim_tau_order",
    samples=32,
    rules=[Is(key="ordered", value=True, role=Role.ADOPTS, label="weights in the printed order")],
)
def weight_order(assumed: Assumed) -> Result:
    """The weights of the control points are in the printed order."""
    tau, points = assumed["weights"], assumed["control_points"]
    return Result(
        obtained={"ordered": 0 < tau[0] < tau[1] < tau[2], "weights": list(tau), "points": points},
        caption=f"Weights {', '.join(map(str, tau))} rise towards the flange, as printed.",
    )
