"""Figures 7 and 12-14 of `qiu` and what is said about the two halves."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from ...ledger import REGISTRY, Assumed, Bounded, Is, NoOriginal, Result, Rounds
from ...planning.checks.contact_check import ContactCheck, contact_check
from ...planning.search.search_plan import SearchPlan
from ...planning.search.splice import roughness
from ...view.scene3d import Scene3D
from ...view.search_curves import coordinate_figure, joint_figure, splice_figure
from ...view.style import GREEN, MASTER, ORANGE, PURPLE
from ...view.tip_paths import TipPanel, tip_path_figure
from ..wording import point
from .printed_points import meeting as printed_meeting
from .readings import (
    IMPROVED,
    improved_plan,
    reconstructed,
    smooth,
)
from .scenario import CENTRES, START, spheres, truth_scene

checks = partial(REGISTRY.checks, page="qiu/two_sided")
_POSTURES = 6
_NEAR = {
    "tolerance": 0.016,
    "reason": "half the way of the flange of the straight arm in one printed step",
}


def _readings(assumed: Assumed) -> dict[str, SearchPlan]:
    """The search from both ends at face value and in the reconstruction."""
    return {
        "face value": improved_plan(assumed),
        "reconstruction": improved_plan(reconstructed(assumed, IMPROVED)),
    }


def truth(plan: SearchPlan, path: np.ndarray | None = None) -> ContactCheck:
    """Contact of the whole master on a path, by default the joined one."""
    scene = truth_scene([plan.problem.placed])
    return contact_check(scene, plan.path if path is None else path)


def _summary(plan: SearchPlan) -> dict[str, Any]:
    check = truth(plan)
    pairs = zip(plan.ends, printed_meeting(), strict=True)
    away = [float(np.linalg.norm(end - printed)) for end, printed in pairs]
    return {
        "reason": str(plan.reason),
        "searches": plan.searches,
        "ends": [end.tolist() for end in plan.ends],
        "gap_rad": plan.gap,
        "gap_tip": float(np.linalg.norm(plan.ends[0] - plan.ends[1])),
        "distance_to_print": away,
        "free": check.free,
        "clearance": check.clearance,
    }


@checks(
    "qiu.claim_bi_counts",
    rules=[
        Rounds("forward", "searches of the forward half", to="forward"),
        Rounds("backward", "searches of the backward half", to="backward"),
        Is("joined", "the two halves meet", value=True),
    ],
)
def counts(assumed: Assumed) -> Result:
    """Searches until the halves meet, in both readings."""
    plans = _readings(assumed)
    face, other = (_summary(plan) for plan in plans.values())
    return Result(
        obtained={
            "forward": face["searches"],
            "backward": face["searches"],
            "joined": face["reason"] == "reached",
            "face_value": face,
            "reconstruction": other,
        },
        caption=(
            f"The halves need {face['searches']} searches each with the printed gains and "
            f"{other['searches']} in the reconstruction; "
            f"{REGISTRY.printed('qiu.claim_bi_counts')['forward']} are printed. At face value the "
            "joined "
            "path " + ("is free of contact." if face["free"] else _worst(face))
        ),
    )


def _worst(summary: dict[str, Any]) -> str:
    name, value = min(summary["clearance"].items(), key=lambda pair: pair[1])
    return f"is not free: the smallest distance, {1e3 * value:.0f} mm, is to the {name}."


@checks(
    "qiu.claim_bi_meet",
    rules=[
        Rounds(key="forward", to="forward", label="end of the forward half [m]", **_NEAR),
        Rounds(key="backward", to="backward", label="end of the backward half [m]", **_NEAR),
        Is("joined", "the two halves meet", value=True),
    ],
)
def meeting(assumed: Assumed) -> Result:
    """Where the halves end, against print."""
    plans = _readings(assumed)
    face, other = (_summary(plan) for plan in plans.values())
    printed_gap = float(np.linalg.norm(printed_meeting()[0] - printed_meeting()[1]))
    return Result(
        obtained={
            "forward": face["ends"][0],
            "backward": face["ends"][1],
            "joined": face["reason"] == "reached",
            "gap_tip": face["gap_tip"],
            "printed_gap_tip": printed_gap,
            "distance_to_print": face["distance_to_print"],
            "reconstruction": other,
        },
        caption=(
            f"At face value the halves end ({face['reason']}) at "
            f"({point(np.array(face['ends'][0]), 3)}) m, "
            f"{1e3 * max(face['distance_to_print']):.0f} mm from print; in the reconstruction at "
            f"({point(np.array(other['ends'][0]), 3)}) m, "
            f"{1e3 * max(other['distance_to_print']):.0f} mm "
            f"from print. The centre of the first sphere is at z = {CENTRES[0, 2]:.3f} m. The gap "
            "of the "
            f"tips is {1e3 * face['gap_tip']:.1f} mm, printed {1e3 * printed_gap:.1f} mm."
        ),
    )


@checks(
    "qiu.fig12",
    rules=[
        Bounded("apart", "joint distance of the halves beyond the tolerance [rad]", high=0.0),
        NoOriginal("path", "the path"),
    ],
)
def both_halves(assumed: Assumed) -> Result:
    """Flange paths of both halves among the spheres."""
    plans = _readings(assumed)
    panels = [
        TipPanel(
            name,
            {"forward": plan.half_tcp[0], "backward": plan.half_tcp[1]},
            [(plan.problem.placed, q) for q in plan.path[:: max(1, len(plan.path) // _POSTURES)]],
            {"printed ends": printed_meeting()},
        )
        for name, plan in plans.items()
    ]
    face = plans["face value"]
    return Result(
        obtained={
            "apart": face.gap - assumed["joint_tolerance"],
            "reconstruction_joined": plans["reconstruction"].reached,
            "clearance": truth(face).clearance,
            "clearance_reconstruction": truth(plans["reconstruction"]).clearance,
        },
        table=face.to_frame(),
        caption=(
            f"The halves end ({face.reason}) after {face.searches} searches at face value, at z = "
            f"{face.ends[0][2]:.3f} m, and after {plans['reconstruction'].searches} in the "
            f"reconstruction, at z = {plans['reconstruction'].ends[0][2]:.3f} m; the printed ends "
            "of the "
            f"halves are at z = {printed_meeting()[0, 2]:.3f} and {printed_meeting()[1, 2]:.3f} m."
        ),
        alt="Two panels with two spheres, postures of the arm and the two halves of its flange "
        "path that "
        "meet, and the printed end points of the halves.",
        figure=lambda: tip_path_figure(panels, list(spheres().values()), azim=35),
        scene=lambda: _scene(plans["reconstruction"]),
    )


def _scene(plan: SearchPlan) -> Scene3D:
    """The joined path, played, with both halves of the flange path."""
    placed = plan.problem.placed
    made = Scene3D(
        "Reconstruction: both halves of the master's path, forward and backward.",
        camera=(1.4, 0.9, 1.2),
    )
    for name, sphere in spheres().items():
        made.add_sphere(name, sphere.center, sphere.radius, ORANGE)
    made.add_arm("master", placed.arm, START, placed.placement, MASTER)
    for name, tcp, color in zip(
        ("forward", "backward"), plan.half_tcp, (GREEN, PURPLE), strict=True
    ):
        made.add_path(name, tcp, color)
    made.animate({"master": (placed.arm, plan.path)})
    return made


@checks(
    "qiu.fig07",
    rules=[
        Bounded("least_range", "range of the joint shown that moves least [rad]", low="visible"),
        Bounded("junction_ratio", "bend at the junction, smoothed over joined", high="smoother"),
        Bounded("end_shift", "shift of the ends of the path [rad]", high="held"),
        NoOriginal("curves", "the curves"),
    ],
)
def splice(assumed: Assumed) -> Result:
    """Joints 4 and 5 around the junction, raw and smoothed, with clearance and limits checked
    again.
    """
    face = improved_plan(assumed)
    shown = [int(text) for text in REGISTRY.printed("qiu.fig07")["joints"]]
    path = smooth(assumed, face)
    before, after = truth(face), truth(face, path)
    table = pd.DataFrame(
        {f"q{j}_{kind}_deg": np.rad2deg(rows[:, j - 1])
         for j in shown for kind, rows in (("joined", face.path), ("smoothed", path))}
    )  # fmt: skip
    ranges = {j: float(np.ptp(path[:, j - 1])) for j in shown}
    bends = [_bend(rows, face.searches) for rows in (path, face.path)]
    ratio = bends[0] / bends[1] if bends[1] > 0.0 else 1.0
    change = after.smallest - before.smallest
    return Result(
        obtained={
            "least_range": min(ranges.values()),
            "junction_ratio": ratio,
            "end_shift": float(np.abs(path[[0, -1]] - face.path[[0, -1]]).max()),
            "roughness_ratio": roughness(path) / roughness(face.path),
            "clearance_change": change,
            "beyond_limits": after.beyond_limits,
        },
        table=table,
        caption=(
            "Of the joints that the figure of the document shows, "
            + " and ".join(f"joint {j} moves by {np.rad2deg(r):.2f} deg" for j, r in ranges.items())
            + f" with wrist angles of {assumed['goal_wrist']} rad at the goal. The spline brings "
            f"the bend at the junction to {ratio:.1%} and the curvature of the path to "
            f"{roughness(path) / roughness(face.path):.1%} of what it was, and changes the "
            f"smallest clearance by {1e3 * change:.1f} mm."
        ),
        alt="Joints 4 and 5 around the junction of the halves, as joined and after smoothing.",
        figure=lambda: splice_figure(
            face.path, path, face.searches + 0.5, tuple(j - 1 for j in shown)
        ),
    )


def _bend(path: np.ndarray, junction: int) -> float:
    """Largest second difference at the two samples of the junction [rad]."""
    second = np.linalg.norm(np.diff(path, 2, axis=0), axis=1)
    return float(second[junction - 1 : junction + 1].max())


@checks(
    "qiu.fig13",
    rules=[
        Bounded(
            "largest_step", "largest step of a joint on the smoothed path [rad]", high="two_steps"
        ),
        NoOriginal("curves", "the curves"),
    ],
)
def joint_angles(assumed: Assumed) -> Result:
    """All joint angles of the joined and smoothed path."""
    plans = _readings(assumed)
    paths = {name: smooth(assumed, plan) for name, plan in plans.items()}
    step = float(np.abs(np.diff(paths["face value"], axis=0)).max())
    table = pd.DataFrame(
        np.rad2deg(paths["face value"]), columns=[f"q{j}_deg" for j in range(1, 7)]
    )
    return Result(
        obtained={
            "largest_step": step,
            "range_deg": np.rad2deg(np.ptp(paths["face value"], axis=0)).tolist(),
        },
        table=table,
        caption=(
            "Joint angles along the smoothed path in both readings, the junction dotted. At face "
            "value the joints move by "
            + ", ".join(f"{x:.0f}" for x in np.rad2deg(np.ptp(paths["face value"], axis=0)))
            + " deg; the printed curves are lost."
        ),
        alt="Six panels of joint angles over the samples of the path, for two readings.",
        figure=lambda: joint_figure(paths, [plan.searches + 0.5 for plan in plans.values()]),
    )


@checks(
    "qiu.fig14",
    rules=[
        Bounded("start_error", "distance of the first point to the start [m]", high="held"),
        Bounded("goal_error", "distance of the last point to the goal [m]", high="held"),
        Bounded("largest_step", "largest step of the flange on the path [m]", high="two_steps"),
        NoOriginal("curves", "the curves"),
    ],
)
def tip_coordinates(assumed: Assumed) -> Result:
    """Coordinates of the flange on the joined and smoothed path."""
    plans = _readings(assumed)
    tips = {name: _tip(plan, smooth(assumed, plan)) for name, plan in plans.items()}
    face = plans["face value"]
    ends = [np.linalg.norm(tips["face value"][k] - face.tcp[k]) for k in (0, -1)]
    table = pd.DataFrame(tips["face value"], columns=["x_m", "y_m", "z_m"])
    return Result(
        obtained={
            "start_error": float(ends[0]),
            "goal_error": float(ends[1]),
            "largest_step": _largest_step(tips["face value"]),
            "lowest": {name: float(tip[:, 2].min()) for name, tip in tips.items()},
        },
        table=table,
        caption=(
            "Coordinates of the flange on the smoothed path; its lowest point is at z = "
            f"{tips['face value'][:, 2].min():.3f} m at face value and "
            f"{tips['reconstruction'][:, 2].min():.3f} m in the reconstruction; the printed ends "
            f"of the halves, dashed and dotted, are at z = {printed_meeting()[0, 2]:.3f} and "
            f"{printed_meeting()[1, 2]:.3f} m. The printed curves are lost."
        ),
        alt="Three panels with x, y and z of the flange over the path for two readings.",
        figure=lambda: coordinate_figure(
            tips,
            {"printed, forward": printed_meeting()[0], "printed, backward": printed_meeting()[1]},
            "sample of the path",
        ),
    )


def _largest_step(rows: np.ndarray) -> float:
    return float(np.linalg.norm(np.diff(rows, axis=0), axis=1).max())


def _tip(plan: SearchPlan, path: np.ndarray) -> np.ndarray:
    placed = plan.problem.placed
    return placed.arm.positions(path) @ placed.placement.rotation.T + placed.placement.translation
