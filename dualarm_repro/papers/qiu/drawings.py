"""Runs of `qiu` drawn among its spheres."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ...planning.search.search_plan import SearchPlan
from ...view.scene3d import Scene3D
from ...view.style import MASTER, ORANGE
from ...view.tip_paths import TipPanel
from .document import PRINTED, spheres

_POSTURES = 6


def among_spheres(
    title: str, plan: SearchPlan, paths: Mapping[str, np.ndarray], marks: Mapping[str, np.ndarray]
) -> TipPanel:
    """Paths and marked points of a search with postures on its way."""
    shown = plan.path[:: max(1, len(plan.path) // _POSTURES)]
    return TipPanel(title, dict(paths), [(plan.problem.placed, q) for q in shown], dict(marks))


def with_spheres(title: str, camera: tuple[float, float, float]) -> Scene3D:
    """A scene with both spheres in it."""
    made = Scene3D(title, camera=camera)
    for name, sphere in spheres().items():
        made.add_sphere(name, sphere.center, sphere.radius, ORANGE)
    return made


def played(title: str, plan: SearchPlan) -> Scene3D:
    """A search of the master among the spheres, played."""
    made, placed = with_spheres(title, (1.4, 0.9, 1.2)), plan.problem.placed
    made.add_arm("master", placed.arm, PRINTED.start, placed.placement, MASTER)
    made.animate({"master": (placed.arm, plan.path)})
    return made
