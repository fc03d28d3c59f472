"""Stored study of `qiu`: a fit of the printed meeting points after the fact."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from ....ledger import REGISTRY, Study
from ....planning.checks.contact_check import contact_check
from ....planning.search.variants import Variant
from ..document import PRINTED, SEED, truth_scene
from ..reading import Improved

RATIOS = tuple(float(f"{x:.2e}") for x in np.geomspace(1e-5, 1.0, 41))


def _cells() -> list[dict[str, Any]]:
    return [
        {"branch": branch, "control_points": points, "goal_radius": radius, "step": step}
        for branch in ("front_shallow", "front_deep")
        for points in ("elbow_wrist_flange", "elbow_wrist")
        for radius in (0.60, 0.61, 0.62, 0.63, 0.64, 0.65)
        for step in ("constant", "saturating")
    ]


def _cell(cell: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """The ratio that brings the ends of the halves nearest to print, of all tried."""
    reading = Improved.nominal(
        goal_branch=cell["branch"],
        control_points=cell["control_points"],
        goal_radius=cell["goal_radius"],
    )
    variant = Variant(False, cell["step"] == "saturating", True)
    goal, scene = reading.posture(), truth_scene([reading.arm()])
    best: dict[str, Any] = {"tried": len(RATIOS), "error": np.inf}
    for ratio in RATIOS:
        plan = replace(reading, gain_ratio=ratio).plan_to(goal, variant)
        error = float(np.linalg.norm(np.array(plan.ends) - PRINTED.meeting, axis=1).max())
        if plan.reached and error < best["error"]:
            check = contact_check(scene, plan.path)
            best |= {
                "error": error,
                "gain_ratio": ratio,
                "searches": plan.searches,
                "clearance": check.clearance["obstacles"],
                "free": check.free,
            }
    return best


FIT = REGISTRY.keeps(
    Study(
        name="qiu_fit",
        title="Post-hoc fit of the meeting points of the master's halves",
        cells=_cells,
        compute=_cell,
        seed=SEED,
        settings={"ratios": list(RATIOS)},
    )
)
