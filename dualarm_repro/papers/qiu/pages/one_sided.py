"""Figures 6, 10 and 11 of `qiu` and what is said about the traditional search."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from ....ledger import REGISTRY, Assumed, Bounded, Generally, Is, NoOriginal, Result
from ....ledger.captions import captions
from ....ledger.printed_values import printed_numbers
from ....ledger.witnesses import cell_witnesses
from ....planning.checks.path_measures import WINDOW, chatter, until_rest
from ....planning.field.control_points import end_effector
from ....planning.search.failure import classify
from ....planning.search.search_plan import SearchPlan
from ....view.arm_scenes import played_search, search_panel
from ....view.scene3d import Scene3D
from ....view.search_curves import coordinate_figure
from ....view.style import BLACK, GREEN
from ....view.tip_paths import tip_path_figure
from ..calibrated import readings
from ..document import CALIBRATED, FACE_VALUE, PRINTED, full_step, spheres
from ..ends import NO_CURVES
from ..reading import Search, Traditional, VariableGain
from ..studies.equilibria import EQUILIBRIA
from ..studies.improvements import IMPROVEMENTS, nearest

checks = partial(REGISTRY.checks, page="qiu/one_sided")
caption = captions(__file__)
_CHATTERS = Bounded("chatter", "chatter of the height, as a share of a full zigzag", low="chatters")


def _both(assumed: Assumed) -> tuple[SearchPlan, SearchPlan]:
    """The traditional search at face value and by the calibrated reading."""
    face, other = readings(Traditional.of(assumed)).values()
    return face, other


def _outcome(plan: SearchPlan) -> dict[str, Any]:
    failure = classify(plan)
    rest = plan.path[-WINDOW:].mean(axis=0)
    return {
        "reason": str(plan.reason),
        "failure": None if failure is None else str(failure),
        "searches": plan.searches,
        "searches_until_rest": until_rest(plan.path, plan.problem.settings.step.length),
        "tcp": plan.ends[0].tolist(),
        "joint_distance_to_goal": float(np.linalg.norm(rest - plan.problem.goal)),
        "distance_to_printed_trap": float(np.linalg.norm(plan.tcp - PRINTED.trap, axis=1).min()),
    }


def _chatter(plan: SearchPlan, measure: str) -> float:
    """Chatter of the height of the flange at the end of a run."""
    return chatter(plan.tcp[:, 2], measure, full_step())


@checks(
    "qiu.claim_trad_stuck",
    rules=[
        Is("trapped", "the one-way search is trapped", value=True),
        Bounded(
            "balance.angle_deg",
            "angle by which both forces miss a balance around the printed trap, in the nearest "
            "posture at any ratio of the gains [deg]",
            high="balanced",
        ),
        Bounded("searches_off", "searches until it rests, from the printed number", high="about"),
        Bounded(
            "steps_from_print",
            "flange where it rests from the printed trap, in steps of the straight arm's flange",
            high="neighbourhood",
        ),
    ],
)
def trapped(assumed: Assumed) -> Result:
    """Where and why the one-way search ends, at face value and by the calibrated reading."""
    face, other = map(_outcome, _both(assumed))
    printed = float(printed_numbers("qiu.claim_trad_stuck", "searches"))
    away = float(np.linalg.norm(np.subtract(face["tcp"], PRINTED.trap)))
    return Result(
        obtained={
            "trapped": face["reason"] == "trapped",
            "searches": face["searches_until_rest"],
            "searches_off": abs(face["searches_until_rest"] - printed),
            "tcp": face["tcp"],
            "steps_from_print": away / full_step(),
            "face_value": face,
            "calibrated": other,
            "balance": _nearest_balance(),
        },
        caption=caption("claim_trad_stuck"),
    )


def _nearest_balance() -> dict[str, Any]:
    """The posture around the printed trap in which attraction and repulsion are nearest to opposed,
    over all ratios of the gains, and how many postures were sought."""
    table = EQUILIBRIA.load()
    nearest = table.loc[table["angle_deg"].idxmin()]
    found = {key: nearest[key] for key in (*table.columns[:5], "angle_deg", "ratio")}
    return found | {"sought": int(table["starts"].sum()), "cells": len(table)}


@checks(
    "qiu.claim_trad_oscillates",
    rules=[
        _CHATTERS,
        Bounded("beyond_range", "distance to an obstacle there beyond its range [m]", high=0.0),
    ],
)
def oscillates(assumed: Assumed) -> Result:
    """Chatter of the height in the last searches of the one-way run."""
    face, other = _both(assumed)
    measure = assumed["oscillation_measure"]
    return Result(
        obtained={
            "chatter": _chatter(face, measure),
            "beyond_range": float(face.record.clearances[0][-WINDOW:].min()) - PRINTED.influence,
            "peak_to_peak": float(np.ptp(face.tcp[-WINDOW:, 2])),
            "flips": face.record.flips[0],
            "calibrated": _chatter(other, measure),
        },
        caption=caption("claim_trad_oscillates", window=WINDOW, measure=measure),
    )


@checks(
    "qiu.claim_lambda_effect",
    rules=[
        Generally(
            "calmed",
            "random tasks whose chatter the variable gain clearly reduces, of those that chatter",
            at_least="most",
            margin="margin",
        )
    ],
)
def lambda_effect(assumed: Assumed) -> Result:
    """Chatter with constant and with variable gain, on the random tasks that chatter."""
    limits = REGISTRY.look("qiu.claim_lambda_effect", "thresholds").thresholds
    clearly = limits["clearly"].value
    measure, ratio = assumed["oscillation_measure"], nearest(assumed["gain_ratio"])
    table = IMPROVEMENTS.load()
    table = table[table["gain_ratio"] == ratio]
    loud = table[table[f"{measure}_constant"] >= limits["chatters"].value]
    share = loud[f"{measure}_variable"] / loud[f"{measure}_constant"]
    calmed = share <= clearly
    obtained = {
        "calmed": {"count": int(calmed.sum()), "of": len(loud)},
        "median_ratio": float(share.median()) if len(loud) else None,
        "tasks": len(table),
        "ratio": ratio,
        "measure": measure,
    }
    return Result(
        obtained=obtained,
        caption=caption("claim_lambda_effect", clearly=clearly),
        witnesses=cell_witnesses(
            "qiu.claim_lambda_effect",
            obtained,
            loud,
            calmed,
            ("task", "gain_rule", "kappa", f"{measure}_constant", f"{measure}_variable"),
        ),
    )


@checks(
    "qiu.fig06",
    rules=[
        Bounded(
            "chatter", "chatter with constant gain, as a share of a full zigzag", low="chatters"
        ),
        Bounded("reduction", "chatter with variable over that with constant gain", high="clearly"),
        NO_CURVES,
    ],
)
def height_with_both_gains(assumed: Assumed) -> Result:
    """Height of the flange over the searches, constant and variable gain."""
    kinds: dict[str, type[Search]] = {"constant": Traditional, "variable": VariableGain}
    plans = {name: kind.of(assumed).plan() for name, kind in kinds.items()}
    measure = assumed["oscillation_measure"]
    levels = {name: _chatter(plan, measure) for name, plan in plans.items()}
    heights = {f"z_{name}_m": pd.Series(plan.tcp[:, 2]) for name, plan in plans.items()}
    return Result(
        obtained={
            "chatter": levels["constant"],
            "chatter_variable": levels["variable"],
            "reduction": levels["variable"] / levels["constant"] if levels["constant"] else None,
            "flips": [plan.record.flips[0] for plan in plans.values()],
            "searches": [plan.searches for plan in plans.values()],
            "clearance": [plan.control_clearance for plan in plans.values()],
        },
        table=pd.DataFrame(heights).rename_axis("search").reset_index(),
        caption=caption("fig06", plans=plans, levels=levels),
        alt="Coordinates of the flange over the searches for constant and variable gain.",
        figure=lambda: coordinate_figure(
            {f"{name} gain": plan.tcp for name, plan in plans.items()}
        ),
    )


@checks(
    "qiu.fig10",
    rules=[
        Bounded("short_of_goal", "joint distance to the goal beyond the tolerance [rad]", low=0.0),
        NoOriginal("path", "the path"),
    ],
)
def path_among_spheres(assumed: Assumed) -> Result:
    """Flange path and postures of the one-way search."""
    plans, trap = readings(Traditional.of(assumed)), PRINTED.trap
    start = printed_numbers("qiu.claim_start", "tcp")
    face, other = plans.values()
    goals = {name: end_effector(plan.placed, plan.problem.goal) for name, plan in plans.items()}
    panels = [
        search_panel(
            name,
            plan,
            {"flange": plan.tcp},
            {
                "start": start,
                "printed goal": PRINTED.master_goal,
                "printed trap": trap,
                "goal planned to": goals[name],
            },
        )
        for name, plan in plans.items()
    ]
    away = np.linalg.norm(face.tcp[:, None] - PRINTED.centres, axis=2).min()
    to_trap = float(np.linalg.norm(face.ends[0] - trap))
    return Result(
        obtained={
            "short_of_goal": face.gap - assumed["joint_tolerance"],
            "end": face.ends[0].tolist(),
            "flange_clearance": float(away - PRINTED.radius),
            "calibrated_reached": other.reached,
        },
        table=face.to_frame(),
        caption=caption("fig10", to_trap=to_trap, reason=other.reason),
        alt="Two panels with two spheres, postures of the arm and the path of its flange; the "
        "goal and the printed trap are marked.",
        figure=lambda: tip_path_figure(panels, list(spheres().values()), azim=35),
        scene=lambda: _scene(face, goals[FACE_VALUE]),
    )


def _scene(plan: SearchPlan, goal: np.ndarray) -> Scene3D:
    """The one-way search, played."""
    curves = {"flange": (plan.tcp, GREEN)}
    made = played_search("The one-way search and its goal (black).", plan, spheres(), curves)
    made.add_sphere("goal", goal, 0.012, BLACK)
    return made


@checks("qiu.fig11", rules=[_CHATTERS, NO_CURVES])
def coordinates(assumed: Assumed) -> Result:
    """x, y and z of the flange over the searches of the one-way run."""
    face, other = _both(assumed)
    goal = end_effector(face.placed, face.problem.goal)
    return Result(
        obtained={
            "chatter": _chatter(face, assumed["oscillation_measure"]),
            "flips": face.record.flips[0],
            "searches": face.searches,
        },
        table=face.to_frame(),
        caption=caption("fig11", other=other.searches),
        alt="Coordinates of the flange over the searches for two readings, with the printed trap "
        "as dashed levels.",
        figure=lambda: coordinate_figure(
            {FACE_VALUE: face.tcp, CALIBRATED: other.tcp},
            {"printed trap": PRINTED.trap},
            ends={
                "printed start": (0, printed_numbers("qiu.claim_start", "tcp")),
                "printed goal": (len(face.tcp) - 1, PRINTED.master_goal),
                "goal planned to": (len(face.tcp) - 1, goal),
            },
        ),
    )
