"""Figures 7 and 12-14 of `qiu` and what is said about the two halves."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from ...ledger import REGISTRY, Assumed, Bounded, Is, NoOriginal, Result, Rounds
from ...planning.contact_check import ContactCheck, contact_check
from ...planning.search_plan import SearchPlan
from ...planning.splice import roughness
from ...view.scene3d import Scene3D
from ...view.search_curves import coordinate_figure, joint_figure, splice_figure
from ...view.style import GREEN, MASTER, ORANGE, PURPLE
from ...view.tip_paths import TipPanel, tip_path_figure
from ..wording import point
from .readings import (
    IMPROVED,
    improved_plan,
    reconstructed,
    smooth,
)
from .scenario import CENTRES, MEETING, START, spheres, truth_scene

checks = partial(REGISTRY.checks, page="qiu/two_sided")
_POSTURES = 6
_NEAR = {"tolerance": 0.01, "reason": "two runs that agree to one centimetre"}


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
    pairs = zip(plan.ends, MEETING, strict=True)
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
        Rounds(key="forward", to="forward", label="searches of the forward half"),
        Rounds(key="backward", to="backward", label="searches of the backward half"),
    ],
    samples=32,
)
def counts(assumed: Assumed) -> Result:
    """Searches until the halves meet, in both readings."""
    plans = _readings(assumed)
    face, other = (_summary(plan) for plan in plans.values())
    return Result(
        obtained={
            "forward": face["searches"],
            "backward": face["searches"],
            "face_value": face,
            "reconstruction": other,
        },
        caption=(
            f"The halves need {face['searches']} searches each with the printed gains and "
            f"{other['searches']} in the reconstruction; 31 are printed. At face value the joined "
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
    ],
    samples=32,
)
def meeting(assumed: Assumed) -> Result:
    """Where the halves end, against print."""
    plans = _readings(assumed)
    face, other = (_summary(plan) for plan in plans.values())
    printed_gap = float(np.linalg.norm(MEETING[0] - MEETING[1]))
    return Result(
        obtained={
            "forward": face["ends"][0],
            "backward": face["ends"][1],
            "gap_tip": face["gap_tip"],
            "printed_gap_tip": printed_gap,
            "distance_to_print": face["distance_to_print"],
            "reconstruction": other,
        },
        caption=(
            f"At face value the halves meet at ({point(np.array(face['ends'][0]), 3)}) m, "
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
        Is(key="joined", value=True, label="the two halves meet"),
        NoOriginal(key="path", label="the path"),
    ],
    samples=32,
)
def both_halves(assumed: Assumed) -> Result:
    """Flange paths of both halves among the spheres."""
    plans = _readings(assumed)
    panels = [
        TipPanel(
            name,
            {"forward": plan.half_tcp[0], "backward": plan.half_tcp[1]},
            [(plan.problem.placed, q) for q in plan.path[:: max(1, len(plan.path) // _POSTURES)]],
            {"printed ends": MEETING},
        )
        for name, plan in plans.items()
    ]
    face = plans["face value"]
    return Result(
        obtained={
            "joined": face.reached,
            "reconstruction_joined": plans["reconstruction"].reached,
            "clearance": truth(face).clearance,
            "clearance_reconstruction": truth(plans["reconstruction"]).clearance,
        },
        table=face.to_frame(),
        caption=(
            f"The halves meet after {face.searches} searches at face value, at z = "
            f"{face.ends[0][2]:.3f} m, and after {plans['reconstruction'].searches} in the "
            f"reconstruction, at z = {plans['reconstruction'].ends[0][2]:.3f} m; the printed ends "
            "of the "
            f"halves are at z = {MEETING[0, 2]:.3f} and {MEETING[1, 2]:.3f} m."
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
        Bounded(
            key="roughness_ratio", high=1.0, label="curvature after the spline over that before"
        ),
        Bounded(key="end_shift", high=1e-5, label="shift of the ends of the path [rad]"),
        NoOriginal(key="curves", label="the curves"),
    ],
    samples=32,
)
def splice(assumed: Assumed) -> Result:
    """Joints 4 and 5 around the junction, raw and smoothed, with clearance and limits checked
    again.
    """
    plans = _readings(assumed)
    face, other = plans.values()
    path = smooth(assumed, face)
    before, after = truth(face), truth(face, path)
    table = pd.DataFrame(
        {f"q{j}_{kind}_deg": np.rad2deg(rows[:, j - 1])
         for j in (4, 5) for kind, rows in (("joined", face.path), ("smoothed", path))}
    )  # fmt: skip
    return Result(
        obtained={
            "roughness_ratio": roughness(path) / roughness(face.path),
            "end_shift": float(np.abs(path[[0, -1]] - face.path[[0, -1]]).max()),
            "clearance_change": after.smallest - before.smallest,
            "beyond_limits": after.beyond_limits,
            "joint_4_moves": float(np.ptp(other.path[:, 3])),
        },
        table=table,
        caption=(
            "The spline lowers the curvature of the path to "
            f"{roughness(path) / roughness(face.path):.1%} "
            f"of its value and changes the smallest clearance by "
            f"{1e3 * (after.smallest - before.smallest):.1f} mm. With zero wrist angles at both "
            "ends joint "
            f"4 moves by {np.rad2deg(np.ptp(other.path[:, 3])):.2f} deg at most, whereas Fig. 7 of "
            "the "
            "document shows joint 4: its goal posture was another one."
        ),
        alt="Joints 4 and 5 around the junction of the halves, as joined and after smoothing.",
        figure=lambda: splice_figure(face.path, path, face.searches + 0.5, (3, 4)),
    )


@checks(
    "qiu.fig13",
    rules=[
        Bounded(
            key="largest_step", high=0.1, label="largest step of a joint on the smoothed path [rad]"
        ),
        NoOriginal(key="curves", label="the curves"),
    ],
    samples=32,
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
            "Joint angles along the smoothed path in both readings, the junction dotted. Only "
            "joints 1 to "
            "3 have far to go; the printed curves are lost."
        ),
        alt="Six panels of joint angles over the samples of the path, for two readings.",
        figure=lambda: joint_figure(paths, [plan.searches + 0.5 for plan in plans.values()]),
    )


@checks(
    "qiu.fig14",
    rules=[
        Bounded(key="start_error", high=1e-3, label="distance of the first point to the start [m]"),
        Bounded(key="goal_error", high=1e-3, label="distance of the last point to the goal [m]"),
        NoOriginal(key="curves", label="the curves"),
    ],
    samples=32,
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
            "lowest": {name: float(tip[:, 2].min()) for name, tip in tips.items()},
        },
        table=table,
        caption=(
            "Coordinates of the flange on the smoothed path; its lowest point is at z = "
            f"{tips['face value'][:, 2].min():.3f} m at face value and "
            f"{tips['reconstruction'][:, 2].min():.3f} m in the reconstruction. The printed ends "
            "of the "
            "halves, dashed and dotted, are higher. The printed curves are lost."
        ),
        alt="Three panels with x, y and z of the flange over the path for two readings.",
        figure=lambda: coordinate_figure(
            tips,
            {"printed, forward": MEETING[0], "printed, backward": MEETING[1]},
            "sample of the path",
        ),
    )


def _tip(plan: SearchPlan, path: np.ndarray) -> np.ndarray:
    placed = plan.problem.placed
    return placed.arm.positions(path) @ placed.placement.rotation.T + placed.placement.translation
