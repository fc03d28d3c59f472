"""Operations of a step, against counts by hand and against each other."""

import numpy as np
import pytest

from dualarm_repro.control.neural.network_settings import NetworkSettings
from dualarm_repro.control.operations import (
    control_cost,
    exact_cost,
    network_control_cost,
    network_cost,
    primal_dual_cost,
    pseudo_inverse_cost,
)
from dualarm_repro.control.settings import ControllerSettings

from .conftest import random_problem


@pytest.fixture(scope="module")
def p():
    return random_problem(np.random.default_rng(2))


def test_roots_are_functions_and_the_quadratic_penalty_has_no_others(p):
    m = len(p.b)
    assert pseudo_inverse_cost(p).functions == m
    assert network_cost(p, NetworkSettings(penalty="quadratic")).functions == p.size + m
    assert network_cost(p, NetworkSettings()).functions > p.size + m
    assert exact_cost(p).functions > 0


def test_singular_values_cost_several_times_the_cholesky_factor(p):
    assert pseudo_inverse_cost(p, singular_values=True).total() > 4 * pseudo_inverse_cost(p).total()


def test_the_pseudo_inverse_is_the_cheapest(p):
    n, m = p.size, len(p.b)
    found = pseudo_inverse_cost(p).total()
    # At least the products of J J^T, half of them by symmetry.
    assert found > n * m * (m + 1) / 2
    assert found < min(network_cost(p, NetworkSettings()).total(), exact_cost(p).total())


def test_an_iteration_is_cheaper_than_a_step_of_the_network(p):
    found = primal_dual_cost(p).total()
    # Every matrix is multiplied twice, by a vector each time.
    assert found > 4 * (p.A.size + p.G.size)
    assert found < network_cost(p, NetworkSettings()).operations


def test_a_whole_step_holds_more_than_its_solver(crossing):
    y = np.zeros(crossing.system.nq + 6)
    exact = control_cost(*crossing.parts, ControllerSettings(), crossing.q0, 1.0).total()
    blind = control_cost(*crossing.parts, ControllerSettings(avoid=False), crossing.q0, 1.0).total()
    network = network_control_cost(
        *crossing.parts, ControllerSettings(), NetworkSettings(), 1e-3, crossing.q0, 1.0, y
    ).total()
    assert exact >= blind > 1000
    assert network > 1000
