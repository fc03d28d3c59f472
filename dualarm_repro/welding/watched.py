"""A genetic run watched act by act: what its states show, and where stop rules first hold."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from ..arguments import checked
from . import genetic
from .genetic import Generation, GeneticSettings, Search
from .objective import Measures
from .placement import Jobs, Placement, Region


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

    settings: GeneticSettings
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
    history: list[Generation] = field(default_factory=list)
    reason: str = ""


@checked
def watch(
    placement: Placement, box: Region, settings: GeneticSettings, rng: np.random.Generator
) -> Trace:
    """One run of the search, the state looked at before and after every act.

    Arguments as in :func:`.genetic.evolve`, which gives the same run.
    """
    trace, asked = Trace(settings), []
    watched = _Watched(placement.cell, placement.objective)
    watched.trace = trace

    def fitness(points: np.ndarray) -> np.ndarray:
        asked.append(len(points))
        return watched(points)

    low, high = np.ascontiguousarray(genetic.checked_box(box).T)
    search = Search(fitness, low, high, settings, rng)
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


def first_stop(values: np.ndarray, settings: GeneticSettings) -> tuple[int, str]:
    """Generation at which a run has to end, and by which rule (``none``: by neither).

    Generation limit reached, or a fitness whose change from one generation to the next is, on
    average over the window of the settings, at most the smallest relative change.

    Parameters
    ----------
    values : ndarray (G,)
        The fitness that the settings watch, of each generation, the first one included.
    """
    window = settings.stall_generations
    for last in range(len(values)):
        if last >= settings.generations:
            return last, "generations"
        recent = values[max(0, last - window) : last + 1]
        least = window * settings.stall * values[last]
        if last >= window and values[last] > 0 and np.abs(np.diff(recent)).sum() <= least:
            return last, "stall"
    return len(values), "none"


@dataclass(eq=False)
class _Watched(Placement):
    """A placement whose tests of constraints and whose measures are noted."""

    trace: Trace = field(init=False)

    def jobs(self, centres: ArrayLike) -> Jobs:
        self.trace.order.append("constraints")
        found = super().jobs(centres)
        self.trace.tested += len(found.status)
        self.trace.met += int(found.feasible.sum())
        return found

    def measures(self, jobs: Jobs) -> Measures:
        self.trace.order.append("fitness")
        self.trace.rated += len(jobs.status)
        return super().measures(jobs)


def _infeasible(parents: np.ndarray, individuals: np.ndarray, values: np.ndarray) -> float:
    """Share of the parents that are infeasible individuals."""
    bad = {row.tobytes() for row in individuals[values <= 0]}
    return float(np.mean([row.tobytes() in bad for row in parents]))


def _see_children(
    trace: Trace, search: Search, individuals: np.ndarray, values: np.ndarray
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
