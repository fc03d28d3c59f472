"""3-D scenes of arms among spheres: standing, inside a hull, or played along the paths of a search;
and the panels of flange paths that go with them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np

from ..planning.field.control_points import end_effector
from ..planning.field.hull_obstacle import circles_on
from ..planning.search.dual_search import DualSearch
from ..planning.search.search_plan import SearchPlan
from ..scene import ConvexHull, PlacedArm, Sphere
from .scene3d import Scene3D
from .style import GREEN, MASTER, ORANGE, SLAVE
from .tip_paths import TipPanel

Camera = tuple[float, float, float]
_POSTURES, _TIMES = 6, 5


def standing(title: str, arms: Iterable[PlacedArm], q: np.ndarray, camera: Camera) -> Scene3D:
    """Master and slave in the posture q (nq,)."""
    made = Scene3D(title, camera=camera)
    for placed, color in zip(arms, (MASTER, SLAVE), strict=True):
        made.add_arm(placed.name, placed.arm, q, placed.placement, color)
    return made


def inside_hull(
    title: str, placed: PlacedArm, q: np.ndarray, hull: ConvexHull, camera: Camera
) -> Scene3D:
    """An arm in the posture q (nq,) and a translucent hull around it."""
    made = Scene3D(title, camera=camera)
    made.add_arm(placed.name, placed.arm, q, placed.placement, MASTER)
    made.add_mesh("hull", hull.vertices, hull.faces, ORANGE, 0.45)
    return made


def among_spheres(title: str, spheres: Mapping[str, Sphere], camera: Camera) -> Scene3D:
    """A scene with spheres in it."""
    made = Scene3D(title, camera=camera)
    for name, sphere in spheres.items():
        made.add_sphere(name, sphere.center, sphere.radius, ORANGE, solid=True)
    return made


def played_search(
    title: str,
    plan: SearchPlan,
    spheres: Mapping[str, Sphere],
    curves: Mapping[str, tuple[np.ndarray, str]],
) -> Scene3D:
    """A search among spheres, played; ``curves`` are points (N, 3) and their colour by name."""
    made, placed = among_spheres(title, spheres, (1.4, 0.9, 1.2)), plan.placed
    made.add_arm(placed.name, placed.arm, plan.problem.start, placed.placement, MASTER)
    made.animate({placed.name: (placed.arm, plan.path)})
    for name, (points, color) in curves.items():
        made.add_path(name, points, color)
    return made


def played_pair(
    title: str, plan: DualSearch, spheres: Mapping[str, Sphere], camera: Camera
) -> Scene3D:
    """Both arms played by the time map, with the hull of the master at its middle pose."""
    made, paths, arms = among_spheres(title, spheres, camera), plan.played(), plan.arms
    for placed, path, color in zip(arms, paths, (MASTER, SLAVE), strict=True):
        made.add_arm(placed.name, placed.arm, path[0], placed.placement, color)
        made.add_path(f"{placed.name} flange", end_effector(placed, path), color)
    middle = plan.master_path[len(plan.master_path) // 2]
    hull = ConvexHull(circles_on(arms[0], plan.circles, middle[np.newaxis])[0])
    made.add_mesh("hull", hull.vertices, hull.faces, GREEN, 0.25)
    made.animate({p.name: (p.arm, path) for p, path in zip(arms, paths, strict=True)})
    return made


def search_panel(
    title: str, plan: SearchPlan, paths: Mapping[str, np.ndarray], marks: Mapping[str, np.ndarray]
) -> TipPanel:
    """Paths and marked points of a search with postures on its way."""
    shown = plan.path[:: max(1, len(plan.path) // _POSTURES)]
    return TipPanel(title, dict(paths), [(plan.placed, q) for q in shown], dict(marks))


def pair_panel(title: str, plan: DualSearch) -> TipPanel:
    """Both arms at common times, and the paths of their flanges."""
    paths = plan.played()
    times = np.linspace(0, len(paths[0]) - 1, _TIMES).round().astype(int)
    return TipPanel(
        title,
        {placed.name: tip for placed, tip in zip(plan.arms, plan.tips(), strict=True)},
        [(placed, path[k]) for placed, path in zip(plan.arms, paths, strict=True) for k in times],
        {},
    )
