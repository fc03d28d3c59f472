"""How near the networks come, step by step."""

import numpy as np
import pytest

from dualarm_repro.control.convergence import (
    first_within,
    network_errors,
    network_flow,
    primal_dual_errors,
    primal_dual_flow,
    steps_in_a_row,
)
from dualarm_repro.control.neural.network_settings import NetworkSettings
from dualarm_repro.control.neural.penalised import rest_point
from dualarm_repro.control.solvers import solve

from .conftest import random_problem

NETWORK = NetworkSettings(penalty="quadratic", factor=1e4)


@pytest.fixture(scope="module")
def p():
    return random_problem(np.random.default_rng(8))


def test_first_within():
    errors = np.array([3.0, 2.0, 1.0, 2.0, 0.5])
    assert first_within(errors, 1.0) == 2
    assert first_within(errors, 0.4) is None


def test_the_network_goes_from_zero_to_the_bias_of_its_penalty(p):
    errors, exact = network_errors(p, NETWORK, 40), solve(p).x
    bias = np.abs(rest_point(p, NETWORK)[: p.size] - exact).max()
    assert errors[0] == np.abs(exact).max()
    assert errors[-1] == pytest.approx(bias, rel=1e-6)
    assert len(errors) == 40


def test_the_primal_dual_network_goes_on_where_it_stopped(p):
    together, alone = primal_dual_errors(p, [0, 10, 1000]), primal_dual_errors(p, [1000])
    assert together[0] == np.abs(solve(p).x).max()
    assert together[2] == alone[0] < together[1] < together[0]


def test_in_a_row_the_least_number_of_steps_is_found(p):
    problems = [p] * 4
    # Solved once, the problem stays solved; a single problem takes as many steps as from zero.
    errors = network_errors(p, NETWORK, 40)
    threshold = 2.0 * errors[-1]
    steps, error = steps_in_a_row(problems, NETWORK, threshold, 40)
    assert steps == first_within(errors, threshold)
    assert error == pytest.approx(errors[steps])
    few, error = steps_in_a_row(problems, NETWORK, threshold, steps - 1)
    assert few < steps
    assert error > threshold


def test_in_continuous_time_the_network_decays_with_one_rate_and_both_arrive(p):
    errors, exact = network_flow(p, NETWORK, np.array([0.0, 1.0, 30.0])), solve(p).x
    bias = np.abs(rest_point(p, NETWORK)[: p.size] - exact).max()
    assert errors[0] == np.abs(exact).max()
    assert errors[2] == pytest.approx(bias, rel=1e-3)
    slow = primal_dual_flow(p, np.array([0.0, 1.0, 2000.0]))
    assert slow[0] == errors[0]
    assert slow[2] < 1e-3 < slow[1]
