"""Simulate a scenario with the exact controller."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import ArrayLike

from ..arguments import Shape, checked
from ..errors import InputError
from .assembly import make_buffers, stated_in
from .circle import Circles
from .closed_loop import DONE, Ending, Run, make_run, run_exact, take
from .few_constraints import make_work
from .motion import Motion
from .readings import Readings, readings_for
from .settings import ControllerNumbers, ControllerSettings
from .solvers import second_opinion
from .system import ArmSystem

#: Most steps of a run, all of which are kept.
MOST_STEPS = 2_000_000
#: Disturbance of a run without any.
UNDISTURBED = np.empty((0, 0))
#: Added to the rates of a network with n joints and m task rows, (steps, n + m).
Disturbance = Annotated[np.ndarray, Shape("T", "n + m")]
_PORTION = 2000  # steps between which a run can be stopped, tens of milliseconds
#: Weight of the slack on the task against |x|^2 / 2.
SLACK_WEIGHT = 1e4


@checked
def simulate(
    system: ArmSystem,
    circles: Circles,
    q0: ArrayLike,
    settings: ControllerSettings,
    *,
    dt: float = 1e-3,
    cycles: int = 1,
    slack: bool = False,
    slack_weight: float = SLACK_WEIGHT,
    smoothing: float = 0.0,
    readings: Readings | None = None,
) -> Motion:
    """Follow the circles from ``q0`` with the exact minimiser of every step.

    Parameters
    ----------
    dt : float [s]
    cycles : int
        How often the circles are run.
    slack : bool
        Let the task yield where it excludes the inequalities; else the run stops there, and
        ``Motion.stopped`` says why.
    slack_weight : float
        Of the slack against the rest of the objective: a large one gives up as little of the task
        as can be at every instant and chatters, a small one gives up more and is calm.
    smoothing : float
        Weight w of 1/2 w |x - x_before|^2, which keeps a joint velocity near the one before.
    readings : Readings, optional
        Errors of what the controller reads; default none.

    Raises
    ------
    ConfigurationError, InputError
        A bad configuration, step, number of cycles or number of circles.
    """
    q0, numbers, steps = checked_run(system, circles, q0, settings, dt, cycles)
    weights = slack_weight if slack else 0.0, smoothing
    readings = readings_for(system, readings)
    arrays, run = system.arrays, make_run(system.nq, len(system.arms), q0, steps)
    buffers = make_buffers(arrays, numbers)
    work = make_work(system.nq, 3 * len(system.arms), len(buffers.program.h))
    step, status = 0, DONE
    while step <= steps and status == DONE:
        span = step, min(step + _PORTION, steps + 1)
        arguments = arrays, numbers, circles.numbers(), *span, dt, weights, readings
        status, step, rows = run_exact(*arguments, run, buffers, work)
        other = None if status == DONE else second_opinion(stated_in(buffers, rows))
        if other is not None:
            take(run, step, other.x, rows, dt)
            step, status = step + 1, DONE
    return truncated(system, dt, status, min(step, steps), run)


@checked
def pseudo_inverse(settings: ControllerSettings) -> ControllerSettings:
    """The settings without inequalities: the minimiser is x = J^+ (dr/dt + K (r - f))."""
    return ControllerSettings(
        feedback=settings.feedback, repetition=settings.repetition, avoid=False, limits=False
    )


def checked_run(
    system: ArmSystem,
    circles: Circles,
    q0: ArrayLike,
    settings: ControllerSettings,
    dt: float,
    cycles: int,
) -> tuple[np.ndarray, ControllerNumbers, int]:
    """Start, settings for the kernels and number of steps of a run."""
    if len(circles.centre) != len(system.arms):
        raise InputError(
            "simulate", "circles", len(circles.centre), f"{len(system.arms)}, one per arm"
        )
    if not (np.isfinite(dt) and 0 < dt <= circles.duration):
        raise InputError("simulate", "dt", dt, f"a step in (0, {circles.duration:g}] s")
    if not (isinstance(cycles, int) and cycles > 0):
        raise InputError("simulate", "cycles", cycles, "a positive whole number")
    if not cycles * circles.duration / dt <= MOST_STEPS:
        raise InputError("simulate", "dt", dt, f"a step with at most {MOST_STEPS} in all")
    steps = round(cycles * circles.duration / dt)
    return system.configuration(q0), settings.numbers(), steps


def require_states(
    source: str,
    system: ArmSystem,
    disturbance: np.ndarray = UNDISTURBED,
    y0: np.ndarray | None = None,
) -> None:
    """Refuse a disturbance (steps, n + m) or a first state (n + m,) of a network for another number
    of joints n and task rows m than a system has."""
    size = system.nq + 3 * len(system.arms)
    if len(disturbance) and disturbance.shape[1] != size:
        raise InputError(source, "shape of disturbance", disturbance.shape, f"(steps, {size})")
    if y0 is not None and y0.shape != (size,):
        raise InputError(source, "shape of y0", y0.shape, f"({size},)")


def truncated(system: ArmSystem, dt: float, status: int, taken: int, run: Run) -> Motion:
    """Motion of the steps that were taken."""
    reason = None if status == DONE else f"{list(Ending)[status]} at t = {taken * dt:.3f} s"
    looks = run.q[: taken + 1], run.x[:taken], run.error[: taken + 1], run.distance[: taken + 1]
    steps = run.rows[:taken], run.slack[:taken]
    return Motion(dt, dt * np.arange(taken + 1), *looks, *steps, system.limits, reason)
