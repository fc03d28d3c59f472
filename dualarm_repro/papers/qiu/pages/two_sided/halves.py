"""Figures 7 and 12-14 of `qiu` and what is said about the two halves."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from .....ledger import REGISTRY, Assumed, Bounded, NoOriginal, Result
from .....ledger.captions import point
from .....planning.checks.contact_check import ContactCheck, contact_check
from .....planning.field.control_points import end_effector
from .....planning.search.search_plan import SearchPlan
from .....planning.search.splice import roughness
from .....view.arm_scenes import played_search, search_panel
from .....view.scene3d import Scene3D
from .....view.search_curves import coordinate_figure, joint_figure, splice_figure
from .....view.style import GREEN, PURPLE
from .....view.tip_paths import tip_path_figure
from ...document import FACE_VALUE, PRINTED, RECONSTRUCTION, spheres, truth_scene
from ...ends import count_rules, counted, meeting_rules, met, outcome
from ...reading import Improved, Splice

checks = partial(REGISTRY.checks, page="qiu/two_sided")


def truth(plan: SearchPlan, path: np.ndarray | None = None) -> ContactCheck:
    """Contact of the whole master on a path, by default the joined one."""
    scene = truth_scene([plan.problem.placed])
    return contact_check(scene, plan.path if path is None else path)


def _summary(plan: SearchPlan) -> dict[str, Any]:
    check = truth(plan)
    contact = {"gap_rad": plan.gap, "free": check.free, "clearance": check.clearance}
    return outcome(plan, PRINTED.meeting) | contact


@checks("qiu.claim_bi_counts", rules=count_rules("the two halves meet"))
def counts(assumed: Assumed) -> Result:
    """Searches until the halves meet, in both readings."""
    plans = Improved.of(assumed).readings()
    face, other = (_summary(plan) for plan in plans.values())
    return Result(
        obtained=counted(face, other),
        caption=(
            f"The halves need {face['searches']} searches each with the printed gains and "
            f"{other['searches']} in the reconstruction; "
            f"{REGISTRY.printed('qiu.claim_bi_counts')['forward']} are printed. At face value the "
            "joined path " + ("is free of contact." if face["free"] else _worst(face))
        ),
    )


def _worst(summary: dict[str, Any]) -> str:
    name, value = min(summary["clearance"].items(), key=lambda pair: pair[1])
    return f"is not free: the smallest distance, {1e3 * value:.0f} mm, is to the {name}."


@checks("qiu.claim_bi_meet", rules=meeting_rules("the two halves meet"))
def meeting(assumed: Assumed) -> Result:
    """Where the halves end, against print."""
    plans = Improved.of(assumed).readings()
    face, other = (_summary(plan) for plan in plans.values())
    made = met(face, other, PRINTED.meeting)
    return Result(
        obtained=made,
        caption=(
            f"At face value the halves end ({face['reason']}) at "
            f"({point(np.array(face['ends'][0]), 3)}) m, "
            f"{1e3 * max(face['distance_to_print']):.0f} mm from print; in the reconstruction at "
            f"({point(np.array(other['ends'][0]), 3)}) m, "
            f"{1e3 * max(other['distance_to_print']):.0f} mm from print. The centre of the first "
            f"sphere is at z = {PRINTED.centres[0, 2]:.3f} m. The gap of the tips is "
            f"{1e3 * face['gap_tip']:.1f} mm, printed {1e3 * made['printed_gap_tip']:.1f} mm."
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
    plans, ends = Improved.of(assumed).readings(), PRINTED.meeting
    panels = [
        search_panel(
            name,
            plan,
            {"forward": plan.half_tcp[0], "backward": plan.half_tcp[1]},
            {"printed ends": ends},
        )
        for name, plan in plans.items()
    ]
    face, other = plans.values()
    return Result(
        obtained={
            "apart": face.gap - assumed["joint_tolerance"],
            "reconstruction_joined": other.reached,
            "clearance": truth(face).clearance,
            "clearance_reconstruction": truth(other).clearance,
        },
        table=face.to_frame(),
        caption=(
            f"The halves end ({face.reason}) after {face.searches} searches at face value, at z = "
            f"{face.ends[0][2]:.3f} m, and after {other.searches} in the reconstruction, at z = "
            f"{other.ends[0][2]:.3f} m; the printed ends of the halves are at z = "
            f"{ends[0, 2]:.3f} and {ends[1, 2]:.3f} m."
        ),
        alt="Two panels with two spheres, postures of the arm and the two halves of its flange "
        "path that meet, and the printed end points of the halves.",
        figure=lambda: tip_path_figure(panels, list(spheres().values()), azim=35),
        scene=lambda: _scene(other),
    )


def _scene(plan: SearchPlan) -> Scene3D:
    """The joined path, played, with both halves of the flange path."""
    curves = {"forward": (plan.half_tcp[0], GREEN), "backward": (plan.half_tcp[1], PURPLE)}
    title = "Reconstruction: both halves of the master's path, forward and backward."
    return played_search(title, plan, spheres(), curves)


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
    face = Improved.of(assumed).plan()
    shown = [int(text) for text in REGISTRY.printed("qiu.fig07")["joints"]]
    path = Splice.of(assumed).smooth(face.path)
    before, after = truth(face), truth(face, path)
    curves = {
        f"q{j}_{kind}_deg": np.rad2deg(rows[:, j - 1])
        for j in shown
        for kind, rows in (("joined", face.path), ("smoothed", path))
    }
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
        table=pd.DataFrame(curves),
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
    plans = Improved.of(assumed).readings()
    splice = Splice.of(assumed)
    paths = {name: splice.smooth(plan.path) for name, plan in plans.items()}
    degrees = np.rad2deg(paths[FACE_VALUE])
    ranges = np.rad2deg(np.ptp(paths[FACE_VALUE], axis=0))
    return Result(
        obtained={
            "largest_step": float(np.abs(np.diff(paths[FACE_VALUE], axis=0)).max()),
            "range_deg": ranges.tolist(),
        },
        table=pd.DataFrame(degrees, columns=[f"q{j}_deg" for j in range(1, 7)]),
        caption=(
            "Joint angles along the smoothed path in both readings, the junction dotted. At face "
            "value the joints move by "
            + ", ".join(f"{x:.0f}" for x in ranges)
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
    plans, splice, halves = Improved.of(assumed).readings(), Splice.of(assumed), PRINTED.meeting
    tips = {
        name: end_effector(plan.problem.placed, splice.smooth(plan.path))
        for name, plan in plans.items()
    }
    face, tip = plans[FACE_VALUE], tips[FACE_VALUE]
    ends = [np.linalg.norm(tip[k] - face.tcp[k]) for k in (0, -1)]
    return Result(
        obtained={
            "start_error": float(ends[0]),
            "goal_error": float(ends[1]),
            "largest_step": float(np.linalg.norm(np.diff(tip, axis=0), axis=1).max()),
            "lowest": {name: float(rows[:, 2].min()) for name, rows in tips.items()},
        },
        table=pd.DataFrame(tip, columns=["x_m", "y_m", "z_m"]),
        caption=(
            "Coordinates of the flange on the smoothed path; its lowest point is at z = "
            f"{tip[:, 2].min():.3f} m at face value and {tips[RECONSTRUCTION][:, 2].min():.3f} m "
            "in the reconstruction; the printed ends of the halves, dashed and dotted, are at z = "
            f"{halves[0, 2]:.3f} and {halves[1, 2]:.3f} m. The printed curves are lost."
        ),
        alt="Three panels with x, y and z of the flange over the path for two readings.",
        figure=lambda: coordinate_figure(
            tips,
            {"printed, forward": halves[0], "printed, backward": halves[1]},
            "sample of the path",
        ),
    )
