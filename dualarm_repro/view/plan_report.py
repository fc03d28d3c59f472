"""What `dualarm plan` gives away: why each arm stopped, how close links came, paths and a scene."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from ..errors import UnsupportedArmError
from ..planning.methods import METHODS, AnyPlan, plan_file
from ..scene import clearance
from .page import Page
from .scene3d import Scene3D
from .scenes.nearest import Nearest, nearest_of
from .style import PALETTE

#: Joint step between two link checks [rad].
CHECK_STEP = 0.01
_OBSTACLE = "#9A9A9A"
_COMPARED = ("arrive", "steps", "smallest distance [m]", "between")


def plan_summary(plan: AnyPlan) -> dict[str, Any]:
    """Outcome of every arm, and the smallest distance of any two bodies on the densified motion."""
    links = plan.links(CHECK_STEP)
    pair, step = links.nearest if links.pairs else ((), None)
    return {
        "arms": {
            name: {
                "reason": str(one.reason),
                "steps": one.steps,
                "joint_length_rad": one.length,
                "tcp_length_m": one.tcp_length,
                "outside_limits": list(one.outside_limits),
                "out_of_reach_m": plan.residuals.get(name, 0.0),
                "certificate": asdict(one.certificate) if one.certificate else None,
            }
            for name, one in plan.plans.items()
        },
        "links": {
            "minimum_distance_m": links.minimum,
            "pair": list(pair),
            "step": step,
            "collision_free": links.minimum > 0.0,
        },
    }


def compare_methods(path: str | Path) -> pd.DataFrame:
    """Outcome of every method on a task file: arms that arrive, and how close whole links come.

    A method that does not take one of the arms says why.
    """
    rows: dict[str, dict[str, Any]] = {}
    for name in METHODS:
        try:
            plan = plan_file(path, name)
        except UnsupportedArmError as refusal:
            rows[name] = dict.fromkeys(_COMPARED, "") | {
                "arrive": f"not for these arms ({refusal})"
            }
            continue
        links = plan.links(CHECK_STEP)
        found = (
            ", ".join(arm for arm, one in plan.plans.items() if one.reached) or "none",
            max(one.steps for one in plan.plans.values()),
            round(links.minimum, 4),
            " - ".join(links.nearest[0]) if links.pairs else "",
        )
        rows[name] = dict(zip(_COMPARED, found, strict=True))
    return pd.DataFrame.from_dict(rows, orient="index").rename_axis("method")


def plan_page(plan: AnyPlan, title: str) -> Page:
    """The motion of all arms for a page of the book."""
    return Page(plan_scene(plan, title).page_html())


def plan_scene(plan: AnyPlan, title: str) -> Scene3D:
    """The motion of all arms among boxes and spheres, with the tracks of the flanges."""
    arms = dict(zip(plan.plans, PALETTE, strict=False))
    reach = max(float(np.ptp(one.tcp, axis=0).max()) + 1.0 for one in plan.plans.values())
    made = Scene3D(title, camera=(1.1 * reach, -0.9 * reach, 0.9 * reach))
    made.contents.floor = plan.scene.floor
    for name, shape in _solids(plan):
        made.add_solid(name, shape, _OBSTACLE)
    for name, color in arms.items():
        one = plan.plans[name]
        made.add_arm(name, one.placed.arm, one.path[0], one.placed.placement, color)
        made.add_path(f"{name} track", one.tcp, color)
    made.animate({n: (p.placed.arm, p.path) for n, p in plan.plans.items() if p.steps})
    if made.contents.motion:
        made.contents.nearest = _nearest(plan, made.contents.motion.frames)
    return made


def _nearest(plan: AnyPlan, frames: np.ndarray) -> Nearest:
    """The pairs that the scene of the plan watches, so that it shows what the summary says."""
    rows = {n: p.path[np.minimum(frames, len(p.path) - 1)] for n, p in plan.plans.items()}
    found = clearance(plan.scene, plan.scene.stack(**rows), frames)
    pairs = plan.scene.pairs.bodies
    return nearest_of(found.distance, found.point_a, found.point_b, pairs)


def _solids(plan: AnyPlan) -> list[tuple[str, Any]]:
    """Each obstacle by its name; several shapes of one name are counted."""
    found = []
    for name, solid in plan.scene.obstacles.items():
        shapes = solid if isinstance(solid, tuple | list) else (solid,)
        names = [name] if len(shapes) == 1 else [f"{name} {k + 1}" for k in range(len(shapes))]
        found += list(zip(names, shapes, strict=True))
    return found
