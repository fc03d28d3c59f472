"""Solvers side by side in one language: compiled loops over the same recorded problems."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from ..kernel import kernel
from .least_distance import least_distance
from .least_norm import least_norm
from .neural.network import network_rate
from .neural.network_settings import NetworkSettings
from .neural.primal_dual import iterate
from .parts import program_of
from .problem import QuadraticProgram
from .recorded import stacked
from .solvers import SOLVERS, solve
from .warm_start import least_distance_from

_LOST = 1e6  # error [rad/s] beyond which a state is given up


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
def newton_until(stack, network, exact, threshold, most, steps):
    """Steps (F,) that each problem takes, warm, to be within ``threshold`` of ``exact``; or -1."""
    n, m = len(stack.parts.target[0]), len(stack.parts.b[0])
    y, rate, still = np.zeros(n + m), np.empty(n + m), np.zeros(n + m)
    for f in range(len(stack.rows)):
        program, steps[f] = program_of(stack, f), -1
        for k in range(most):
            network_rate(network, 1.0, still, program, y, rate)
            y += rate
            error = np.abs(y[:n] - exact[f]).max()
            if error <= threshold:
                steps[f] = k + 1
                break
            if not error < _LOST:  # no way back for the problems that follow
                y[:] = 0.0
                break


@kernel
def warm_all(stack, x):
    """Minimisers of all problems, each tried from the constraints that pressed the time before."""
    pressing, at_bound = np.zeros(0, np.bool_), np.zeros(len(stack.parts.target[0]), np.int64)
    for f in range(len(stack.rows)):
        if len(pressing) != stack.rows[f]:
            pressing = np.zeros(stack.rows[f], np.bool_)
        _, _, x[f], _, z, w = least_distance_from(program_of(stack, f), pressing, at_bound)
        pressing[:] = z > 0.0
        for i in range(len(w)):
            at_bound[i] = 1 if w[i] > 0.0 else -1 if w[i] < 0.0 else 0


@kernel
def pseudo_inverse_all(stack, x):
    """J^+ b of all problems, without any inequality."""
    multipliers = np.empty(len(stack.parts.b[0]))
    for f in range(len(stack.rows)):
        program = program_of(stack, f)
        least_norm(program.target, program.A, program.b, x[f], multipliers)


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
    """Time and accuracy of the exact method, the networks and the pseudo-inverse.

    The problems are taken in order, so that each method starts from the state before; the exact one
    starts from nothing. Runs of the contestants alternate, so that load of the machine hits all.
    """
    stack = stacked(problems)
    numbers = network.numbers()
    runs: dict[tuple[str, int], Callable[[np.ndarray], None]] = {
        ("active_set", 1): partial(exact_all, stack),
        ("active_set_warm", 1): partial(warm_all, stack),
        ("pseudo_inverse", 1): partial(pseudo_inverse_all, stack),
    }
    for steps in newton_steps:
        runs["network", steps] = partial(newton_all, stack, numbers, steps)
    for count in iterations:
        runs["primal_dual", count] = partial(primal_dual_all, stack, count)
    found = {key: np.empty((len(problems), problems[0].size)) for key in runs}
    for key, run in runs.items():
        run(found[key])
    times = _times({key: partial(run, found[key]) for key, run in runs.items()}, repeats)
    exact = found["active_set", 1]
    return [
        _entry(*key, problems, found[key], exact, [t / len(problems) for t in times[key]])
        for key in runs
    ]


def exact_batch(problems: list[QuadraticProgram], repeats: int = 3) -> list[Entry]:
    """Time and accuracy of every exact and iterative solver over the same problems.

    Each is called from Python, problem by problem, as a user would; the certificate of each answer
    is part of it. Errors are taken from the active set's answers.
    """
    runs = {name: partial(_solve_all, problems, name) for name in SOLVERS}
    found = {name: run() for name, run in runs.items()}
    times = _times(runs, repeats)
    return [
        _entry(name, 1, problems, x, found["active_set"], [t / len(problems) for t in times[name]])
        for name, x in found.items()
    ]


def _solve_all(problems: list[QuadraticProgram], solver: str) -> np.ndarray:
    return np.array([solve(problem, solver).x for problem in problems])


def _times(runs: Mapping[Any, Callable[[], object]], repeats: int) -> dict[Any, list[float]]:
    """Times of runs that alternate [us]."""
    times: dict[Any, list[float]] = {key: [] for key in runs}
    for _ in range(repeats):
        for key, run in runs.items():
            start = time.perf_counter()
            run()
            times[key].append(1e6 * (time.perf_counter() - start))
    return times


def _entry(
    solver: str,
    effort: int,
    problems: list[QuadraticProgram],
    x: np.ndarray,
    exact: np.ndarray,
    times: list[float],
) -> Entry:
    error, violation = float(np.abs(x - exact).max()), _violation(problems, x)
    quartiles = (float(np.percentile(times, share)) for share in (50, 25, 75))
    return Entry(solver, effort, error, violation, *quartiles)


def _violation(problems: list[QuadraticProgram], x: np.ndarray) -> float:
    return float(max((p.G @ v - p.h).max(initial=0.0) for p, v in zip(problems, x, strict=True)))
