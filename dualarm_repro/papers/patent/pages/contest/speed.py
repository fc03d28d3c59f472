"""The claims on speed: operations of each solver until it is equally near the minimiser."""

from __future__ import annotations

from functools import partial

import numpy as np
import pandas as pd

from .....control.contest import Entry, contest
from .....control.convergence import (
    first_within,
    network_errors,
    primal_dual_errors,
    steps_in_a_row,
)
from .....control.instrument import Cost
from .....control.neural.network_settings import NetworkSettings
from .....control.operations import exact_cost, network_cost, primal_dual_cost
from .....ledger import REGISTRY, Assumed, Bounded, Generally, Is, Result
from .....ledger.captions import captions
from .....ledger.witnesses import one_for_each_side
from .....tracking import memo
from .....view.control_figures import contest_figure, convergence_figure
from ...problems import busiest, recorded
from ...reading import PENALTY, network_settings

checks = partial(REGISTRY.checks, page="patent/contest")
caption = captions(__file__)
NEWTON_STEPS = (1, 2, 4, 8)
ITERATIONS = (1, 3, 10, 30, 100, 300)
#: Problems in a row on which the network starts from its state before.
IN_A_ROW = 60
_MOST_STEPS, _MOST_ITERATIONS = 60, 30_000
_NAMES = {"active_set": "exact active set", "network": "network",
          "primal_dual": "primal-dual network"}  # fmt: skip


@checks(
    "patent.claim_faster",
    samples=32,
    rules=[
        Generally(
            "sooner",
            "problems on which the network is near the minimiser with fewer operations",
            at_least="nearly_all",
            margin="margin",
        )
    ],
)
def faster_than_primal_dual(assumed: Assumed) -> Result:
    """Operations of both networks from a zero state until |x - x*| is below the threshold."""
    network, threshold = network_settings(assumed, *PENALTY), assumed["convergence_threshold"]
    cost, every = assumed["function_cost"], recorded(100)
    # At rest both are near from the start; what is left has something to do.
    busy = [k for k, errors in enumerate(_primal_dual_errors()) if errors[0] > threshold]
    problems = [every[k] for k in busy]
    steps = [first_within(network_errors(p, network, _MOST_STEPS), threshold) for p in problems]
    reached_at = [first_within(_primal_dual_errors()[k], threshold) for k in busy]
    others = [None if at is None else int(_counts()[at]) for at in reached_at]
    costs = [each.total(cost) for each in _network_costs(network.penalty)]
    own = [None if s is None else s * costs[k] for s, k in zip(steps, busy, strict=True)]
    rival = [
        None if count is None else count * _primal_dual_costs()[k]
        for count, k in zip(others, busy, strict=True)
    ]
    pairs = list(zip(own, rival, strict=True))
    sooner = [_sooner(*pair) for pair in pairs]
    arrived = [s for s in steps if s is not None]
    reached = [k for k in others if k is not None]
    hardest = busy[max(range(len(busy)), key=lambda k: others[k] or _MOST_ITERATIONS)]
    ratios = [b / a for a, b in pairs if a and b]
    return Result(
        obtained={
            "sooner": {"count": sum(sooner), "of": len(problems)},
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
        caption=caption("claim_faster", every=len(every), threshold=threshold, network=network),
        witnesses=one_for_each_side(
            (
                f"problem {k} of the task",
                sooner[k],
                {"network_operations": a, "primal_dual_operations": b},
            )
            for k, (a, b) in enumerate(pairs)
        ),
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
    network, threshold = network_settings(assumed, *PENALTY), assumed["convergence_threshold"]
    problems, cost = busiest(IN_A_ROW), assumed["function_cost"]
    steps, error = steps_in_a_row(problems, network, threshold, NEWTON_STEPS[-1])
    each = [one.total(cost) for one in _network_costs(network.penalty, in_a_row=True)]
    exact = [one.total(cost) for one in _exact_costs()]
    return Result(
        obtained={
            "arrives": error <= threshold,
            "saved": 1.0 - steps * sum(each) / sum(exact),
            "network_steps": steps,
            "network_operations": float(np.mean(each)),
            "exact_operations": float(np.mean(exact)),
        },
        measured={
            f"{e.solver}_{e.effort}_us": [e.microseconds, e.low, e.high] for e in _entries(network)
        },
        table=pd.DataFrame(_entries(network)),
        caption=caption(
            "claim_efficient", problems=IN_A_ROW, assumed=assumed, network=network, error=error
        ),
        alt="Largest error against time a problem: the exact method at the bottom left, both "
        "networks above and to the right.",
        figure=lambda: contest_figure(_series(_entries(network)), 1e-12),
    )


def _sooner(own: float | None, rival: float | None) -> bool:
    """Whether the network arrives, and with fewer operations where the other one does, too."""
    return own is not None and (rival is None or own < rival)


@memo()
def _counts() -> np.ndarray:
    """Numbers of iterations at which the primal-dual network is looked at."""
    return np.unique(np.concatenate([[0], np.geomspace(1, _MOST_ITERATIONS, 110).astype(int)]))


@memo()
def _primal_dual_errors() -> list[np.ndarray]:
    """Errors at those numbers of iterations, for every recorded problem."""
    return [primal_dual_errors(p, _counts()) for p in recorded(100)]


@memo(64)
def _network_costs(penalty: str, in_a_row: bool = False) -> list[Cost]:
    """A step of the network on each problem; it does not depend on p and sigma."""
    problems = busiest(IN_A_ROW) if in_a_row else recorded(100)
    return [network_cost(p, NetworkSettings(penalty=penalty)) for p in problems]


@memo()
def _primal_dual_costs() -> list[float]:
    return [primal_dual_cost(p).total() for p in recorded(100)]


@memo()
def _exact_costs() -> list[Cost]:
    return [exact_cost(p) for p in busiest(IN_A_ROW)]


@memo(8)
def _entries(network: NetworkSettings) -> list[Entry]:
    """The timed contest."""
    return contest(busiest(IN_A_ROW), network, NEWTON_STEPS, ITERATIONS)


def _curves(index: int, network: NetworkSettings) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    own = network_errors(recorded(100)[index], network, _MOST_STEPS)
    other = _primal_dual_errors()[index]
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
