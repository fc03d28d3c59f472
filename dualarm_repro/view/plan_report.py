"""What `dualarm plan` gives away: who arrived, how close whole bodies come, a scene."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd

from ..errors import DualArmError, UnsupportedArmError
from ..planning.checks.truth import Truth, Verdict, truth
from ..planning.gate import require_sound
from ..planning.methods import METHODS, AnyPlan, plan_file
from ..planning.tasks.task_file import load_tasks
from ..scene import MovingArm, Scene
from ..settings import Settings
from .scene3d import Scene3D
from .task_scene import drawn_scene

if TYPE_CHECKING:
    from .page import Page

_COMPARED = ("arrive", "outcome", "steps", "certified distance [m]", "between")
PARKED = "parked"


def plan_summary(plan: AnyPlan, found: Truth | None = None) -> dict[str, Any]:
    """Outcome of every arm of the scene, and the certified distance of all bodies.

    Parameters
    ----------
    found : Truth, optional
        What :func:`.truth` says of the plan, if it is known already.
    """
    found = found or truth(plan.scene, plan.paths)
    arms: dict[str, dict[str, Any]] = {
        name: {
            "reason": str(one.reason),
            "reached": bool(one.reached),
            "steps": one.steps,
            "joint_length_rad": one.length,
            "tcp_length_m": one.tcp_length,
            "outside_limits": list(one.outside_limits),
            "beyond_limits": found.beyond_limits[name],
            "out_of_reach_m": plan.residuals.get(name, 0.0),
            "certificate": asdict(one.certificate) if one.certificate else None,
        }
        for name, one in plan.plans.items()
    }
    for name in plan.scene.columns:
        if name not in arms:
            still = {"steps": 0, "beyond_limits": found.beyond_limits[name]}
            arms[name] = {"reason": PARKED, "reached": True, **still}
    told_of = {"reached": plan_reached(plan), "remarks": remarks(plan.scene)}
    return {"arms": arms, **told_of, **judged(found)}


def remarks(scene: Scene) -> dict[str, list[str]]:
    """Of every arm what its robot file says that is represented otherwise or not at all."""
    arms = [(one.name, one.arm) for one in scene.arms]
    arms += [(name, one.arm) for name, one in scene.moving.items() if isinstance(one, MovingArm)]
    return {name: list(arm.remarks) for name, arm in arms if arm.remarks}


def plan_reached(plan: AnyPlan) -> bool:
    """Whether every arm with a task arrived."""
    return all(bool(one.reached) for one in plan.plans.values())


def judged(found: Truth) -> dict[str, Any]:
    """The part of a summary that holds for any motion."""
    return {
        "within_limits": found.within_limits,
        "links": {
            "minimum_distance_m": found.lower,
            "bracket_m": [found.lower, found.upper],
            "pair": list(found.pair or ()),
            "step": found.index,
            "collision_free": found.collision_free,
            "verdict": str(found.verdict),
        },
    }


def told(found: Truth, reached: bool, begun: bool = True) -> str:
    """Outcome in words: everything that keeps a motion from being run, or that nothing does."""
    wrong = [] if begun else ["not from the start"]
    wrong += [] if reached else ["not arrived"]
    wrong += [] if found.within_limits else ["beyond joint limits"]
    wrong += [] if found.collision_free else [str(found.verdict)]
    return ", ".join(wrong) or f"arrived, {Verdict.FREE}"


def usable(found: Truth, reached: bool, begun: bool = True) -> bool:
    """Whether all began at their starts and arrived, within their limits and certified free of
    contact."""
    return begun and reached and found.within_limits and found.collision_free


def compare_methods(path: str | Path, allow_collision: bool = False) -> pd.DataFrame:
    """Outcome of every method on a task file: arms that arrive, and how close whole bodies come.

    A method that does not take the task says why.

    Parameters
    ----------
    allow_collision : bool
        Let bodies touch at the start and at the goal.

    Raises
    ------
    DataFileError, UnsupportedArmError, TaskFaults
        The file is wrong, whatever the method.
    """
    given = load_tasks(path, Settings)
    require_sound(given.path, given.scene, given.starts, given.goals, allow_collision)
    rows: dict[str, dict[str, Any]] = {}
    for name in METHODS:
        try:
            plan = plan_file(path, name, allow_collision)
        except DualArmError as refusal:
            whom = "these arms" if isinstance(refusal, UnsupportedArmError) else "this task"
            rows[name] = dict.fromkeys(_COMPARED, "") | {"arrive": f"not for {whom} ({refusal})"}
            continue
        found = truth(plan.scene, plan.paths)
        values = (
            ", ".join(arm for arm, one in plan.plans.items() if one.reached) or "none",
            told(found, plan_reached(plan)),
            max(one.steps for one in plan.plans.values()),
            round(found.lower, 4),
            " - ".join(found.pair or ()),
        )
        rows[name] = dict(zip(_COMPARED, values, strict=True))
    return pd.DataFrame.from_dict(rows, orient="index").rename_axis("method")


def plan_page(plan: AnyPlan, title: str) -> Page:
    """The motion of all arms for a page of the book."""
    from .page import Page  # which draws figures, too

    return Page(plan_scene(plan, title).page_html())


def plan_scene(plan: AnyPlan, title: str) -> Scene3D:
    """The motion of all arms among all bodies of the scene, with the tracks of the flanges."""
    ends = [mover.path.index[-1] for mover in plan.scene.moving.values()]
    index = np.arange(1.0 + max([plan.index[-1], *np.ceil(ends)]))
    rows = {name: path.at(index) for name, path in plan.paths.items()}
    return drawn_scene(plan.scene, title, rows, index)
