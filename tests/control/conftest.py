"""Two seven-joint arms side by side, and random problems."""

import numpy as np
import pytest

from dualarm_repro import load_arm
from dualarm_repro.control.frozen import FrozenScenario, arm_pair
from dualarm_repro.control.problem import QuadraticProgram
from dualarm_repro.control.scenario import load_scenario
from dualarm_repro.datafiles import data_path


@pytest.fixture(scope="session")
def system():
    return arm_pair(load_arm("xarm7"), 0.6)


@pytest.fixture(scope="session")
def q(system):
    arrays = system.arrays
    return np.random.default_rng(5).uniform(0.4 * arrays.lower, 0.4 * arrays.upper)


@pytest.fixture(scope="session")
def crossing():
    """Two xArm 7 whose arms cross without avoidance."""
    file = load_scenario(data_path("scenes", "patent_crossing_xarm7.yaml"))
    return FrozenScenario.of(file, load_arm("xarm7"))


def random_problem(rng, equalities=6, rows=12, tight=0.5):
    """A feasible problem with 14 unknowns, some of its constraints tight at one point."""
    n = 14
    x = rng.normal(size=n)
    A, G = rng.normal(size=(equalities, n)), rng.normal(size=(rows, n))
    loose = rng.random(rows) * (rng.random(rows) > tight)
    lower, upper = (x + side * rng.random(n) * (rng.random(n) > 0.2) for side in (-1, 1))
    return QuadraticProgram(0.1 * rng.normal(size=n), A, A @ x, G, G @ x + loose, lower, upper)
