"""The claims on speed: operations of each solver until it is equally near the minimiser."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from ...control.contest import Entry, contest, newton_all
from ...control.neural.network import network_rate
from ...control.neural.network_settings import NetworkSettings
from ...control.neural.primal_dual import iterate
from ...control.problem import QuadraticProgram
from ...control.recorded import stacked
from ...control.solvers import solve
from ...ledger import REGISTRY, Assumed, Bounded, Generally, Is, Result
from ...tracking import memo
from ...view.control_figures import contest_figure, convergence_figure
from .costs import (
    busiest,
    exact_operations,
    network_operations,
    primal_dual_operations,
    pseudo_inverse_operations,
    recorded,
)
from .scenario import network_of

checks = partial(REGISTRY.checks, page="patent/contest")
_PENALTY = ("penalty_form", "penalty_factor", "penalty_sharpness")
NEWTON_STEPS = (1, 2, 4, 8)
ITERATIONS = (1, 3, 10, 30, 100, 300)
#: Problems in a row on which the network starts from its state before.
IN_A_ROW = 60
_MOST_STEPS, _MOST_ITERATIONS = 60, 30_000


@checks(
    "patent.claim_faster",
    samples=32,
    rules=[
        Generally(
            "sooner",
            "problems on which the network is near the minimiser with fewer operations",
            at_least="nearly_all",
            margin="margin",
        ),
    ],
)
def faster_than_primal_dual(assumed: Assumed) -> Result:
    """Operations of both networks from a zero state until |x - x*| is below the threshold."""
    network, threshold = network_of(assumed, *_PENALTY), assumed["convergence_threshold"]
    cost, every = assumed["function_cost"], recorded(100)
    # At rest both are near from the start; what is left has something to do.
    busy = [k for k, errors in enumerate(_primal_dual_errors()) if errors[0] > threshold]
    problems = [every[k] for k in busy]
    steps = [_first(_network_errors(p, network), threshold) for p in problems]
    reached_at = [_first(_primal_dual_errors()[k], threshold) for k in busy]
    others = [None if at is None else int(_counts()[at]) for at in reached_at]
    costs = _network_costs(network.penalty, cost)
    own = [None if s is None else s * costs[k] for s, k in zip(steps, busy, strict=True)]
    rival = [
        None if count is None else count * _primal_dual_costs()[k]
        for count, k in zip(others, busy, strict=True)
    ]
    sooner = sum(a is not None and (b is None or a < b) for a, b in zip(own, rival, strict=True))
    arrived = [s for s in steps if s is not None]
    reached = [k for k in others if k is not None]
    hardest = busy[max(range(len(busy)), key=lambda k: others[k] or _MOST_ITERATIONS)]
    ratios = [b / a for a, b in zip(own, rival, strict=True) if a and b]
    return Result(
        obtained={
            "sooner": {"count": sooner, "of": len(problems)},
            "arrived": len(arrived),
            "network_steps": float(np.median(arrived)) if arrived else None,
            "primal_dual_arrived": len(reached),
            "primal_dual_iterations": float(np.median(reached)) if reached else None,
            "operations_ratio": float(np.median(ratios)) if ratios else None,
        },
        table=pd.DataFrame(
            {
                "network steps": steps,
                "primal-dual iterations": others,
                "network operations": own,
                "primal-dual operations": rival,
            }
        ),
        caption=(
            f"From a zero state both networks run on the {len(problems)} of {len(every)} recorded "
            "problems of the frozen task that are not solved by standing still, "
            f"until they are within {threshold:g} rad/s of the exact minimiser, the same measure "
            f"for both. The network ({network.penalty}, p = {network.factor:g}), discretised with "
            f"unit gain, gets there on {len(arrived)} of them"
            + (f", in {np.median(arrived):.0f} steps in the median" if arrived else "")
            + "; what stops it on the others is the bias of its penalty. The primal-dual network "
            f"gets there on {len(reached)}"
            + (f", in {np.median(reached):.0f} iterations" if reached else "")
            + f". Counted in operations, the network is sooner on {sooner} of {len(problems)}"
            + (f"; where both arrive, by a factor of {np.median(ratios):.1f}" if ratios else "")
            + ". Its step is one of Newton's method, the other's of first order."
        ),
        witnesses=_witnesses(own, rival),
        alt="Distance from the minimiser over the number of steps: the network falls within a "
        "few steps to the bias of its penalty, the other in hundreds without an end.",
        figure=lambda: convergence_figure(_curves(hardest, network), threshold),
    )


@checks(
    "patent.claim_efficient",
    samples=32,
    rules=[
        Is("arrives", "the network comes within the threshold of x*", value=True),
        Bounded("saved", "share of the operations of the exact method it saves", low=0.0),
    ],
)
def faster_than_numerical(assumed: Assumed) -> Result:
    """Operations on recorded problems in a row: exact active-set method against the network."""
    network, threshold = network_of(assumed, *_PENALTY), assumed["convergence_threshold"]
    problems = busiest(IN_A_ROW)
    steps, error = _steps_in_a_row(network, threshold)
    cost = assumed["function_cost"]
    each = _network_costs(network.penalty, cost, in_a_row=True)
    exact = _exact_costs(cost)
    arrives = error <= threshold
    saved = 1.0 - steps * sum(each) / sum(exact)
    return Result(
        obtained={
            "arrives": arrives,
            "saved": saved,
            "network_steps": steps,
            "network_operations": float(np.mean(each)),
            "exact_operations": float(np.mean(exact)),
        },
        measured=_measured(network),
        table=pd.DataFrame(_entries(network)),
        caption=(
            f"{len(problems)} problems in a row where avoidance presses most. The exact active-set "
            f"method takes {np.mean(exact):.0f} operations a problem, from nothing to rounding "
            f"accuracy; one network step takes {np.mean(each):.0f}, since it is a linear "
            f"solve (a root or elementary function counts as {cost:g}). "
            f"Started from the problem before, {steps} steps a problem bring the network "
            f"({network.penalty}, p = {network.factor:g}) to {error:.1e} rad/s, "
            + (
                f"within the {threshold:g} asked for: "
                + (f"it saves {saved:.0%}." if saved >= 0 else f"it costs {-saved:.0%} more.")
                if arrives
                else f"and no number tried to the {threshold:g} asked for: the bias of its penalty "
                "remains."
            )
            + " Times on this machine stand in the table; they decide nothing."
        ),
        alt="Largest error against time a problem: the exact method at the bottom left, both "
        "networks above and to the right.",
        figure=lambda: contest_figure(_series(_entries(network)), 1e-12),
    )


@REGISTRY.checks(
    "patent.claim_pinv_slow",
    page="patent/avoidance",
    rules=[
        Generally(
            "slower",
            "problems on which the pseudo-inverse takes more operations than either solver",
            at_least="nearly_all",
            margin="margin",
        ),
    ],
)
def slow_pseudo_inverse(assumed: Assumed) -> Result:
    """Operations of the pseudo-inverse against the cheaper of the exact QP and a network step."""
    problems, network = recorded(100), NetworkSettings(penalty="quadratic")
    own = [pseudo_inverse_operations(p) for p in problems]
    steps = [network_operations(p, network) for p in problems]
    exact = [exact_operations(p) for p in problems]
    slower = sum(a > min(b, c) for a, b, c in zip(own, steps, exact, strict=True))
    return Result(
        obtained={
            "slower": {"count": slower, "of": len(problems)},
            "pseudo_inverse": float(np.median(own)),
            "network_step": float(np.median(steps)),
            "exact": float(np.median(exact)),
        },
        caption=(
            f"For the same {len(problems)} problems the pseudo-inverse takes {np.median(own):.0f} "
            f"operations in the median, a step of the network {np.median(steps):.0f} and the exact "
            f"QP {np.median(exact):.0f}: it is slower than the cheaper of the two on {slower} of "
            "them. What it lacks is constraints, not speed."
        ),
    )


def _witnesses(own: list[float | None], rival: list[float | None]) -> list[dict[str, Any]]:
    """A problem on which the network is sooner and one on which it is not, where there are such."""
    found: dict[str, dict[str, Any]] = {}
    for k, (a, b) in enumerate(zip(own, rival, strict=True)):
        verdict = "holds" if a is not None and (b is None or a < b) else "fails"
        values = {"network_operations": a, "primal_dual_operations": b}
        found.setdefault(
            verdict, {"choice": f"problem {k} of the task", "verdict": verdict, "values": values}
        )
    return list(found.values())


def _first(errors: np.ndarray, threshold: float) -> int | None:
    """Index of the first error within the threshold."""
    below = np.flatnonzero(errors <= threshold)
    return int(below[0]) if len(below) else None


def _network_errors(p: QuadraticProgram, network: NetworkSettings) -> np.ndarray:
    """|x - x*|_inf before each step of unit gain, from zero."""
    size, exact = p.size + len(p.b), solve(p).x
    y, rate, still, errors = np.zeros(size), np.empty(size), np.zeros(size), []
    for _ in range(_MOST_STEPS):
        errors.append(float(np.abs(y[: p.size] - exact).max()))
        network_rate(network.numbers(), 1.0, still, p.parts, y, rate)
        y += rate
    return np.array(errors)


@memo()
def _counts() -> np.ndarray:
    """Numbers of iterations at which the primal-dual network is looked at."""
    return np.unique(np.concatenate([[0], np.geomspace(1, _MOST_ITERATIONS, 110).astype(int)]))


@memo()
def _primal_dual_errors() -> list[np.ndarray]:
    """|x - x*|_inf at those numbers of iterations from zero, for every recorded problem."""
    found = []
    for p in recorded(100):
        exact, u, done, errors = solve(p).x, np.zeros(p.size + len(p.b) + len(p.h)), 0, []
        for count in _counts():
            iterate(p.parts, u, int(count) - done, 0.0)
            done = int(count)
            errors.append(float(np.abs(u[: p.size] - exact).max()))
        found.append(np.array(errors))
    return found


@memo(64)
def _network_costs(penalty: str, function_cost: float, in_a_row: bool = False) -> list[float]:
    """A step of the network on each problem; it does not depend on p and sigma."""
    network = NetworkSettings(penalty=penalty)
    counted = _counted_steps(network, in_a_row)
    return [operations + function_cost * functions for operations, functions in counted]


@memo(16)
def _counted_steps(network: NetworkSettings, in_a_row: bool) -> list[tuple[float, float]]:
    """Operations and functions of a step on each problem."""
    problems = busiest(IN_A_ROW) if in_a_row else recorded(100)
    alone = [network_operations(p, network, 0.0) for p in problems]
    return [
        (rest, network_operations(p, network) - rest)
        for rest, p in zip(alone, problems, strict=True)
    ]


@memo()
def _primal_dual_costs() -> list[float]:
    return [primal_dual_operations(p) for p in recorded(100)]


def _exact_costs(function_cost: float) -> list[float]:
    return [operations + function_cost * functions for operations, functions in _counted_exact()]


@memo()
def _counted_exact() -> list[tuple[float, float]]:
    alone = [exact_operations(p, 0.0) for p in busiest(IN_A_ROW)]
    return [
        (rest, exact_operations(p) - rest) for rest, p in zip(alone, busiest(IN_A_ROW), strict=True)
    ]


def _steps_in_a_row(network: NetworkSettings, threshold: float) -> tuple[int, float]:
    """Least steps a problem that reach the threshold, or those that come nearest, and the error."""
    problems = busiest(IN_A_ROW)
    exact, x = np.array([solve(p).x for p in problems]), np.empty((IN_A_ROW, problems[0].size))
    data, tried = stacked(problems), []
    for steps in range(1, NEWTON_STEPS[-1] + 1):
        newton_all(data, network.numbers(), steps, x)
        tried.append((steps, float(np.nan_to_num(np.abs(x - exact), nan=np.inf).max())))
        if tried[-1][1] <= threshold:
            return tried[-1]
    return min(tried, key=lambda pair: pair[1])


@memo(8)
def _entries(network: NetworkSettings) -> list[Entry]:
    """The timed contest."""
    return contest(busiest(IN_A_ROW), network, NEWTON_STEPS, ITERATIONS)


def _measured(network: NetworkSettings) -> dict[str, list[float]]:
    """Median and quartiles of the time a problem, by solver and effort [us]."""
    return {f"{e.solver}_{e.effort}_us": [e.microseconds, e.low, e.high] for e in _entries(network)}


def _curves(index: int, network: NetworkSettings) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    own = _network_errors(recorded(100)[index], network)
    return {
        "network": (np.arange(1, len(own)), own[1:]),
        "primal-dual network": (_counts()[1:], _primal_dual_errors()[index][1:]),
    }


def _series(entries: list[Entry]) -> dict[str, tuple[np.ndarray, np.ndarray, np.ndarray]]:
    names = {
        "active_set": "exact active set",
        "network": "network",
        "primal_dual": "primal-dual network",
    }
    series = {}
    for key, name in names.items():
        rows = [e for e in entries if e.solver == key]
        quartiles = np.array([[e.low for e in rows], [e.high for e in rows]])
        series[name] = (
            np.array([e.microseconds for e in rows]),
            quartiles,
            np.array([e.error for e in rows]),
        )
    return series
