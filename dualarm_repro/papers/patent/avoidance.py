"""The claims on limits, on the two ranges and against the pseudo-inverse."""

from __future__ import annotations

from functools import partial
from time import perf_counter

import numpy as np

from ...control.controller import VelocityController
from ...control.motion import Motion
from ...control.neural.fixed_step import simulate_network
from ...control.neural.network_settings import NetworkSettings
from ...control.settings import Settings
from ...control.simulate import pseudo_inverse
from ...ledger import REGISTRY, Assumed, Bounded, Is, Result
from ...view.control_figures import damper_figure
from .program import angle_excess
from .random_task_claims import counted_tasks
from .scenario import COARSE_STEP, Frozen, frozen, run, settings_of

checks = partial(REGISTRY.checks, page="patent/avoidance")


@checks(
    "patent.claim_limits",
    samples=32,
    rules=[
        Bounded(
            key="naive_excess", low=0.0, label="the pseudo-inverse exceeds an angle limit by [rad]"
        ),
        Bounded(key="angle_excess", high=0.0, label="the QP, at most by [rad]"),
        Bounded(key="speed_excess", high=1e-9, label="a speed limit, at most by [rad/s]"),
        Bounded(key="network_excess", high=0.0, label="the network, at most by [rad]"),
    ],
)
def respects_limits(assumed: Assumed) -> Result:
    """Angle and speed limits on a task that drives joints to them, by the QP and by the network."""
    scenario = frozen("limits")
    settings = settings_of(assumed, "limit_form", "limit_gain", "limit_margin")
    naive = run(scenario, pseudo_inverse(settings), COARSE_STEP)
    motion = run(scenario, settings, COARSE_STEP)
    arguments = (scenario.system, scenario.circles, scenario.q0, settings, NetworkSettings())
    network = simulate_network(*arguments, dt=COARSE_STEP)
    excess = [angle_excess(scenario, m.q) for m in (naive, motion, network)]
    return Result(
        obtained={
            "naive_excess": excess[0],
            "angle_excess": excess[1],
            "network_excess": excess[2],
            "speed_excess": float((np.abs(motion.x) - scenario.system.arrays.speed).max()),
            "tip_error": motion.largest_error,
        },
        caption=(
            f"Where the pseudo-inverse leaves a joint range by {excess[0]:.3f} rad, the QP keeps "
            f"{-excess[1]:.4f} rad from every limit and the network, whose bounds are soft, "
            f"{-excess[2]:.4f} rad; the tips stay within {1e6 * motion.largest_error:.0f} um of "
            "their circles. Speeds never reach their limits here."
        ),
    )


@checks(
    "patent.claim_two_ranges",
    samples=32,
    rules=[
        Is(
            key="active_inside_only",
            value=True,
            label="rows exist exactly where the distance is below d1",
        ),
        Bounded(
            key="overspeed",
            high=1e-3,
            label="a pair approaches faster than its bound by at most [m/s]",
        ),
        Bounded(key="shortfall", high=1e-3, label="the distance falls short of d2 by at most [m]"),
        Bounded(key="recovered", low=-1e-3, label="a start below d2 ends above it by [m]"),
    ],
)
def two_ranges(assumed: Assumed) -> Result:
    """Distance, rows, approach and bound along the frozen task; a start inside the inner range."""
    names = ("outer_range", "inner_range", "damper_law", "damper_gain", "pair_selection")
    settings, scenario = settings_of(assumed, *names), frozen("crossing")
    motion = run(scenario, settings, COARSE_STEP)
    controller = VelocityController(scenario.system, settings)
    approach, bound = _nearest_pair(scenario, controller, motion)
    inside = motion.distance[:-1] < settings.outer
    start = run(frozen("too_close"), settings, COARSE_STEP, slack=True)
    overspeed = float(np.nanmax(np.where(inside, approach - bound, -np.inf)))
    return Result(
        obtained={
            "active_inside_only": bool(((motion.rows > 0) == inside).all()),
            "overspeed": overspeed,
            "shortfall": settings.inner - motion.smallest_distance,
            "recovered": float(start.distance[-1] - settings.inner),
            "start_distance": float(start.distance[0]),
            "inside_share": float(inside.mean()),
        },
        caption=(
            f"Rows come and go with d1: the nearest pair is inside it for {inside.mean():.0%} of "
            "the time. Inside, its approach stays below the bound that falls to zero at d2, and "
            f"the distance ends up at {1e3 * motion.smallest_distance:.1f} mm. A second scenario "
            f"starts {1e3 * start.distance[0]:.1f} mm apart, below d2, where the bound is "
            f"negative: the arms separate and end {1e3 * start.distance[-1]:.0f} mm apart."
        ),
        alt="Distance between two ranges, approach speed below its falling bound, and number of "
        "rows over time.",
        figure=lambda: damper_figure(
            motion.time[:-1],
            motion.distance[:-1],
            motion.rows,
            approach,
            bound,
            (settings.inner, settings.outer),
        ),
    )


@checks(
    "patent.claim_vs_pinv",
    samples=16,
    rules=[
        Bounded(key="naive_distance", high=0.0, label="pseudo-inverse: smallest distance [m]"),
        Bounded(key="distance", low=0.0, label="QP: smallest distance [m]"),
        Bounded(
            key="naive_excess", low=0.0, label="pseudo-inverse: excess over an angle limit [rad]"
        ),
        Bounded(key="excess", high=0.0, label="QP: excess over an angle limit [rad]"),
        Is(key="real_time", value=True, label="a step of either takes less time than it lasts"),
    ],
)
def against_pseudo_inverse(assumed: Assumed) -> Result:
    """Violations of both on the same tasks, and the time of one step."""
    settings = settings_of(assumed, "avoidance_form", "limit_form")
    dt, near, far = assumed["time_step"], frozen("crossing"), frozen("limits")
    naive = [run(s, pseudo_inverse(settings), dt) for s in (near, far)]
    exact = [run(s, settings, dt) for s in (near, far)]
    counted = counted_tasks(assumed)
    times = {
        name: _step_time(near, s)
        for name, s in (("pinv", pseudo_inverse(settings)), ("qp", settings))
    }
    leave = float((counted["naive_beyond_angle"] > 0).mean())
    return Result(
        obtained={
            "naive_distance": naive[0].smallest_distance,
            "distance": exact[0].smallest_distance,
            "naive_excess": angle_excess(far, naive[1].q),
            "excess": angle_excess(far, exact[1].q),
            "real_time": max(times.values()) < dt,
            "random_tasks_beyond_limits": leave,
            "random_tasks_colliding": float(counted["collides"].mean()),
        },
        measured={f"{name}_step_us": 1e6 * value for name, value in times.items()},
        caption=(
            "The QP takes constraints into account that the pseudo-inverse cannot express: of "
            f"{len(counted)} random tasks the pseudo-inverse leaves a joint range in {leave:.0%} "
            f"and collides in {counted['collides'].mean():.1%}. Real time is no difference "
            "between them: a step of either takes a small share of the control period."
        ),
    )


def _nearest_pair(
    scenario: Frozen, controller: VelocityController, motion: Motion
) -> tuple[np.ndarray, np.ndarray]:
    """Approach of the row with the least room, and its bound, at every step; NaN without."""
    approach, bound = np.full((2, len(motion.x)), np.nan)
    for k, (q, x) in enumerate(zip(motion.q[:-1], motion.x, strict=True)):
        if motion.rows[k]:
            p = controller.problem(q, *scenario.circles.at(motion.time[k]))
            row = int(np.argmax(p.G @ x - p.h))
            approach[k], bound[k] = p.G[row] @ x, p.h[row]
    return approach, bound


def _step_time(scenario: Frozen, settings: Settings) -> float:
    """Time of one step within the compiled loop [s], the best of three runs."""
    times = []
    for _ in range(3):
        start = perf_counter()
        motion = run(scenario, settings, COARSE_STEP)
        times.append((perf_counter() - start) / len(motion.x))
    return min(times)
