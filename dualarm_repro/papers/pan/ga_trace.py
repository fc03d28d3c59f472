"""A genetic run watched step by step, and what its states show of the printed steps."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ...tracking import memo
from ...welding import Jobs, Measures, Placement, genetic
from .optimum import Box
from .scenario import SEED, Genetic, Job, Measure

#: Averaging length of the second stop rule, which the text leaves open.
_WINDOW = genetic.GeneticSettings().stall_generations


@dataclass
class Trace:
    """What was seen of a run.

    Attributes
    ----------
    order
        Names of the acts in the order in which they ran, with ``constraints`` and ``fitness`` for
        the two parts of an evaluation.
    evaluated
        New individuals whose fitness was asked for, by generation.
    tested, met, rated
        Individuals whose constraints were tested, those that met them, those with a fitness.
    passed_on, crossed, mutated
        Individuals of each new generation that equal one before, that take every coordinate from
        one of two parents, and the others.
    infeasible_passed_on
        Infeasible ones that passed on although there were feasible ones enough to fill the elite.
    infeasible_parents
        Share of the parents that were infeasible, by generation.
    """

    settings: genetic.GeneticSettings
    order: list[str] = field(default_factory=list)
    evaluated: list[int] = field(default_factory=list)
    tested: int = 0
    met: int = 0
    rated: int = 0
    passed_on: list[int] = field(default_factory=list)
    crossed: list[int] = field(default_factory=list)
    mutated: list[int] = field(default_factory=list)
    infeasible_passed_on: int = 0
    infeasible_parents: list[float] = field(default_factory=list)
    history: list[genetic.Generation] = field(default_factory=list)
    reason: str = ""


@memo(8)
def traced(job: Job, measure: Measure, setting: Genetic, box: Box) -> Trace:
    """One run of the search, its state looked at before and after every act."""
    settings = setting.settings()
    trace, asked = Trace(settings), []
    placement = _watched(job.placement(measure.reading()), trace)

    def fitness(points: np.ndarray) -> np.ndarray:
        asked.append(len(points))
        return placement(points)

    low, high = np.array(box).T
    search = genetic.Search(fitness, low, high, settings, np.random.default_rng(SEED))
    genetic.initialise(search)
    trace.order.append(genetic.initialise.__name__)
    while search.reason is None:
        for act in genetic.LOOP:
            before = search.individuals.copy(), search.values.copy()
            asked.clear()
            ended = act(search)
            trace.order.append(act.__name__)
            if asked:
                trace.evaluated.append(sum(asked))
            if act is genetic.select:
                trace.infeasible_parents.append(_infeasible(search.parents, *before))
            if act is genetic.reproduce:
                _see_children(trace, search, *before)
            if ended:
                break
    trace.history, trace.reason = search.history, search.reason
    return trace


def first_stop(
    means: np.ndarray, generations: int, smallest: float, window: int = _WINDOW
) -> tuple[int, str]:
    """Generation at which a run has to end by the two printed rules, and by which.

    Generation limit reached, or a mean fitness whose change from one generation to the next is, on
    average over a window, at most the smallest relative change.

    Parameters
    ----------
    means : ndarray (G,)
        Mean fitness of each generation, the first one included.
    """
    for last in range(len(means)):
        if last >= generations:
            return last, "generations"
        recent = means[max(0, last - window) : last + 1]
        rests = np.abs(np.diff(recent)).sum() <= window * smallest * means[last]
        if last >= window and means[last] > 0 and rests:
            return last, "stall"
    return len(means), "none"


def _watched(placement: Placement, trace: Trace) -> Placement:
    """The placement, whose tests of constraints and whose measures are noted."""
    solve, measure = placement.jobs, placement.measures

    def jobs(centres: np.ndarray) -> Jobs:
        trace.order.append("constraints")
        found = solve(centres)
        trace.tested += len(found.status)
        trace.met += int(found.feasible.sum())
        return found

    def measures(found: Jobs) -> Measures:
        trace.order.append("fitness")
        trace.rated += len(found.status)
        return measure(found)

    placement.jobs, placement.measures = jobs, measures
    return placement


def _infeasible(parents: np.ndarray, individuals: np.ndarray, values: np.ndarray) -> float:
    """Share of the parents that are infeasible individuals."""
    bad = {row.tobytes() for row in individuals[values <= 0]}
    return float(np.mean([row.tobytes() in bad for row in parents]))


def _see_children(
    trace: Trace, search: genetic.Search, individuals: np.ndarray, values: np.ndarray
) -> None:
    known = {row.tobytes(): value for row, value in zip(individuals, values, strict=True)}
    elite = trace.settings.counts[0]
    passed = [row for row in search.individuals[:elite] if row.tobytes() in known]
    trace.passed_on.append(len(passed))
    if (values > 0).sum() >= elite:
        trace.infeasible_passed_on += sum(known[row.tobytes()] <= 0 for row in passed)
    columns = [set(column) for column in search.parents.T]
    inherits = [
        all(x in column for x, column in zip(row, columns, strict=True))
        for row in search.individuals[elite:]
    ]
    trace.crossed.append(sum(inherits))
    trace.mutated.append(len(inherits) - sum(inherits))
