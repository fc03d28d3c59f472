"""Operations of a step, against counts by hand and against each other."""

import numpy as np
import pytest

from dualarm_repro.control.neural.network_settings import NetworkSettings
from dualarm_repro.control.operations import (
    control_operations,
    exact_operations,
    network_control_operations,
    network_operations,
    primal_dual_operations,
    pseudo_inverse_operations,
)
from dualarm_repro.control.settings import Settings

from .conftest import random_problem


@pytest.fixture(scope="module")
def p():
    return random_problem(np.random.default_rng(2))


def test_functions_cost_what_they_are_said_to(p):
    network = NetworkSettings()
    for count in (exact_operations, lambda p, cost=1.0: network_operations(p, network, cost)):
        free, one, ten = (count(p, cost) for cost in (0.0, 1.0, 10.0))
        assert free < one
        assert ten - free == pytest.approx(10 * (one - free))


def test_the_pseudo_inverse_is_the_cheapest(p):
    n, m = p.size, len(p.b)
    found = pseudo_inverse_operations(p)
    # At least the products of J J^T, half of them by symmetry.
    assert found > n * m * (m + 1) / 2
    assert found < min(network_operations(p, NetworkSettings()), exact_operations(p))


def test_an_iteration_is_cheaper_than_a_step_of_the_network(p):
    found = primal_dual_operations(p)
    # Every matrix is multiplied twice, by a vector each time.
    assert found > 4 * (p.A.size + p.G.size)
    assert found < network_operations(p, NetworkSettings(), 0.0)


def test_a_whole_step_holds_more_than_its_solver(crossing):
    y = np.zeros(crossing.system.nq + 6)
    exact = control_operations(*crossing.parts, Settings(), crossing.q0, 1.0)
    blind = control_operations(*crossing.parts, Settings(avoid=False), crossing.q0, 1.0)
    network = network_control_operations(
        *crossing.parts, Settings(), NetworkSettings(), 1e-3, crossing.q0, 1.0, y
    )
    assert exact >= blind > 1000
    assert network > 1000
