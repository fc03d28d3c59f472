"""The claims on speed: operations of each solver until it is equally near the minimiser."""

from __future__ import annotations

from functools import partial

import numpy as np
import pandas as pd

from .....control.contest import Entry, contest
from .....control.convergence import (
    first_within,
    network_errors,
    network_flow,
    primal_dual_errors,
    primal_dual_flow,
    steps_in_a_row,
)
from .....control.neural.network_settings import NetworkSettings
from .....control.operations import (
    exact_cost,
    exact_cost_after,
    network_cost,
    primal_dual_cost,
)
from .....control.parts import ProgramStack
from .....control.recorded import stacked
from .....control.solvers import solve
from .....instrument import Cost
from .....ledger import REGISTRY, Assumed, Bounded, Generally, Result
from .....ledger.assumptions import alternatives
from .....ledger.captions import captions
from .....ledger.witnesses import is_open, one_for_each_side
from .....tracking import memo
from .....view.control_figures import contest_figure, convergence_figure
from ...problems import busiest, recorded

checks = partial(REGISTRY.checks, page="patent/contest")
caption = captions(__file__)
NEWTON_STEPS = (1, 2, 4, 8)
ITERATIONS = (1, 3, 10, 30, 100, 300)
#: Steps between the problems of the task that the network is run through; each hundredth counts.
EVERY = 5
#: Problems in a row that are timed.
IN_A_ROW = 60
_MOST_STEPS, _MOST_ITERATIONS = 30, 30_000
#: Integrals of the gain at which the networks are looked at in continuous time.
_FLOW = np.linspace(0.0, 25.0, 251)
_LONG_FLOW = np.concatenate([[0.0], np.geomspace(0.1, 1500.0, 110)])
_NAMES = {"active_set": "exact, from nothing", "active_set_warm": "exact, from the set before",
          "network": "network", "primal_dual": "primal-dual network",
          "pseudo_inverse": "pseudo-inverse"}  # fmt: skip


@checks(
    "patent.claim_faster",
    samples=32,
    rules=[
        Generally(
            "sooner",
            "problems on which the network is near the minimiser with fewer operations, or earlier",
            at_least="nearly_all",
            margin="margin",
        )
    ],
)
def faster_than_primal_dual(assumed: Assumed) -> Result:
    """Operations, or time, of both networks from a zero state until |x - x*| is small."""
    threshold, every = assumed["convergence_threshold"], recorded(100)
    cost, gamma = assumed["function_cost"], assumed["gain"]
    # At rest both are near from the start; what is left has something to do.
    busy = [k for k, errors in enumerate(primal_dual_curves()) if errors[0] > threshold]
    chosen = _cheapest(busy, threshold, cost)
    steps = [first_within(network_curves(chosen)[k], threshold) for k in busy]
    reached_at = [first_within(primal_dual_curves()[k], threshold) for k in busy]
    others = [None if at is None else int(_counts()[at]) for at in reached_at]
    costs = [each.total(cost) for each in _network_costs(chosen.penalty)]
    rivals = [
        None if n is None else n * _primal_dual_costs()[k].total(cost)
        for n, k in zip(others, busy, strict=True)
    ]
    own = [None if s is None else s * costs[k] for s, k in zip(steps, busy, strict=True)]
    flows = [_flow_times(k, threshold, gamma) for k in busy]
    pairs = list(zip(own, rivals, strict=True))
    judged = pairs if assumed["speed_measure"] == "operations" else flows
    sooner = [_sooner(*pair) for pair in judged]
    arrived = [s for s in steps if s is not None]
    reached = [k for k in others if k is not None]
    hardest = busy[max(range(len(busy)), key=lambda k: others[k] or _MOST_ITERATIONS)]
    ratios = [b / a for a, b in pairs if a and b]
    times = [b / a for a, b in flows if a and b]
    found = {
        "sooner": {"count": sum(sooner), "of": len(busy)},
        "penalty": chosen.penalty,
        "factor": chosen.factor,
        "arrived": len(arrived),
        "network_steps": float(np.median(arrived)) if arrived else None,
        "primal_dual_arrived": len(reached),
        "primal_dual_iterations": float(np.median(reached)) if reached else None,
        "operations_ratio": float(np.median(ratios)) if ratios else None,
        "earlier": sum(_sooner(*pair) for pair in flows),
        "time_ratio": float(np.median(times)) if times else None,
    }
    cases = (
        (f"problem {k} of the task", sooner[k], {"network": a, "primal_dual": b})
        for k, (a, b) in enumerate(judged)
    )
    return Result(
        obtained=found,
        table=pd.DataFrame(
            {
                "network steps": steps,
                "primal-dual iterations": others,
                "network operations": own,
                "primal-dual operations": rivals,
                "network time [s]": [a for a, _ in flows],
                "primal-dual time [s]": [b for _, b in flows],
            }
        ),
        caption=caption(
            "claim_faster", every=len(every), threshold=threshold, network=chosen, gamma=gamma
        ),
        witnesses=one_for_each_side(cases) if is_open("patent.claim_faster", found) else [],
        alt="Distance from the minimiser over the number of steps: the network falls within a "
        "few steps to the bias of its penalty, the other in hundreds without an end.",
        figure=lambda: convergence_figure(_curves(hardest, chosen), threshold),
    )


@checks(
    "patent.claim_efficient",
    samples=16,
    rules=[
        Generally(
            "arrived",
            "problems on which a network comes within the threshold of x*",
            at_least="nearly_all",
            margin="margin",
        ),
        Bounded("saved", "share of all operations of the exact method it saves", low="noticeable"),
    ],
)
def faster_than_numerical(assumed: Assumed) -> Result:
    """Operations on problems in a row: exact active-set method against the best network."""
    threshold, cost = assumed["convergence_threshold"], assumed["function_cost"]
    exact = np.array([one.total(cost) for one in _exact_costs(assumed["exact_start"])])
    rows = []
    for network in declared_networks():
        steps = steps_taken(network, threshold)
        step = np.array([one.total(cost) for one in _network_costs(network.penalty)])
        arrived = steps > 0
        # Where it does not arrive it has spent all the steps it was given.
        own = np.where(arrived, steps, NEWTON_STEPS[-1]) * step
        fewer = arrived & (own < exact)
        rows.append(
            (
                *(network.penalty, network.factor, int(arrived.sum())),
                float(np.median(steps[arrived])) if arrived.any() else np.nan,
                int(fewer.sum()),
                float(1.0 - own.sum() / exact.sum()),
            )
        )
    table = pd.DataFrame(rows, columns=["penalty", "p", "arrived", "steps", "fewer", "saved"])
    # Of those that arrive on the most problems the one that saves most.
    best = max(range(len(table)), key=lambda k: (rows[k][2], rows[k][5]))
    network, found = declared_networks()[best], table.loc[best]
    obtained = {
        "arrived": {"count": int(found["arrived"]), "of": len(exact)},
        "saved": float(found["saved"]),
        "fewer": int(found["fewer"]),
        "penalty": network.penalty,
        "factor": network.factor,
        "network_steps": float(found["steps"]) if found["arrived"] else None,
        "exact_operations": float(exact.mean()),
        "everywhere": int((table["arrived"] == len(exact)).sum()),
        "tried": len(table),
    }
    return Result(
        obtained=obtained,
        measured={
            f"{e.solver}_{e.effort}_us": [e.microseconds, e.low, e.high] for e in _entries(network)
        },
        table=table,
        caption=caption("claim_efficient", problems=len(recorded(EVERY)), assumed=assumed),
        alt="Largest error against time a problem: the exact method at the bottom left, from the "
        "set before further left, both networks above, the pseudo-inverse at the top left.",
        figure=lambda: contest_figure(_series(_entries(network)), 1e-12),
    )


@memo()
def declared_networks() -> list[NetworkSettings]:
    """Every declared form of the penalty with factors over their range, at full sharpness."""
    forms = alternatives("patent.penalty_form", 0)
    sharpness = alternatives("patent.penalty_sharpness", 2)[1]
    low, high = (np.log10(end) for end in alternatives("patent.penalty_factor", 2))
    return [
        NetworkSettings(penalty=form, factor=float(factor), sharpness=sharpness)
        for form in forms
        for factor in np.logspace(low, high, round(high - low) + 1)
    ]


def _cheapest(busy: list[int], threshold: float, cost: float) -> NetworkSettings:
    """The network that is near on most of the problems, and among those the cheapest."""

    def rank(network: NetworkSettings) -> tuple[int, float]:
        curves, costs = network_curves(network), _network_costs(network.penalty)
        steps = {k: first_within(curves[k], threshold) for k in busy}
        spent = sum(n * costs[k].total(cost) for k, n in steps.items() if n is not None)
        return sum(n is None for n in steps.values()), spent

    return min(declared_networks(), key=rank)


@memo(64)
def network_curves(network: NetworkSettings) -> list[np.ndarray]:
    """Errors before each step of unit gain, for every recorded problem."""
    return [network_errors(p, network, _MOST_STEPS) for p in recorded(100)]


@memo(64)
def steps_taken(network: NetworkSettings, threshold: float) -> np.ndarray:
    """Steps on every problem that is counted, the network run through all between them as well."""
    steps = steps_in_a_row(*in_a_row(), network, threshold, NEWTON_STEPS[-1])
    return steps[:: 100 // EVERY]


@memo()
def in_a_row() -> tuple[ProgramStack, np.ndarray]:
    """The problems that the network is run through, and their minimisers."""
    problems = recorded(EVERY)
    return stacked(problems), np.array([solve(p).x for p in problems])


def _flow_times(k: int, threshold: float, gamma: float) -> tuple[float | None, float | None]:
    """Times of the network with growing gain and of the other with a constant one, equal gamma."""
    own, other = (first_within(curves[k], threshold) for curves in _flows())
    return (
        None if own is None else float(np.log1p(_FLOW[own] / gamma)),
        None if other is None else float(_LONG_FLOW[other] / gamma),
    )


@memo()
def _flows() -> tuple[list[np.ndarray], list[np.ndarray]]:
    """Errors of both networks in continuous time; the network has the stiffest declared penalty."""
    stiff = NetworkSettings(penalty="quadratic", factor=alternatives("patent.penalty_factor", 2)[1])
    return (
        [network_flow(p, stiff, _FLOW) for p in recorded(100)],
        [primal_dual_flow(p, _LONG_FLOW) for p in recorded(100)],
    )


def _sooner(own: float | None, rival: float | None) -> bool:
    """Whether the network arrives, and with fewer operations where the other one does, too."""
    return own is not None and (rival is None or own < rival)


@memo()
def _counts() -> np.ndarray:
    """Numbers of iterations at which the primal-dual network is looked at."""
    return np.unique(np.concatenate([[0], np.geomspace(1, _MOST_ITERATIONS, 110).astype(int)]))


@memo()
def primal_dual_curves() -> list[np.ndarray]:
    """Errors at those numbers of iterations, for every recorded problem."""
    return [primal_dual_errors(p, _counts()) for p in recorded(100)]


@memo(64)
def _network_costs(penalty: str) -> list[Cost]:
    """A step of the network on each problem; it does not depend on p and sigma."""
    return [network_cost(p, NetworkSettings(penalty=penalty)) for p in recorded(100)]


@memo()
def _primal_dual_costs() -> list[Cost]:
    return [primal_dual_cost(p) for p in recorded(100)]


@memo()
def _exact_costs(start: str) -> list[Cost]:
    """The exact method on each problem, from nothing or from what pressed in the one before."""
    if start == "nothing":
        return [exact_cost(p) for p in recorded(100)]
    every, apart = recorded(EVERY), 100 // EVERY
    before = [every[max(k - 1, 0)] for k in range(0, len(every), apart)]
    return [exact_cost_after(*pair) for pair in zip(recorded(100), before, strict=True)]


@memo(8)
def _entries(network: NetworkSettings) -> list[Entry]:
    """The timed contest."""
    return contest(busiest(IN_A_ROW), network, NEWTON_STEPS, ITERATIONS)


def _curves(index: int, network: NetworkSettings) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    own = network_curves(network)[index]
    other = primal_dual_curves()[index]
    return {
        "network": (np.arange(1, len(own)), own[1:]),
        "primal-dual network": (_counts()[1:], other[1:]),
    }


def _series(entries: list[Entry]) -> dict[str, tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """Times a problem, their quartiles and the errors, by the names of the figure."""
    series = {}
    for key, name in _NAMES.items():
        rows = [(e.microseconds, e.low, e.high, e.error) for e in entries if e.solver == key]
        times, low, high, errors = np.array(rows).T
        series[name] = times, np.array([low, high]), errors
    return series
