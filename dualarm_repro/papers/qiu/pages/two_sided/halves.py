"""Figures 7 and 12-14 of `qiu` and what is said about the two halves."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from .....ledger import REGISTRY, Assumed, Bounded, NoOriginal, Result
from .....ledger.assumptions import alternatives, hashable
from .....ledger.captions import captions
from .....ledger.printed_values import printed_numbers
from .....planning.checks.contact_check import ContactCheck, contact_check
from .....planning.field.control_points import end_effector
from .....planning.search.search_plan import SearchPlan
from .....planning.search.splice import roughness
from .....view.arm_scenes import played_search, search_panel
from .....view.search_curves import splice_figure
from .....view.style import GREEN, PURPLE
from .....view.tip_paths import tip_path_figure
from ... import ends
from ...calibrated import readings
from ...document import FACE_VALUE, PRINTED, spheres, truth_scene
from ...reading import Improved, Splice
from ...studies.fit import FIT

checks = partial(REGISTRY.checks, page="qiu/two_sided")
caption = captions(__file__)
_PLAYED = "Calibrated reading: both halves of the master's path, forward and backward."


def truth(plan: SearchPlan, path: np.ndarray | None = None) -> ContactCheck:
    """Contact of the whole master on a path, by default the joined one."""
    scene = truth_scene([plan.problem.placed])
    return contact_check(scene, plan.path if path is None else path)


def _summaries(assumed: Assumed) -> list[dict[str, Any]]:
    """How the search came out, at face value and by the calibrated reading."""
    found = []
    for plan in readings(Improved.of(assumed)).values():
        check = truth(plan)
        contact = {"gap_rad": plan.gap, "free": check.free, "clearance": check.clearance}
        searches = printed_numbers("qiu.claim_bi_counts", *ends.HALVES)
        found.append(ends.outcome(plan, PRINTED.meeting, searches) | contact)
    return found


@checks("qiu.claim_bi_counts", rules=ends.count_rules("the two halves meet"))
def counts(assumed: Assumed) -> Result:
    """Searches until the halves meet, in both readings."""
    printed = REGISTRY.printed("qiu.claim_bi_counts")["forward"]
    fit, (face, other) = FIT.load(), _summaries(assumed)
    told = caption("claim_bi_counts", printed=printed)
    witnesses = ends.fit_witness(fit, np.inf)
    return Result(ends.counted(face, other, fit), told, witnesses=witnesses)


@checks("qiu.claim_bi_meet", rules=ends.meeting_rules("the two halves meet"))
def meeting(assumed: Assumed) -> Result:
    """Where the halves end, against print."""
    face, other = _summaries(assumed)
    height = float(PRINTED.centres[0, 2])
    return Result(
        obtained=ends.met(face, other, PRINTED.meeting),
        caption=caption("claim_bi_meet", reason=face["reason"], height=height),
        witnesses=ends.fit_witness(FIT.load(), ends.near_print("qiu.claim_bi_meet")),
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
    plans, printed = readings(Improved.of(assumed)), PRINTED.meeting
    task = {"start": printed_numbers("qiu.claim_start", "tcp"), "goal": PRINTED.master_goal}
    face, other = plans.values()
    panels = [
        search_panel(name, plan, ends.by_half(plan.half_tcp), task | {"printed ends": printed})
        for name, plan in plans.items()
    ]
    curves = ends.by_half(zip(other.half_tcp, (GREEN, PURPLE), strict=True))
    return Result(
        obtained={
            "apart": face.gap - assumed["joint_tolerance"],
            "calibrated_joined": other.reached,
            "clearance": truth(face).clearance,
            "clearance_calibrated": truth(other).clearance,
        },
        table=face.to_frame(),
        caption=caption("fig12", face=face, other=other, printed=printed),
        alt="Two panels with two spheres, postures of the arm and the two halves of its flange "
        "path that meet, and the printed end points of the halves.",
        figure=lambda: tip_path_figure(panels, list(spheres().values()), azim=35),
        scene=lambda: played_search(_PLAYED, other, spheres(), curves),
    )


@checks(
    "qiu.fig07",
    rules=[
        Bounded("least_range", "range of the joint shown that moves least [rad]", low="visible"),
        Bounded("junction_ratio", "bend at the junction, smoothed over joined", high="smoother"),
        Bounded("end_shift", "shift of the ends of the path [rad]", high="held"),
        ends.NO_CURVES,
    ],
)
def splice(assumed: Assumed) -> Result:
    """Joints 4 and 5 around the junction, raw and smoothed; clearance and limits checked again.

    Drawn for the declared wrist at the goal that leaves the sharpest corner in both.
    """
    reading, spline = Improved.of(assumed), Splice.of(assumed)
    face = reading.plan()
    joints = [int(text) for text in REGISTRY.printed("qiu.fig07")["joints"]]
    columns = [j - 1 for j in joints]
    path = spline.smooth(face.path)
    before, after = truth(face), truth(face, path)
    ranges = np.ptp(path[:, columns], axis=0)
    wrists = map(hashable, alternatives("qiu.goal_wrist", 3))
    others = [replace(reading, goal_wrist=wrist).plan() for wrist in wrists]
    shown = max(
        others, key=lambda plan: min(_bend(plan.path[:, [k]], plan.searches) for k in columns)
    )
    smooth = spline.smooth(shown.path)
    curves = {
        f"q{j}_{kind}_deg": np.rad2deg(rows[:, j - 1])
        for j in joints
        for kind, rows in (("joined", shown.path), ("smoothed", smooth))
    }
    return Result(
        obtained={
            "least_range": float(ranges.min()),
            "junction_ratio": _ratio(path, face),
            "end_shift": float(np.abs(path[[0, -1]] - face.path[[0, -1]]).max()),
            "roughness_ratio": roughness(path) / roughness(face.path),
            "clearance_change": after.clearance["obstacles"] - before.clearance["obstacles"],
            "beyond_limits": after.beyond_limits,
            "drawn": {
                "wrist": shown.problem.goal[3:].tolist(),
                "range": np.ptp(smooth[:, columns], axis=0).tolist(),
                "junction_ratio": _ratio(smooth, shown),
            },
        },
        table=pd.DataFrame(curves),
        caption=caption(
            "fig07", joints=joints, degrees=np.rad2deg(ranges), wrist=assumed["goal_wrist"]
        ),
        alt="Joints 4 and 5 around the junction of the halves, as joined and after smoothing, with "
        "their bend below.",
        figure=lambda: splice_figure(shown.path, smooth, shown.searches + 0.5, columns),
    )


def _ratio(path: np.ndarray, plan: SearchPlan) -> float:
    """Bend at the junction of a smoothed path over that of the joined one."""
    joined = _bend(plan.path, plan.searches)
    return _bend(path, plan.searches) / joined if joined > 0.0 else 1.0


def _bend(path: np.ndarray, junction: int) -> float:
    """Largest second difference at the two samples of the junction [rad]."""
    second = np.linalg.norm(np.diff(path, 2, axis=0), axis=1)
    return float(second[junction - 1 : junction + 1].max())


@checks("qiu.fig13", rules=ends.JOINT_RULES)
def joint_angles(assumed: Assumed) -> Result:
    """All joint angles of the joined and smoothed path."""
    plans, smooth = readings(Improved.of(assumed)), Splice.of(assumed).smooth
    return ends.joints_of(
        {name: smooth(plan.path) for name, plan in plans.items()},
        plans.values(),
        caption("fig13"),
        "Six panels of joint angles over the samples of the path, for two readings.",
    )


@checks(
    "qiu.fig14",
    rules=[
        Bounded("start_error", "distance of the first point to the start [m]", high="held"),
        Bounded("goal_error", "distance of the last point to the goal [m]", high="held"),
        ends.TIP_STEP,
        ends.NO_CURVES,
    ],
)
def tip_coordinates(assumed: Assumed) -> Result:
    """Coordinates of the flange on the joined and smoothed path."""
    plans, halves = readings(Improved.of(assumed)), PRINTED.meeting
    smooth = Splice.of(assumed).smooth
    face = plans[FACE_VALUE]
    tips = {name: end_effector(plan.placed, smooth(plan.path)) for name, plan in plans.items()}
    shifts = np.linalg.norm(tips[FACE_VALUE][[0, -1]] - plans[FACE_VALUE].tcp[[0, -1]], axis=1)
    return ends.coordinates_of(
        tips,
        dict(zip(("start_error", "goal_error"), shifts.tolist(), strict=True)),
        halves,
        {
            "printed start": printed_numbers("qiu.claim_start", "tcp"),
            "printed goal": PRINTED.master_goal,
            "goal planned to": end_effector(face.placed, face.problem.goal),
        },
        caption("fig14", halves=halves),
        "Three panels with x, y and z of the flange over the path for two readings.",
    )
