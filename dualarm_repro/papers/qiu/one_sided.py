"""Figures 6, 10 and 11 of `qiu` and what is said about the traditional search."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from ...ledger import REGISTRY, Assumed, Bounded, Is, NoOriginal, Result, Rounds
from ...planning.failure import classify
from ...planning.search_plan import SearchPlan
from ...view.scene3d import Scene3D
from ...view.search_curves import coordinate_figure
from ...view.style import BLACK, GREEN, MASTER, ORANGE
from ...view.tip_paths import TipPanel, tip_path_figure
from ..wording import point
from .oscillation import WINDOW, chatter
from .readings import (
    TRADITIONAL,
    balance_ratio,
    reconstructed,
    traditional_plan,
    variable_gain_plan,
)
from .scenario import CENTRES, RADIUS, START, TRAP, spheres

checks = partial(REGISTRY.checks, page="qiu/one_sided")
_POSTURES = 6


def _both(assumed: Assumed) -> tuple[SearchPlan, SearchPlan]:
    """The traditional search at face value and in the reconstruction."""
    if assumed["baseline"] != "same_potentials":
        raise ValueError("the traditional search shares the potentials")
    return traditional_plan(assumed), traditional_plan(reconstructed(assumed, TRADITIONAL))


def _outcome(plan: SearchPlan) -> dict[str, Any]:
    failure = classify(plan)
    rest = plan.path[-WINDOW:].mean(axis=0)
    return {
        "reason": str(plan.reason),
        "failure": None if failure is None else str(failure),
        "searches": plan.searches,
        "searches_until_rest": _until_rest(plan),
        "tcp": plan.ends[0].tolist(),
        "joint_distance_to_goal": float(np.linalg.norm(rest - plan.problem.goal)),
        "distance_to_printed_trap": float(np.linalg.norm(plan.tcp - TRAP, axis=1).min()),
    }


def _until_rest(plan: SearchPlan) -> int:
    """Searches after which the joints stay within two steps of where the run ends on average."""
    rest = plan.path[-WINDOW:].mean(axis=0)
    away = np.linalg.norm(plan.path - rest, axis=1) > 2.0 * plan.problem.settings.step.length
    return int(np.flatnonzero(away)[-1]) + 1 if away.any() else 0


@checks(
    "qiu.claim_trad_stuck",
    rules=[
        Is(key="trapped", value=True, label="the one-way search is trapped"),
        Rounds(
            key="searches",
            to="searches",
            label="searches until it rests",
            tolerance=5,
            reason="printed as approximate",
        ),
        Rounds(
            key="tcp",
            to="tcp",
            label="flange where it rests [m]",
            tolerance=0.02,
            reason="printed as a neighbourhood",
        ),
    ],
    samples=32,
)
def trapped(assumed: Assumed) -> Result:
    """Where and why the one-way search ends, at face value and in the reconstruction."""
    face, other = map(_outcome, _both(assumed))
    return Result(
        obtained={
            "trapped": face["reason"] == "trapped",
            "searches": face["searches_until_rest"],
            "tcp": face["tcp"],
            "face_value": face,
            "reconstruction": other,
            "ratio_of_reconstruction": balance_ratio(),
        },
        caption=(
            f"With the printed gains the one-way search rests after {face['searches_until_rest']} "
            f"searches at ({point(np.array(face['tcp']), 3)}) m, "
            f"{face['joint_distance_to_goal']:.2f} rad "
            f"from its goal ({face['failure']}): obstacles push the arm off a goal inside their "
            "range. "
            f"It never comes nearer than {1e3 * face['distance_to_printed_trap']:.0f} mm to the "
            "printed "
            f"trap. With the gain ratio {balance_ratio():.1e} at which the printed trap would "
            "balance, "
            f"the search ends as: {other['reason']}, after {other['searches']} searches."
        ),
    )


@checks(
    "qiu.claim_trad_oscillates",
    rules=[
        Bounded(key="chatter", low=1.0, label="chatter of the height over the level that counts"),
        Bounded(key="clearance", high=0.4, label="distance to an obstacle there, within range [m]"),
    ],
    samples=32,
)
def oscillates(assumed: Assumed) -> Result:
    """Chatter of the height in the last searches of the one-way run."""
    face, other = _both(assumed)
    measure = assumed["oscillation_measure"]
    values = {name: chatter(plan.tcp[:, 2], measure) for name, plan in
              (("face_value", face), ("reconstruction", other))}  # fmt: skip
    spread = float(np.ptp(face.tcp[-WINDOW:, 2]))
    return Result(
        obtained={
            "chatter": values["face_value"],
            "clearance": float(face.record.clearances[0][-WINDOW:].min()),
            "peak_to_peak": spread,
            "flips": face.record.flips[0],
            "reconstruction": values["reconstruction"],
        },
        caption=(
            f"In its last {WINDOW} searches the height of the one-way run moves up and down by "
            f"{1e3 * spread:.0f} mm and the resultant has flipped {face.record.flips[0]} times: a "
            "step "
            "of fixed length cannot come to rest at an equilibrium."
        ),
    )


@checks(
    "qiu.claim_lambda_effect",
    rules=[
        Bounded(key="chatter_constant", low=1.0, label="chatter with constant gain over its level"),
        Bounded(
            key="ratio", high=0.5, label="chatter with variable gain over that with constant gain"
        ),
    ],
    samples=32,
)
def lambda_effect(assumed: Assumed) -> Result:
    """Chatter with constant and with variable gain."""
    constant, variable = _gain_runs(assumed)
    measure = assumed["oscillation_measure"]
    levels = [chatter(plan.tcp[:, 2], measure) for plan in (constant, variable)]
    return Result(
        obtained={
            "chatter_constant": levels[0],
            "chatter_variable": levels[1],
            "ratio": levels[1] / levels[0] if levels[0] > 0 else float("inf"),
            "flips": [constant.record.flips[0], variable.record.flips[0]],
            "reasons": [str(constant.reason), str(variable.reason)],
            "clearance": [constant.control_clearance, variable.control_clearance],
        },
        caption=(
            f"Flips of the resultant: {constant.record.flips[0]} with constant gain, "
            f"{variable.record.flips[0]} with the variable one, which ends as {variable.reason} "
            "after "
            f"{variable.searches} searches. It does so by letting go of the obstacle: the smallest "
            f"distance of a control point falls from {constant.control_clearance:.3f} m to "
            f"{variable.control_clearance:.3f} m."
        ),
    )


def _gain_runs(assumed: Assumed) -> tuple[SearchPlan, SearchPlan]:
    if assumed["baseline"] != "same_potentials":
        raise ValueError("the traditional search shares the potentials")
    return traditional_plan(assumed), variable_gain_plan(assumed)


@checks(
    "qiu.fig06",
    samples=32,
    rules=[
        Bounded(key="flips_constant", low=5, label="flips of the resultant with constant gain"),
        Bounded(key="flips_ratio", high=0.5, label="flips with variable gain over those without"),
        NoOriginal(key="curves", label="the curves"),
    ],
)
def height_with_both_gains(assumed: Assumed) -> Result:
    """Height of the flange over the searches, constant and variable gain."""
    constant, variable = _gain_runs(assumed)
    flips = [plan.record.flips[0] for plan in (constant, variable)]
    measure = assumed["oscillation_measure"]
    length = max(len(constant.tcp), len(variable.tcp))
    columns = {
        name: np.pad(plan.tcp[:, 2], (0, length - len(plan.tcp)), constant_values=np.nan)
        for name, plan in (("z_constant_m", constant), ("z_variable_m", variable))
    }
    return Result(
        obtained={
            "flips_constant": flips[0],
            "flips_ratio": flips[1] / max(flips[0], 1),
            "measure": measure,
            "searches": [constant.searches, variable.searches],
        },
        table=pd.DataFrame(columns).rename_axis("search").reset_index(),
        caption=(
            f"Height of the flange with constant gain ({flips[0]} flips) and with variable gain "
            f"({flips[1]} flips). The curves of the document are not in the text edition."
        ),
        alt="Coordinates of the flange over the searches for constant and variable gain; with "
        "constant "
        "gain they end in a zigzag.",
        figure=lambda: coordinate_figure(
            {"constant gain": constant.tcp, "variable gain": variable.tcp}
        ),
    )


@checks(
    "qiu.fig10",
    rules=[
        Is(key="reached", value=False, label="the one-way search does not arrive"),
        NoOriginal(key="path", label="the path"),
    ],
    samples=32,
)
def path_among_spheres(assumed: Assumed) -> Result:
    """Flange path and postures of the one-way search."""
    face, other = _both(assumed)
    panels = [
        TipPanel(
            title,
            {"flange": plan.tcp},
            [(plan.problem.placed, q) for q in plan.path[:: max(1, len(plan.path) // _POSTURES)]],
            {"goal": plan.problem.placed.placement.act(_goal_tip(plan)), "printed trap": TRAP},
        )
        for title, plan in (("face value", face), ("reconstruction", other))
    ]
    clearance = np.linalg.norm(face.tcp[:, None] - CENTRES, axis=2).min() - RADIUS
    return Result(
        obtained={
            "reached": face.reached,
            "end": face.ends[0].tolist(),
            "flange_clearance": float(clearance),
            "reconstruction_reached": other.reached,
        },
        table=face.to_frame(),
        caption=(
            f"With the printed gains the flange stays {clearance:.3f} m or more away from the "
            "spheres "
            f"and ends at ({point(face.ends[0], 3)}) m; the printed trap lies elsewhere. In the "
            f"reconstruction the one-way search ends as: {other.reason}."
        ),
        alt="Two panels with two spheres, postures of the arm and the path of its flange; the goal "
        "and the "
        "printed trap are marked.",
        figure=lambda: tip_path_figure(panels, list(spheres().values()), azim=35),
        scene=lambda: _scene(face),
    )


def _goal_tip(plan: SearchPlan) -> np.ndarray:
    return plan.problem.placed.arm.positions(plan.problem.goal)


def _scene(plan: SearchPlan) -> Scene3D:
    """The one-way search, played."""
    placed = plan.problem.placed
    made = Scene3D("The one-way search stops beside its goal (black).", camera=(1.4, 0.9, 1.2))
    for name, sphere in spheres().items():
        made.add_sphere(name, sphere.center, sphere.radius, ORANGE)
    made.add_arm("master", placed.arm, START, placed.placement, MASTER)
    made.add_path("flange", plan.tcp, GREEN)
    made.add_sphere("goal", placed.placement.act(_goal_tip(plan)), 0.012, BLACK)
    made.animate({"master": (placed.arm, plan.path)})
    return made


@checks(
    "qiu.fig11",
    rules=[
        Bounded(key="flips", low=5, label="flips of the resultant on the way"),
        NoOriginal(key="curves", label="the curves"),
    ],
    samples=32,
)
def coordinates(assumed: Assumed) -> Result:
    """x, y and z of the flange over the searches of the one-way run."""
    face, other = _both(assumed)
    return Result(
        obtained={"flips": face.record.flips[0], "searches": face.searches},
        table=face.to_frame(),
        caption=(
            f"Coordinates of the flange over {face.searches} searches at face value "
            f"({face.record.flips[0]} flips of the resultant) and over {other.searches} in the "
            "reconstruction; dashed: the printed trap. The printed curves are lost."
        ),
        alt="Coordinates of the flange over the searches for two readings, with the printed trap "
        "as dashed "
        "levels.",
        figure=lambda: coordinate_figure(
            {"face value": face.tcp, "reconstruction": other.tcp}, {"printed trap": TRAP}
        ),
    )
