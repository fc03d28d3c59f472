"""What a generation of a genetic algorithm costs beside its fitness, by several libraries.

The fitness is a sum of three squares, so that nearly all of the time is the algorithm's own.
Population, elite, generations and kinds of operators are the same: uniform crossover of four
fifths of the children, Gaussian mutation of the others.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from importlib.util import find_spec
from itertools import count
from typing import NamedTuple

import numpy as np
from equal_work import DifferentWork
from timing import OURS, Row, timed

from dualarm_repro.welding import GeneticSettings, evolve

TASK = "generation of a genetic algorithm, 50 individuals"
SIZE, HALF = 3, 0.5  # coordinates, each within +- HALF
SETTINGS = GeneticSettings(population=50, generations=100, stall=0.0)
_ELITE, _CROSSED, _MUTANTS = SETTINGS.counts
CHILDREN = _CROSSED + _MUTANTS
_NEAR = 0.05  # of the optimum, in which every run must end
_SIGMA = 0.1  # of the mutation, as a share of the box, where it does not shrink


class Run(NamedTuple):
    """Best point (3,) of a run, and how many individuals were rated."""

    best: np.ndarray
    evaluations: int


def measure() -> Iterator[Row]:
    """Time per generation; peers that are not installed are left out."""
    peers = {"pymoo": _pymoo, "deap": _deap, "cma": _cma}
    names = {"pymoo": "pymoo", "deap": "DEAP", "cma": "cma, no genetic algorithm"}
    runs = {OURS: _ours} | {names[m]: run for m, run in peers.items() if find_spec(m)}
    for name, run in runs.items():
        seeds = count(1)
        call = lambda run=run, seeds=seeds: run(next(seeds))  # noqa: E731
        yield timed(TASK, name, call, SETTINGS.generations, check=as_much(run))


def as_much(run: Callable[[int], Run]) -> Callable[[], str]:
    """As many individuals, and a run that works."""

    def check() -> str:
        found = run(0)
        if (away := float(np.abs(found.best).max())) > _NEAR:
            raise DifferentWork(f"ends {away:.2g} from the optimum")
        most = SETTINGS.population + SETTINGS.generations * CHILDREN
        if not 0.7 * most <= found.evaluations <= most:
            raise DifferentWork(f"{found.evaluations} individuals are rated instead of {most}")
        return f"{found.evaluations} individuals, optimum to {away:.0e}"

    return check


def _ours(seed: int) -> Run:
    def fitness(x: np.ndarray) -> np.ndarray:
        return 1.0 - (x * x).sum(axis=1)

    box = np.tile([-HALF, HALF], (SIZE, 1))
    found = evolve(fitness, box, SETTINGS, np.random.default_rng(seed))
    return Run(found.best, found.evaluations)


def _pymoo(seed: int) -> Run:
    from pymoo.algorithms.soo.nonconvex.ga import GA
    from pymoo.core.problem import Problem
    from pymoo.operators.crossover.ux import UniformCrossover
    from pymoo.operators.mutation.gauss import GaussianMutation
    from pymoo.operators.sampling.rnd import FloatRandomSampling
    from pymoo.optimize import minimize

    class Squares(Problem):
        def __init__(self) -> None:
            super().__init__(n_var=SIZE, n_obj=1, xl=-HALF, xu=HALF)

        def _evaluate(self, x: np.ndarray, out: dict, *_: object, **__: object) -> None:
            out["F"] = (x * x).sum(axis=1)

    algorithm = GA(
        pop_size=SETTINGS.population,
        n_offsprings=CHILDREN,
        sampling=FloatRandomSampling(),
        crossover=UniformCrossover(prob=SETTINGS.crossover),
        mutation=GaussianMutation(sigma=_SIGMA, prob=1.0 - SETTINGS.crossover),
        eliminate_duplicates=False,
    )
    found = minimize(Squares(), algorithm, ("n_gen", SETTINGS.generations + 1), seed=seed)
    return Run(np.asarray(found.X), found.algorithm.evaluator.n_eval)


def _deap(seed: int) -> Run:
    from deap import algorithms, base, tools

    class Smallest(base.Fitness):
        weights = (-1.0,)

    class Individual(list):
        def __init__(self, values: list[float]) -> None:
            super().__init__(values)
            self.fitness = Smallest()

    random.seed(seed)
    box = base.Toolbox()
    box.register("mate", tools.cxUniform, indpb=0.5)
    box.register("mutate", tools.mutGaussian, mu=0.0, sigma=2 * HALF * _SIGMA, indpb=1.0)
    rated = 0

    def rate(individuals: list[Individual]) -> list[Individual]:
        nonlocal rated
        for one in individuals:
            if not one.fitness.valid:
                one.fitness.values = (sum(x * x for x in one),)
                rated += 1
        return individuals

    population = rate(
        [
            Individual([random.uniform(-HALF, HALF) for _ in range(SIZE)])
            for _ in range(SETTINGS.population)
        ]
    )
    for _ in range(SETTINGS.generations):
        elite = tools.selBest(population, _ELITE)
        parents = tools.selTournament(population, CHILDREN, tournsize=2)
        children = algorithms.varAnd(parents, box, SETTINGS.crossover, 1.0 - SETTINGS.crossover)
        population = elite + rate(children)
    return Run(np.array(tools.selBest(population, 1)[0]), rated)


def _cma(seed: int) -> Run:
    import cma

    options = {"popsize": CHILDREN, "bounds": [-HALF, HALF], "seed": seed + 1, "verbose": -9}
    search = cma.CMAEvolutionStrategy(np.full(SIZE, 0.5 * HALF), 0.2, options)
    for _ in range(SETTINGS.generations):
        points = search.ask()
        search.tell(points, [float(x @ x) for x in points])
    return Run(np.asarray(search.result.xbest), int(search.result.evaluations))
