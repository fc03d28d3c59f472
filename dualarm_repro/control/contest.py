"""Solvers side by side in one language: compiled loops over the same recorded problems."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from ..kernel import kernel
from .least_distance import least_distance
from .neural.network import network_rate
from .neural.network_settings import NetworkSettings
from .neural.primal_dual import iterate
from .parts import program_of
from .problem import QuadraticProgram
from .recorded import stacked


@kernel
def exact_all(stack, x):
    """Minimisers of all problems, each from nothing."""
    for f in range(len(stack.rows)):
        x[f] = least_distance(program_of(stack, f))[1]


@kernel
def newton_all(stack, network, steps, x):
    """``steps`` network steps of unit gain (Newton steps) a problem, warm from the one before."""
    n, m = len(stack.parts.target[0]), len(stack.parts.b[0])
    y, rate, still = np.zeros(n + m), np.empty(n + m), np.zeros(n + m)
    for f in range(len(stack.rows)):
        program = program_of(stack, f)
        for _ in range(steps):
            network_rate(network, 1.0, still, program, y, rate)
            y += rate
        x[f] = y[:n]


@kernel
def primal_dual_all(stack, iterations, x):
    """``iterations`` steps of the primal-dual network a problem, warm; z only while rows stay."""
    n, m = len(stack.parts.target[0]), len(stack.parts.b[0])
    u = np.zeros(n + m)
    for f in range(len(stack.rows)):
        longer = np.zeros(n + m + stack.rows[f])
        kept = len(u) if len(u) == len(longer) else n + m
        longer[:kept] = u[:kept]
        u = longer
        iterate(program_of(stack, f), u, iterations, 0.0)
        x[f] = u[:n]


@dataclass(frozen=True)
class Entry:
    """One contestant: accuracy over the problems and time a problem.

    ``error`` is the largest |x - x*| [rad/s], ``violation`` the largest violation of an inequality
    [m/s], ``microseconds`` median, ``low`` and ``high`` the quartiles of repeated runs.
    """

    solver: str
    effort: int
    error: float
    violation: float
    microseconds: float
    low: float
    high: float


def contest(
    problems: list[QuadraticProgram],
    network: NetworkSettings,
    newton_steps: tuple[int, ...],
    iterations: tuple[int, ...],
    repeats: int = 9,
) -> list[Entry]:
    """Time and accuracy of the exact method, the network and the primal-dual network.

    The problems are taken in order, so that each method starts from the state before; the exact one
    starts from nothing. Runs of the contestants alternate, so that load of the machine hits all.
    """
    stack = stacked(problems)
    numbers = network.numbers()
    runs: dict[tuple[str, int], Callable[[np.ndarray], None]] = {
        ("active_set", 1): partial(exact_all, stack)
    }
    for steps in newton_steps:
        runs["network", steps] = partial(newton_all, stack, numbers, steps)
    for count in iterations:
        runs["primal_dual", count] = partial(primal_dual_all, stack, count)
    found = {key: np.empty((len(problems), problems[0].size)) for key in runs}
    for key, run in runs.items():
        run(found[key])
    times: dict[tuple[str, int], list[float]] = {key: [] for key in runs}
    for _ in range(repeats):
        for key, run in runs.items():
            start = time.perf_counter()
            run(found[key])
            times[key].append(1e6 * (time.perf_counter() - start) / len(problems))
    exact = found["active_set", 1]
    return [
        Entry(
            *key,
            float(np.abs(found[key] - exact).max()),
            _violation(problems, found[key]),
            *(float(np.percentile(times[key], share)) for share in (50, 25, 75)),
        )
        for key in runs
    ]


def _violation(problems: list[QuadraticProgram], x: np.ndarray) -> float:
    return float(max((p.G @ v - p.h).max(initial=0.0) for p, v in zip(problems, x, strict=True)))
