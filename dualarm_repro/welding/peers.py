"""Other optimisers on the same fitness and budget, to judge the genetic algorithm by."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.optimize import differential_evolution

from .genetic import Fitness, GeneticSettings, checked_box, evolve
from .grid_search import Optimum, pattern_search

Optimiser = Callable[[Fitness, np.ndarray, int, int], Optimum]
_POPULATION = 50


class _Budget:
    """Counts evaluations and keeps the best; what exceeds the budget counts as infeasible."""

    def __init__(self, fitness: Fitness, budget: int, dimension: int) -> None:
        self._fitness, self._budget = fitness, budget
        self.best = Optimum(np.full(dimension, np.nan), 0.0, 0)

    @property
    def left(self) -> int:
        return self._budget - self.best.evaluations

    def __call__(self, points: np.ndarray) -> np.ndarray:
        points = np.asarray(points, dtype=float)
        asked = points[: self.left]
        values = np.zeros(len(points))
        if len(asked):
            values[: len(asked)] = self._fitness(asked)
        best, count = int(values.argmax()), self.best.evaluations + len(asked)
        if values[best] > self.best.fitness:
            self.best = Optimum(points[best].copy(), float(values[best]), count)
        self.best = self.best._replace(evaluations=count)
        return values


def random_search(fitness: Fitness, box: np.ndarray, budget: int, seed: int) -> Optimum:
    """Uniform points."""
    box, counted = checked_box(box), _Budget(fitness, budget, len(box))
    low, high = box.T
    counted(np.random.default_rng(seed).uniform(low, high, (budget, len(box))))
    return counted.best


def multistart_pattern_search(fitness: Fitness, box: np.ndarray, budget: int, seed: int) -> Optimum:
    """A third of the budget on uniform points, then pattern searches from the best of them."""
    box, counted = checked_box(box), _Budget(fitness, budget, len(box))
    low, high = box.T
    points = np.random.default_rng(seed).uniform(low, high, (budget // 3, len(box)))
    values = counted(points)
    for k in np.argsort(-values, kind="stable"):
        if values[k] <= 0 or counted.left <= 0:
            break
        pattern_search(counted, points[k], box, 0.1, 1e-4)
    return counted.best


def genetic(
    fitness: Fitness, box: np.ndarray, budget: int, seed: int, mutation: str = "gaussian"
) -> Optimum:
    """The algorithm of this package with its defaults; the budget sets the generations."""
    elite, *_ = GeneticSettings().counts
    generations = max(1, (budget - _POPULATION) // (_POPULATION - elite))
    settings = GeneticSettings(population=_POPULATION, generations=generations, mutation=mutation)
    found = evolve(fitness, box, settings, np.random.default_rng(seed), must_find=False)
    return Optimum(found.best, found.fitness, found.evaluations)


def genetic_adaptive(fitness: Fitness, box: np.ndarray, budget: int, seed: int) -> Optimum:
    """The same with mutation that adapts its step."""
    return genetic(fitness, box, budget, seed, "adaptive_feasible")


def pymoo_genetic(fitness: Fitness, box: np.ndarray, budget: int, seed: int) -> Optimum:
    """GA of pymoo: tournament, simulated binary crossover, polynomial mutation."""
    from pymoo.algorithms.soo.nonconvex.ga import GA
    from pymoo.core.problem import Problem
    from pymoo.optimize import minimize

    box, counted = checked_box(box), _Budget(fitness, budget, len(box))

    class Maximised(Problem):
        def _evaluate(self, x: np.ndarray, out: dict, *args: object, **kwargs: object) -> None:
            out["F"] = -counted(x)

    problem = Maximised(n_var=len(box), n_obj=1, xl=box[:, 0], xu=box[:, 1])
    minimize(problem, GA(pop_size=_POPULATION), ("n_eval", budget), seed=seed, verbose=False)
    return counted.best


def scipy_differential_evolution(
    fitness: Fitness, box: np.ndarray, budget: int, seed: int
) -> Optimum:
    """Differential evolution of scipy, without its final gradient step."""
    box, counted = checked_box(box), _Budget(fitness, budget, len(box))
    size = -(-_POPULATION // len(box))
    differential_evolution(
        lambda x: -counted(x.T),
        box,
        popsize=size,
        maxiter=budget // (size * len(box)) - 1,
        tol=0.0,
        polish=False,
        updating="deferred",
        vectorized=True,
        rng=np.random.default_rng(seed),
    )
    return counted.best


def covariance_matrix_adaptation(
    fitness: Fitness, box: np.ndarray, budget: int, seed: int
) -> Optimum:
    """CMA-ES of pycma, restarted from the best of fifty uniform points until the budget is used."""
    from cma import CMAEvolutionStrategy

    box, counted = checked_box(box), _Budget(fitness, budget, len(box))
    rng, (low, high) = np.random.default_rng(seed), box.T
    while counted.left > _POPULATION:
        points = rng.uniform(low, high, (_POPULATION, len(box)))
        start = points[counted(points).argmax()]
        options = {
            "bounds": [low, high],
            "CMA_stds": high - low,
            "popsize": 16,
            "seed": int(rng.integers(1, 2**31)),
            "verbose": -9,
            "tolfun": 1e-7,
            "tolflatfitness": 10,
        }
        strategy = CMAEvolutionStrategy(start, 0.1, options)
        while not strategy.stop() and counted.left > 0:
            asked = strategy.ask()
            strategy.tell(asked, list(-counted(np.array(asked))))
    return counted.best


#: Name to optimiser (fitness, box, budget, seed) -> Optimum.
OPTIMISERS: dict[str, Optimiser] = {
    "genetic algorithm": genetic,
    "genetic algorithm, adaptive mutation": genetic_adaptive,
    "pymoo GA": pymoo_genetic,
    "differential evolution": scipy_differential_evolution,
    "CMA-ES": covariance_matrix_adaptation,
    "pattern search": multistart_pattern_search,
    "random search": random_search,
}
