"""Two seven-joint arms side by side, and random problems."""

import numpy as np
import pytest

from dualarm_repro.control.problem import QuadraticProgram
from dualarm_repro.papers.patent.tasks import arm_pair


@pytest.fixture(scope="session")
def system():
    return arm_pair("xarm7", 0.6)


@pytest.fixture(scope="session")
def q(system):
    arrays = system.arrays
    return np.random.default_rng(5).uniform(0.4 * arrays.lower, 0.4 * arrays.upper)


def random_problem(rng, equalities=6, rows=12, tight=0.5):
    """A feasible problem with 14 unknowns, some of its constraints tight at one point."""
    n = 14
    x = rng.normal(size=n)
    A, G = rng.normal(size=(equalities, n)), rng.normal(size=(rows, n))
    loose = rng.random(rows) * (rng.random(rows) > tight)
    lower, upper = (x + side * rng.random(n) * (rng.random(n) > 0.2) for side in (-1, 1))
    return QuadraticProgram(0.1 * rng.normal(size=n), A, A @ x, G, G @ x + loose, lower, upper)
