"""How near the networks come to the exact minimiser from a zero state, step by step and in time.

In time: with the gain g(t) both are functions of s = int g dt alone, dy/ds = -M^-1 F for the
network with linear activation and du/ds = -(I + M^T) e for the primal-dual one; t = s / gamma for a
constant gain and t = ln(1 + s / gamma) for g = gamma e^t.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from .contest import newton_until
from .neural.network import network_rate
from .neural.network_settings import NetworkSettings
from .neural.primal_dual import flow, iterate
from .parts import ProgramStack
from .problem import QuadraticProgram
from .solvers import solve

_STEP_NETWORK = 0.05  # Euler steps of s; the flow decays with the rate 1
_STEP_PRIMAL_DUAL = 0.02  # and that of the other with rates up to the square of the largest row


def first_within(errors: np.ndarray, threshold: float) -> int | None:
    """Index of the first error within the threshold."""
    below = np.flatnonzero(errors <= threshold)
    return int(below[0]) if len(below) else None


def network_errors(p: QuadraticProgram, network: NetworkSettings, steps: int) -> np.ndarray:
    """|x - x*|_inf before each of so many steps of unit gain (Newton steps) [rad/s]."""
    size, exact = p.size + len(p.b), solve(p).x
    y, rate, still, errors = np.zeros(size), np.empty(size), np.zeros(size), []
    for _ in range(steps):
        errors.append(float(np.abs(y[: p.size] - exact).max()))
        network_rate(network.numbers(), 1.0, still, p.parts, y, rate)
        y += rate
    return np.array(errors)


def primal_dual_errors(p: QuadraticProgram, counts: Iterable[int]) -> np.ndarray:
    """|x - x*|_inf of the primal-dual network after these rising numbers of iterations [rad/s]."""
    exact, u, done, errors = solve(p).x, np.zeros(p.size + len(p.b) + len(p.h)), 0, []
    for count in counts:
        iterate(p.parts, u, int(count) - done, 0.0)
        done = int(count)
        errors.append(float(np.abs(u[: p.size] - exact).max()))
    return np.array(errors)


def network_flow(p: QuadraticProgram, network: NetworkSettings, grid: np.ndarray) -> np.ndarray:
    """|x - x*|_inf of the network in continuous time at the rising values s of a grid [rad/s]."""
    size, exact = p.size + len(p.b), solve(p).x
    y, rate, still, s, errors = np.zeros(size), np.empty(size), np.zeros(size), 0.0, []
    for end in grid:
        for step in _steps(end - s, _STEP_NETWORK):
            network_rate(network.numbers(), 1.0, still, p.parts, y, rate)
            y += step * rate
        s = end
        errors.append(float(np.abs(y[: p.size] - exact).max()))
    return np.array(errors)


def primal_dual_flow(p: QuadraticProgram, grid: np.ndarray) -> np.ndarray:
    """The same of the primal-dual network [rad/s]."""
    exact, u, s, errors = solve(p).x, np.zeros(p.size + len(p.b) + len(p.h)), 0.0, []
    for end in grid:
        steps = _steps(end - s, _STEP_PRIMAL_DUAL)
        if len(steps):
            flow(p.parts, u, steps[0], len(steps))
        s = end
        errors.append(float(np.abs(u[: p.size] - exact).max()))
    return np.array(errors)


def _steps(length: float, longest: float) -> np.ndarray:
    """Equal steps, none longer than allowed, that make up a length."""
    count = int(np.ceil(length / longest - 1e-9))
    return np.full(count, length / max(count, 1))


def steps_in_a_row(
    problems: ProgramStack,
    exact: np.ndarray,
    network: NetworkSettings,
    threshold: float,
    most: int,
) -> np.ndarray:
    """Newton steps (F,) that each of F problems in a row takes to |x - x*|_inf <= threshold.

    Parameters
    ----------
    problems : ProgramStack
    exact : (F, n)
        Their minimisers x* [rad/s].

    Returns
    -------
    ndarray (F,) of int
        -1 where ``most`` steps are not enough. Every problem starts from the state before and takes
        one step at least, for its answer is due before anybody knows that the old one would do.
    """
    steps = np.empty(len(exact), np.int64)
    newton_until(problems, network.numbers(), exact, threshold, most, steps)
    return steps
