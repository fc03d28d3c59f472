"""A genetic algorithm for a box of real variables, as a list of steps that is run and can be drawn.

Defaults are those of a common toolbox: rank scaling, stochastic uniform selection, elitism,
scattered crossover, Gaussian mutation that shrinks over the generations.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from math import ceil, isfinite
from numbers import Integral
from typing import Annotated, NamedTuple

import numpy as np

from ..annotation import real_array
from ..arguments import LATER, checked
from ..errors import DualArmError, InputError, UnknownNameError
from .generation import next_generation, pointed_at, ranked

Fitness = Callable[[np.ndarray], np.ndarray]
MUTATIONS = ("gaussian", "adaptive_feasible")
INFEASIBLE = ("zero", "redraw")
STALLS = ("mean", "best")
_REDRAWS = 10
_SMALLEST_STEP = 1e-6


@checked
@dataclass(frozen=True)
class GeneticSettings:
    """Settings of a run.

    Attributes
    ----------
    population : int
        Individuals per generation, at least 4.
    generations : int
        Largest number of generations after the first.
    crossover : float
        Share of the children, elite apart, that come from crossover; the rest are mutants.
    elite : float
        Share of the best individuals that pass on unchanged, rounded up.
    mutation : str
        ``gaussian``: noise whose deviation falls linearly from the size of the box to 0;
        ``adaptive_feasible``: one step in a random direction, kept inside the box, four times
        longer after a success and four times shorter after a failure.
    stall : float
        The run ends when the fitness changed by less than this share per generation ...
    stall_generations : int
        ... on average over as many generations.
    stall_of : str
        Of which fitness: the ``mean`` of the generation or its ``best``.
    infeasible : str
        ``zero``: fitness 0; ``redraw``: drawn anew from the box, at most ten times.
    """

    population: int = 50
    generations: int = 100
    crossover: float = 0.8
    elite: float = 0.05
    mutation: str = "gaussian"
    stall: float = 1e-6
    stall_generations: int = 10
    stall_of: str = "mean"
    infeasible: str = "zero"

    def __post_init__(self) -> None:
        for name, least in (("population", 4), ("generations", 1), ("stall_generations", 1)):
            value = getattr(self, name)
            if not isinstance(value, Integral) or value < least:
                raise InputError(
                    "genetic algorithm", name, value, f"an integer of at least {least}"
                )
        for name in ("crossover", "elite"):
            if not 0.0 <= getattr(self, name) < 1.0:
                raise InputError(
                    "genetic algorithm", name, getattr(self, name), "a share in [0, 1)"
                )
        named = {"mutation": MUTATIONS, "infeasible": INFEASIBLE, "stall_of": STALLS}
        for name, choices in named.items():
            if getattr(self, name) not in choices:
                expected = f"one of {', '.join(choices)}"
                raise UnknownNameError("genetic algorithm", name, getattr(self, name), expected)

    @cached_property
    def wheel(self) -> np.ndarray:
        """Shares of the ranks, 1/sqrt(rank), summed up from the first to the last (P,)."""
        share = 1.0 / np.sqrt(np.arange(1, self.population + 1))
        return np.cumsum(share / share.sum())

    @cached_property
    def counts(self) -> tuple[int, int, int]:
        """Numbers of elite, crossover children and mutants in a generation."""
        elite = ceil(self.elite * self.population)
        crossed = round(self.crossover * (self.population - elite))
        return elite, crossed, self.population - elite - crossed


class Generation(NamedTuple):
    """What is recorded of a generation; fitness of the infeasible counts as 0 in the mean."""

    best: float
    mean: float
    distance: float
    feasible: float


@dataclass
class Search:
    """State of a run."""

    fitness: Fitness
    low: np.ndarray
    high: np.ndarray
    settings: GeneticSettings
    rng: np.random.Generator
    individuals: np.ndarray = field(init=False)
    values: np.ndarray = field(init=False)
    before: np.ndarray = field(init=False)
    pointer: float = field(init=False)
    order: np.ndarray = field(init=False)
    history: list[Generation] = field(init=False, default_factory=list)
    evaluations: int = field(init=False, default=0)
    known: int = field(init=False, default=0)
    step: float = field(init=False, default=1.0)
    reason: str | None = field(init=False, default=None)

    @property
    def parents(self) -> np.ndarray:
        """Of the generation to come, or of the one that was bred last (K, n)."""
        chosen = pointed_at(self.settings.wheel, self.pointer, len(self.order))
        return self.before[chosen[self.order]]


@dataclass(frozen=True, eq=False)
class Evolution:
    """Outcome of a run: best individual and its fitness, history, evaluations, why it ended."""

    best: np.ndarray
    fitness: float
    history: tuple[Generation, ...]
    evaluations: int
    reason: str

    @property
    def found(self) -> bool:
        """Whether any feasible individual was met."""
        return self.fitness > 0


def initialise(search: Search) -> None:
    """Draw the first generation uniformly from the box"""
    shape = (search.settings.population, len(search.low))
    search.individuals = search.rng.uniform(search.low, search.high, shape)
    search.values = np.zeros(search.settings.population)


def evaluate(search: Search) -> None:
    """Solve the job of every new individual; a violated constraint gives fitness 0"""
    known, population = search.known, search.settings.population
    search.values[known:] = rated(search.fitness, search.individuals[known:])
    search.evaluations += population - known
    if search.settings.infeasible == "redraw":
        new = np.arange(population) >= known
        for _ in range(_REDRAWS):
            bad = new & (search.values <= 0)
            if not bad.any():
                break
            search.individuals[bad] = search.rng.uniform(
                search.low, search.high, (int(bad.sum()), len(search.low))
            )
            search.values[bad] = rated(search.fitness, search.individuals[bad])
            search.evaluations += int(bad.sum())


def rank(search: Search) -> None:
    """Sort by fitness and record best, mean and mean distance"""
    found = ranked(search.individuals, search.values)
    search.individuals, search.values, feasible, distance = found
    count = len(search.values)
    record = Generation(
        best=float(search.values[0]),
        mean=float(np.add.reduce(search.values) / count),
        distance=distance,
        feasible=feasible / count,
    )
    if search.history:
        grown = record.best > search.history[-1].best
        search.step = min(1.0, 4 * search.step) if grown else max(_SMALLEST_STEP, search.step / 4)
    search.history.append(record)


def finished(search: Search) -> bool:
    """Generation limit reached, or fitness stalled?"""
    settings, history = search.settings, search.history
    if len(history) > settings.generations:
        search.reason = "generations"
    elif rests(history, settings):
        search.reason = "stall"
    return search.reason is not None


def rests(history: list[Generation], settings: GeneticSettings) -> bool:
    """Whether the fitness that decides has changed too little over the last generations."""
    window, column = settings.stall_generations, Generation._fields.index(settings.stall_of)
    if len(history) <= window or history[-1][column] <= 0.0:
        return False
    enough, changed = settings.stall * history[-1][column], 0.0
    for k in range(-window, 0):
        changed += abs(history[k][column] - history[k - 1][column])
        if changed / window > enough:  # and it only grows
            return False
    return True


def select(search: Search) -> None:
    """Draw parents in proportion to 1/sqrt(rank) with equally spaced pointers"""
    _, pairs, mutants = search.settings.counts
    search.before, search.pointer = search.individuals, search.rng.random()
    search.order = np.arange(2 * pairs + mutants)
    search.rng.shuffle(search.order)


def reproduce(search: Search) -> None:
    """Keep the elite, cross pairs of parents coordinate by coordinate, mutate the rest"""
    settings, size = search.settings, len(search.low)
    elite, pairs, mutants = settings.counts
    draws = search.rng.random((pairs, size))
    noise = search.rng.standard_normal((mutants, size))
    gaussian = settings.mutation == "gaussian"
    left = 1.0 - len(search.history) / (settings.generations + 1) if gaussian else search.step
    search.individuals = next_generation(
        *(search.before, settings.wheel, search.pointer, search.order, draws, noise),
        *(left, search.low, search.high, gaussian),
    )
    search.values[elite:] = 0.0
    search.known = elite


#: The loop after the first generation; the decision ends it.
LOOP: tuple[Callable[[Search], bool | None], ...] = (evaluate, rank, finished, select, reproduce)


@checked
def evolve(
    fitness: Fitness,
    box: Annotated[np.ndarray, LATER],
    settings: GeneticSettings,
    rng: np.random.Generator,
    *,
    must_find: bool = True,
) -> Evolution:
    """Maximise a fitness over a box.

    Parameters
    ----------
    fitness : callable
        (P, n) -> (P,), positive where feasible, 0 elsewhere.
    box : ndarray (n, 2)
        Lower and upper bounds.
    must_find : bool
        Raise if no individual was feasible; without, ``found`` of the outcome tells.

    Raises
    ------
    InputError
        A bound that is not finite, lower bounds not below upper ones, or nothing feasible.
    """
    low, high = np.ascontiguousarray(checked_box(box).T)
    search = Search(fitness, low, high, settings, rng)
    initialise(search)
    while search.reason is None:
        for act in LOOP:
            if act(search):
                break
    if must_find and search.values[0] <= 0:
        expected = (
            f"a box with a feasible position: none of the {search.evaluations} evaluated ones is"
        )
        raise InputError("search", "box", np.asarray(box).tolist(), expected)
    return Evolution(
        search.individuals[0].copy(),
        float(search.values[0]),
        tuple(search.history),
        search.evaluations,
        search.reason,
    )


def rated(fitness: Fitness, individuals: np.ndarray) -> np.ndarray:
    """Fitness (P,) of individuals (P, n).

    Raises
    ------
    InputError
        What the fitness gives is no finite number each, which would rank as anything; or it cannot
        be computed, for one because the box has another number of rows than it has variables.
    """
    expected = f"{len(individuals)} finite numbers"
    try:
        values = fitness(individuals)
    except DualArmError:
        raise
    except Exception as error:
        field, kind = f"fitness of {individuals.shape}", type(error).__name__
        raise InputError("search", field, f"{kind}: {error}", expected) from error
    array = np.asarray(values)
    if array.shape != (len(individuals),) or array.dtype.kind not in "fiu":
        raise InputError("search", "fitness", values, expected)
    if not (isfinite(np.add.reduce(array)) or np.isfinite(array).all()):
        raise InputError("search", "fitness", float(array[~np.isfinite(array)][0]), expected)
    return array


def checked_box(box: np.ndarray) -> np.ndarray:
    """The box (n, 2) as floats.

    Raises
    ------
    InputError
        See :func:`evolve`.
    """
    expected = "at least one finite row [lower, upper], lower < upper"
    try:
        array = real_array(box)
    except (TypeError, ValueError):
        raise InputError("search", "box", box, expected) from None
    good = array.ndim == 2 and array.shape[1:] == (2,) and np.isfinite(array).all()
    if not good or not len(array) or (array[:, 0] >= array[:, 1]).any():
        raise InputError("search", "box", array.tolist(), expected)
    return array
