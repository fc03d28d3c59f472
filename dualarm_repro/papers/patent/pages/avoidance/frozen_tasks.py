"""Promises on frozen tasks: joint limits, the two ranges, and against the pseudo-inverse."""

from __future__ import annotations

from functools import partial
from time import perf_counter

import numpy as np

from .....control.controller import VelocityController
from .....control.frozen import FrozenScenario
from .....control.motion import Motion
from .....control.neural.fixed_step import simulate_network
from .....control.neural.network_settings import NetworkSettings
from .....control.operations import control_cost, network_control_cost
from .....control.settings import ControllerSettings
from .....control.simulate import pseudo_inverse
from .....control.trajectory import trajectories
from .....ledger import REGISTRY, Assumed, Bounded, Generally, Residual, Result
from .....ledger.captions import captions
from .....tracking import memo
from .....view.control_figures import damper_figure
from ...document import COARSE_STEP, CONTROL_STEP, frozen, run
from ...reading import LIMITS, controller_settings
from .random_tasks import admitted_tasks, counted_tasks

checks = partial(REGISTRY.checks, page="patent/avoidance")
caption = captions(__file__)
_nearly_all = partial(Generally, at_least="nearly_all", margin="margin")


@checks(
    "patent.claim_limits",
    samples=32,
    rules=[
        Bounded("naive_excess", "the pseudo-inverse exceeds an angle limit by [rad]", low=0.0),
        Bounded("angle_excess", "the QP, at most by [rad]", high=0.0),
        Bounded("network_excess", "the network, at most by [rad]", high=0.0),
        Bounded(
            "naive_speed_excess",
            "on a fast task the pseudo-inverse exceeds a speed limit by [rad/s]",
            low=0.0,
        ),
        Bounded("speed_excess", "the QP, at most by [rad/s]", high=1e-9),
        Bounded("network_speed_excess", "the network, at most by [rad/s]", high=0.0),
        _nearly_all("within", "admitted random tasks within all limits, by the exact QP"),
        _nearly_all("network_within", "the same by the network"),
    ],
)
def respects_limits(assumed: Assumed) -> Result:
    """Angle limits on a task that drives joints to them, speed limits on the same task run fast."""
    settings = controller_settings(assumed, *LIMITS)
    slow, fast = frozen("limits"), frozen("limits", duration=assumed["fast_duration"])
    table = admitted_tasks(assumed)
    within = {
        name: {
            "count": int(
                (table[[f"{name}_beyond_angle", f"{name}_beyond_speed"]] <= 1e-9).all(axis=1).sum()
            ),
            "of": len(table),
        }
        for name in ("slack", "network")
    }
    calm, motions = _three(slow, settings, COARSE_STEP), _three(fast, settings, CONTROL_STEP)
    named = {
        f"{way}, {pace}": (scenario.system, scenario.circles, motion)
        for pace, scenario, found in (("slow", slow, calm), ("fast", fast, motions))
        for way, motion in zip(_WAYS, found, strict=True)
    }
    return Result(
        obtained={
            "naive_excess": calm[0].angle_excess,
            "angle_excess": calm[1].angle_excess,
            "network_excess": calm[2].angle_excess,
            "naive_speed_excess": motions[0].speed_excess,
            "speed_excess": motions[1].speed_excess,
            "network_speed_excess": motions[2].speed_excess,
            "within": within["slack"],
            "network_within": within["network"],
            "fast_slack": float(motions[1].slack.max()),
            "network_broken": list(motions[2].broken),
        },
        table=trajectories(named),
        caption=caption("claim_limits", slow=slow.period, fast=fast.period),
    )


@checks(
    "patent.claim_two_ranges",
    samples=32,
    rules=[
        Residual(
            "outside",
            "beyond d1 the joint velocity is that without avoidance, to [rad/s]",
            high=1e-9,
        ),
        Bounded("inside", "within d1 it differs from that, at most by [rad/s]", low="adjusted"),
        Bounded("shortfall", "the distance falls short of d2 by at most [m]", high="resolution"),
        Bounded(
            "end_shortfall",
            "after a start below d2 the distance falls short of d2 in the end by [m]",
            high="resolution",
        ),
        Bounded(
            "network_shortfall",
            "with the network the distance falls short of d2 by at most [m]",
            high="resolution",
        ),
        Bounded(
            "network_end_shortfall",
            "and after the start below d2 in the end by [m]",
            high="resolution",
        ),
    ],
)
def two_ranges(assumed: Assumed) -> Result:
    """Distance, rows, approach and bound along the frozen task; a start inside the inner range."""
    names = ("outer_range", "inner_range", "damper_law", "damper_gain", "pair_selection")
    settings, scenario = controller_settings(assumed, *names), frozen("crossing")
    motion = run(scenario, settings, COARSE_STEP)
    controller = VelocityController(scenario.system, settings)
    approach, bound = _nearest_pair(scenario, controller, motion)
    inside = motion.distance[:-1] < settings.outer
    changed = _changed(scenario, settings, motion)
    close = frozen("too_close")
    start = run(close, settings, COARSE_STEP, slack=True)
    network = _by_network(scenario, settings, CONTROL_STEP)
    network_start = _by_network(close, settings, CONTROL_STEP)
    parts, close_parts = scenario.parts[:2], close.parts[:2]
    return Result(
        obtained={
            "outside": float(changed[~inside].max(initial=0.0)),
            "inside": float(changed[inside].max(initial=0.0)),
            "shortfall": settings.inner - motion.smallest_distance,
            "end_shortfall": float(settings.inner - start.distance[-1]),
            "network_shortfall": settings.inner - network.smallest_distance,
            "network_end_shortfall": float(settings.inner - network_start.distance[-1]),
            "network_broken": list(network_start.broken),
            "start_distance": float(start.distance[0]),
            "inside_share": float(inside.mean()),
        },
        caption=caption(
            "claim_two_ranges",
            distance=motion.smallest_distance,
            end=start.distance[-1],
            network=network.smallest_distance,
            network_end=network_start.distance[-1],
            speed=network_start.speed_excess,
        ),
        table=trajectories(
            {
                "crossing, QP": (*parts, motion),
                "start below d2, QP": (*close_parts, start),
            }
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
        Bounded("naive_distance", "pseudo-inverse: smallest distance [m]", high=0.0),
        Bounded("distance", "QP: smallest distance [m]", low=0.0),
        Bounded("naive_excess", "pseudo-inverse: excess over an angle limit [rad]", low=0.0),
        Bounded("excess", "QP: excess over an angle limit [rad]", high=0.0),
        Bounded("period_share", "operations of a step, share of the period", high=1),
    ],
)
def against_pseudo_inverse(assumed: Assumed) -> Result:
    """Violations of both on the same tasks, and the operations of one step in its period."""
    settings = controller_settings(assumed, "avoidance_form", "limit_form")
    dt, near, far = assumed["time_step"], frozen("crossing"), frozen("limits")
    naive = [run(s, pseudo_inverse(settings), dt) for s in (near, far)]
    exact = [run(s, settings, dt) for s in (near, far)]
    counted = counted_tasks(assumed)
    leave = float((counted["naive_beyond_angle"] > 0).mean())
    steps = step_operations(settings, assumed["function_cost"])
    period = max(steps.values()) / assumed["operation_rate"] / dt
    return Result(
        obtained={
            "naive_distance": naive[0].smallest_distance,
            "distance": exact[0].smallest_distance,
            "naive_excess": naive[1].angle_excess,
            "excess": exact[1].angle_excess,
            "period_share": period,
            **{f"{name}_operations": count for name, count in steps.items()},
            "random_tasks_beyond_limits": leave,
            "random_tasks_colliding": float(counted["collides"].mean()),
        },
        measured={
            f"{name}_step_us": 1e6 * _step_seconds(near, s)
            for name, s in (("pinv", pseudo_inverse(settings)), ("qp", settings))
        },
        caption=caption("claim_vs_pinv", tasks=len(counted), dt=dt, rate=assumed["operation_rate"]),
    )


_WAYS = ("pseudo-inverse", "QP", "network")


def _three(
    scenario: FrozenScenario, settings: ControllerSettings, dt: float
) -> tuple[Motion, Motion, Motion]:
    """Motions by the pseudo-inverse, by the QP with slack, and by the network."""
    return (
        run(scenario, pseudo_inverse(settings), dt),
        run(scenario, settings, dt, slack=True),
        _by_network(scenario, settings, dt),
    )


def _by_network(scenario: FrozenScenario, settings: ControllerSettings, dt: float) -> Motion:
    return simulate_network(*scenario.parts, settings, NetworkSettings(), dt=dt)


def _changed(scenario: FrozenScenario, settings: ControllerSettings, motion: Motion) -> np.ndarray:
    """How far each joint velocity is from the one without avoidance at the same place [rad/s]."""
    controller = VelocityController(scenario.system, settings.changed(avoid=False))
    return np.array(
        [
            np.abs(controller.velocity(q, *scenario.circles.at(t)) - x).max()
            for q, t, x in zip(motion.q[:-1], motion.time[:-1], motion.x, strict=True)
        ]
    )


@memo(64)
def step_operations(settings: ControllerSettings, function_cost: float) -> dict[str, float]:
    """Operations of one whole step of each solver where most rows are active."""
    scenario = frozen("crossing")
    motion = run(scenario, settings, COARSE_STEP)
    k = int(motion.rows.argmax())
    q, t = motion.q[k], float(motion.time[k])
    y = np.concatenate([motion.x[k], np.zeros(3 * len(scenario.system.arms))])
    return {
        "qp": control_cost(*scenario.parts, settings, q, t).total(function_cost),
        "network": network_control_cost(
            *scenario.parts, settings, NetworkSettings(), CONTROL_STEP, q, t, y
        ).total(function_cost),
    }


def _nearest_pair(
    scenario: FrozenScenario, controller: VelocityController, motion: Motion
) -> tuple[np.ndarray, np.ndarray]:
    """Approach of the row with the least room, and its bound, at every step; NaN without."""
    approach, bound = np.full((2, len(motion.x)), np.nan)
    for k, (q, x) in enumerate(zip(motion.q[:-1], motion.x, strict=True)):
        if motion.rows[k]:
            p = controller.problem(q, *scenario.circles.at(motion.time[k]))
            row = int(np.argmax(p.G @ x - p.h))
            approach[k], bound[k] = p.G[row] @ x, p.h[row]
    return approach, bound


def _step_seconds(scenario: FrozenScenario, settings: ControllerSettings) -> float:
    """Time of one step within the compiled loop [s], the best of three runs."""
    times = []
    for _ in range(3):
        start = perf_counter()
        motion = run(scenario, settings, COARSE_STEP)
        times.append((perf_counter() - start) / len(motion.x))
    return min(times)
