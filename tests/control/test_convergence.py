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
from dualarm_repro.control.recorded import stacked
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


def in_a_row(p, count, network, threshold, most):
    exact = np.array([solve(p).x] * count)
    return steps_in_a_row(stacked([p] * count), exact, network, threshold, most)


def test_in_a_row_each_problem_takes_the_steps_it_needs(p):
    # From zero the first takes as many as alone; the others start from its state.
    errors = network_errors(p, NETWORK, 40)
    threshold = 2.0 * errors[-1]
    needed = first_within(errors, threshold)
    assert needed > 1
    steps = in_a_row(p, 6, NETWORK, threshold, 40)
    assert steps[0] == needed
    assert (steps[1:] < needed).all()
    assert steps[-1] == 1
    few = in_a_row(p, 6, NETWORK, threshold, needed - 1)
    assert few[0] == -1
    assert 0 < few[1] < needed  # what the first did is not lost


def test_a_network_that_is_lost_starts_anew(p):
    soft = NETWORK.changed(factor=10.0)
    assert (in_a_row(p, 2, soft, 1e-9, 5) == -1).all()


def test_in_continuous_time_the_network_decays_with_one_rate_and_both_arrive(p):
    errors, exact = network_flow(p, NETWORK, np.array([0.0, 1.0, 30.0])), solve(p).x
    bias = np.abs(rest_point(p, NETWORK)[: p.size] - exact).max()
    assert errors[0] == np.abs(exact).max()
    assert errors[2] == pytest.approx(bias, rel=1e-3)
    slow = primal_dual_flow(p, np.array([0.0, 1.0, 2000.0]))
    assert slow[0] == errors[0]
    assert slow[2] < 1e-3 < slow[1]
