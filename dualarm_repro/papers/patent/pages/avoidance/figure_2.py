"""Figure 2: one task with and without mutual avoidance."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from .....control.axis_distance import axis_distances, largest_thickness, nearest_points
from .....control.frozen import FrozenScenario
from .....control.motion import Motion
from .....control.settings import ControllerSettings
from .....control.simulate import pseudo_inverse
from .....control.trajectory import trajectories
from .....ledger import REGISTRY, Assumed, Bounded, Is, Result
from .....ledger.captions import captions
from .....view.control_figures import comparison_figure
from .....view.crossing import Crossing
from .....view.link_bodies import Body
from .....view.scene3d import Scene3D
from .....view.style import MASTER, SLAVE
from ...document import run
from ...reading import AVOIDANCE, controller_settings, crossing

checks = partial(REGISTRY.checks, page="patent/avoidance")
caption = captions(__file__)


@checks(
    "patent.fig02",
    samples=32,
    rules=[
        Bounded("naive_distance", "without avoidance the arms touch [m]", high=0.0),
        Bounded(
            "shortfall", "with it the distance falls short of d2 by at most [m]", high="resolution"
        ),
        Bounded(
            "tip_steps",
            "the tips leave their paths by at most what they move in a step, share",
            high=1,
        ),
        Is("completed", "over the whole task", value=True),
    ],
)
def comparison(assumed: Assumed) -> Result:
    """Figure 2: one task with the avoidance rows off and on."""
    scenario = crossing(assumed, "duration", "time_law")
    settings = controller_settings(assumed, *AVOIDANCE, "feedback_gain")
    dt, by_axis = assumed["time_step"], assumed["distance_measure"] == "axis"
    if by_axis:
        settings = _between_axes(settings, scenario)
    naive, motion = run(scenario, pseudo_inverse(settings), dt), run(scenario, settings, dt)
    axes = float(axis_distances(scenario.system, motion.q).min())
    fastest = _path_speed(scenario)
    parts = scenario.system, scenario.circles
    table = trajectories({"without": (*parts, naive), "with": (*parts, motion)})
    return Result(
        obtained={
            "naive_distance": naive.smallest_distance,
            "distance": motion.smallest_distance,
            "axis_distance": axes,
            "shortfall": settings.inner - (axes if by_axis else motion.smallest_distance),
            "tip_error": motion.largest_error,
            "tip_steps": motion.largest_error / (fastest * dt),
            "completed": motion.completed,
            "energy_ratio": motion.energy / naive.energy,
            "peak_speed": motion.peak_speed,
            "peak_acceleration": motion.peak_acceleration,
        },
        table=table,
        caption=caption("fig02", scenario=scenario, naive=naive, motion=motion, step=fastest * dt),
        alt=(
            "Two pictures of two arms with their capsules, which overlap without avoidance and are "
            "apart with it, a line between the nearest points; below, their distance over time, "
            "which falls below zero without avoidance and stays above the inner range with it."
        ),
        figure=lambda: _comparison_figure(scenario, settings, naive, motion),
        scene=lambda: _scene(scenario, motion),
    )


def _between_axes(settings: ControllerSettings, scenario: FrozenScenario) -> ControllerSettings:
    """Ranges between link axes, wider by the thickness of the two thickest links that move."""
    thickness = largest_thickness(scenario.system)
    ranges = {"inner": settings.inner + thickness, "outer": settings.outer + thickness}
    return settings.changed(surface=False, **ranges)


def _path_speed(scenario: FrozenScenario) -> float:
    """Largest speed of a tip along its path [m/s]."""
    velocities = [scenario.circles.at(t)[1] for t in np.linspace(0.0, scenario.period, 201)]
    return float(np.linalg.norm(velocities, axis=-1).max())


def _tip_paths(scenario: FrozenScenario) -> list[np.ndarray]:
    times = np.linspace(0.0, scenario.period, 121)
    points = np.array([scenario.circles.at(t)[0] for t in times])
    return [points[:, 0], points[:, 1]]


def _crossing(scenario: FrozenScenario, q: np.ndarray, step: int) -> Crossing:
    """Both arms at one instant, with the nearest points of their links."""
    left, right = scenario.system.arms
    halves = np.split(q, 2)
    bodies = Body(left, halves[0], MASTER, step), Body(right, halves[1], SLAVE, step)
    first, second = _tip_paths(scenario)
    return Crossing(bodies, (first, second), nearest_points(scenario.system, q))


def _comparison_figure(
    scenario: FrozenScenario, settings: ControllerSettings, naive: Motion, motion: Motion
) -> Any:
    worst = int(naive.distance.argmin())
    at = min(worst, len(motion.q) - 1)
    return comparison_figure(
        {
            "without avoidance": (naive.time, naive.distance),
            "with avoidance": (motion.time, motion.distance),
        },
        {
            "without avoidance": _crossing(scenario, naive.q[worst], worst),
            "with avoidance": _crossing(scenario, motion.q[at], at),
        },
        (settings.inner, settings.outer),
    )


def _scene(scenario: FrozenScenario, motion: Motion) -> Scene3D:
    made = Scene3D(f"{scenario.title}: the motion with avoidance.", camera=(1.9, 0.4, 1.3))
    every = max(1, round(0.1 / motion.dt))
    path = motion.q[::every]
    halves = np.split(path, 2, axis=1)
    for placed, part, color, points in zip(
        scenario.system.arms, halves, (MASTER, SLAVE), _tip_paths(scenario), strict=True
    ):
        made.add_arm(placed.name, placed.arm, part[0], placed.placement, color)
        made.add_path(f"{placed.name} path", points, color)
    made.animate(
        {p.name: (p.arm, part) for p, part in zip(scenario.system.arms, halves, strict=True)},
        fps=10,
        every=1,
    )
    return made
