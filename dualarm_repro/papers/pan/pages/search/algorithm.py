"""The loop of the genetic algorithm of `pan`: its chart, its ends, its way with the infeasible."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from .....ledger import REGISTRY, Assumed, Bounded, Is, NoOriginal, Result, Role
from .....ledger.captions import captions
from .....view.diagrams import loop_chart
from .....view.search_plots import history_figure
from .....welding import Trace, genetic
from .....welding.watched import first_stop
from ...reading import Genetic, Problem, traced
from ...studies.evolution import RUNS, VARIANTS, stored_runs

checks = partial(REGISTRY.checks, page="pan/search")
caption = captions(__file__)


def declared_trace(**changes: Any) -> Trace:
    """One run on the declared problem, some settings of the search changed, watched."""
    values = REGISTRY.nominal("pan")
    return traced(Problem.of(values), replace(Genetic.of(values), **changes))


@checks(
    "pan.fig11",
    rules=[
        Is("inputs", "inputs whose effect is seen in a run", to="inputs"),
        Is("steps", "steps seen in a run, in this order", to="steps"),
        Is("stops", "rules that can end a run", to="stops"),
        NoOriginal("chart", "the content of the chart"),
    ],
)
def chart(assumed: Assumed) -> Result:
    """A run is watched; the chart is drawn from the list of acts that it runs."""
    trace, shrinking = declared_trace(), declared_trace(ga_mutation="gaussian")
    return Result(
        obtained={
            "inputs": seen_inputs(trace),
            "steps": seen_steps(trace),
            "stops": seen_stops([trace, shrinking]),
            "acts": [act.__name__ for act in (genetic.initialise, *genetic.LOOP)],
        },
        caption=caption("fig11", trace=trace),
        alt="Flow chart: draw, evaluate, rank, decide, select, reproduce, and back to evaluate.",
        figure=lambda: loop_chart(genetic.initialise, genetic.LOOP, genetic.finished),
    )


def seen_inputs(trace: Trace) -> list[str]:
    """Printed inputs of the algorithm whose effect the states of a run show."""
    elite, crossed, mutants = trace.settings.counts
    seen = {
        "fitness function": trace.history[-1].best > trace.history[0].best,
        "constraints": trace.met < trace.tested and trace.infeasible_passed_on == 0,
        "number of best individuals kept": set(trace.passed_on) == {elite},
        "crossover probability": min(trace.crossed) == crossed,
        "mutation probability": max(trace.mutated) == mutants,
    }
    return [name for name, found in seen.items() if found]


def seen_steps(trace: Trace) -> list[str]:
    """Printed steps, in the order in which they first occur in a run."""
    steps = {
        "constraints": "constraints of every individual by its joint angles",
        "fitness": "fitness of those that meet them",
        "finished": "decision to end",
        "reproduce": "next generation",
    }
    whole = trace.tested == sum(trace.evaluated) and trace.rated == trace.met
    return [steps[name] for name in dict.fromkeys(trace.order) if name in steps] if whole else []


def seen_stops(traces: Sequence[Trace]) -> list[str]:
    """Printed stop rules that ended one of the runs, each where it first holds."""
    names = {
        "generations": "preset number of generations",
        "stall": "smallest change of the mean fitness",
    }
    ended = set()
    for trace in traces:
        watched = [getattr(g, trace.settings.stall_of) for g in trace.history]
        if first_stop(np.array(watched), trace.settings) == (len(watched) - 1, trace.reason):
            ended.add(trace.reason)
    return [name for reason, name in names.items() if reason in ended]


@checks(
    "pan.claim_ga_stop",
    rules=[
        Bounded(
            "other_ends",
            "runs that did not end where the printed rules, recomputed, first hold",
            high=0.0,
        ),
        Bounded("by_limit", "runs ended by the number of generations", low=1),
        Bounded("by_stall", "runs ended by the change of the mean fitness", low=1),
    ],
)
def two_stop_rules(assumed: Assumed) -> Result:
    """Where each stored run ended, and where the printed rules say it has to."""
    declared = Genetic.of(REGISTRY.nominal("pan")).settings()
    other, ends = 0, {}
    for variant, changes in VARIANTS.items():
        runs, settings = stored_runs(RUNS, variant), replace(declared, **changes)
        for values, end in zip(runs.histories[settings.stall_of], runs.ends, strict=True):
            other += first_stop(values, settings) != end
        ends[variant] = {
            why: [end[1] for end in runs.ends].count(why) for why in ("generations", "stall")
        }
    by_limit, by_stall = (
        sum(found[why] for found in ends.values()) for why in ("generations", "stall")
    )
    return Result(
        obtained={"other_ends": other, "by_limit": by_limit, "by_stall": by_stall, "ends": ends},
        caption=caption("claim_ga_stop", runs=RUNS),
    )


@checks(
    "pan.claim_discard",
    rules=[
        Bounded(
            "infeasible_passed_on",
            "infeasible individuals that pass on while feasible ones could",
            high=0.0,
            role=Role.ADOPTS,
        ),
        Bounded(
            "best_infeasible",
            "runs whose best individual is infeasible",
            high=0.0,
            role=Role.ADOPTS,
        ),
    ],
)
def discarded(assumed: Assumed) -> Result:
    """What becomes of infeasible individuals in a run that is watched."""
    trace = declared_trace()
    share = 1 - np.array([[g.feasible for g in trace.history]])
    return Result(
        obtained={
            "infeasible_passed_on": int(trace.infeasible_passed_on),
            "best_infeasible": int(trace.history[-1].best <= 0),
            "first": float(share[0, 0]),
            "last": float(share[0, -1]),
            "parents": float(np.mean(trace.infeasible_parents)),
        },
        caption=caption("claim_discard"),
        alt="Share of infeasible individuals against the generation, falling from nearly one.",
        figure=lambda: history_figure({"infeasible": share}, "share of the generation"),
    )
