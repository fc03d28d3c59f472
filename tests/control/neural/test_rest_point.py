"""Where the network rests: the optimality conditions of the exact problem, but for its softness."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualarm_repro.control.neural.network import network_rate
from dualarm_repro.control.neural.network_settings import NetworkSettings
from dualarm_repro.control.neural.penalised import penalties, rest_point
from dualarm_repro.control.neural.primal_dual import flow, iterate
from dualarm_repro.control.problem import Solution
from dualarm_repro.control.solvers import solve

from ..conftest import random_problem


def as_solution(p, network, y):
    """The state with P'(g) for multipliers of rows and bounds."""
    push = penalties(p, network, y[: p.size])[:, 1]
    k, n = len(p.h), p.size
    return Solution(p, y[:n], y[n:], push[:k], push[k : k + n] - push[k + n :])


@settings(max_examples=15)
@given(seed=st.integers(0, 10**6))
def test_at_rest_only_feasibility_and_complementarity_are_soft(seed):
    """Stationarity and signs are exact; what is violated falls with the factor of the penalty."""
    p = random_problem(np.random.default_rng(seed), 3, 5)
    off = []
    for factor in (1e3, 1e4):
        network = NetworkSettings(penalty="squared_softplus", factor=factor, sharpness=1e3)
        found = as_solution(p, network, rest_point(p, network))
        assert found.dual_residual < 1e-7
        np.testing.assert_allclose(p.A @ found.x, p.b, atol=1e-9)
        assert (found.z >= 0.0).all()
        off.append(found.primal_residual)
    pressing = np.concatenate([solve(p).z, np.abs(solve(p).w)]).max(initial=0.0)
    if pressing > 0.1:  # else nothing is violated to speak of
        assert off[1] < 0.3 * off[0]
    # To first order a constraint gives way by its multiplier over the factor.
    assert off[1] <= 2e-4 * (1.0 + pressing) + 1e-3


@pytest.mark.parametrize("penalty", ["quadratic", "squared_softplus"])
def test_a_network_at_rest_stays_there_whatever_its_gain(penalty):
    p = random_problem(np.random.default_rng(3), 3, 5)
    network = NetworkSettings(penalty=penalty, factor=1e3, sharpness=1e3)
    y = rest_point(p, network)
    rate = np.empty(len(y))
    for gain in (1.0, 1e3):
        network_rate(network.numbers(), gain, np.zeros(len(y)), p.parts, y, rate)
        assert np.abs(rate).max() < 1e-6 * gain


@settings(max_examples=15)
@given(seed=st.integers(0, 10**6))
def test_the_primal_dual_network_rests_at_the_exact_solution_and_nowhere_beside_it(seed):
    p = random_problem(np.random.default_rng(seed), 3, 5)
    exact = solve(p)
    u = np.concatenate([exact.x, -exact.y, exact.z])
    still = u.copy()
    flow(p.parts, still, 0.02, 50)
    np.testing.assert_allclose(still, u, atol=1e-8)
    moved = u + 1e-2 * np.random.default_rng(seed).normal(size=len(u))
    before = np.linalg.norm(moved - u)
    assert iterate(p.parts, moved, 50, 0.0) == 50
    assert np.linalg.norm(moved - u) < before
