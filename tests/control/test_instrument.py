"""Instrumented twins do what the compiled functions do, and count it."""

import numpy as np
import pytest

from dualarm_repro.control.least_distance import least_distance
from dualarm_repro.control.neural.network import network_rate
from dualarm_repro.control.neural.network_settings import NetworkSettings
from dualarm_repro.control.neural.primal_dual import iterate
from dualarm_repro.control.neural.saddle import factorise, forward
from dualarm_repro.instrument import Instrument

from .conftest import random_problem


def test_cholesky_counts_its_operations():
    n = 5
    instrument = Instrument()
    instrument.twin(factorise)(np.eye(n) * 4.0)
    assert instrument.functions == n
    # Entry (i, j) takes j products, j subtractions and, off the diagonal, a division.
    assert instrument.operations == sum(2 * j + (i != j) for i in range(n) for j in range(i + 1))


def test_a_triangular_solve_takes_n_squared_operations():
    assert Instrument().cost(forward, np.eye(6), np.ones(6)) == (36, 0)


def test_functions_count_as_declared():
    cost = Instrument().cost(factorise, np.eye(3))
    counted = [cost.total(c) for c in (0.0, 1.0, 10.0)]
    assert counted[1] - counted[0] == 3
    assert counted[2] - counted[0] == 30


def test_the_twin_of_the_exact_method_gives_its_minimiser():
    p = random_problem(np.random.default_rng(0))
    np.testing.assert_array_equal(
        Instrument().twin(least_distance)(p.parts)[1], least_distance(p.parts)[1]
    )


@pytest.mark.parametrize("penalty", ["quadratic", "softplus", "squared_softplus"])
def test_the_twin_of_the_network_gives_its_rate(penalty):
    p, numbers = (
        random_problem(np.random.default_rng(0)),
        NetworkSettings(penalty=penalty).numbers(),
    )
    size = p.size + len(p.b)
    found, expected = np.empty(size), np.empty(size)
    arguments = (numbers, 1.0, np.zeros(size), p.parts, np.zeros(size))
    Instrument().twin(network_rate)(*arguments, found)
    network_rate(*arguments, expected)
    np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-15)


def test_what_is_changed_in_place_stays_in_place():
    p = random_problem(np.random.default_rng(0))
    states = np.zeros((2, p.size + len(p.b) + len(p.h)))
    Instrument().twin(iterate)(p.parts, states[0], 3, 0.0)
    iterate(p.parts, states[1], 3, 0.0)
    assert np.abs(states[0]).max() > 0
    np.testing.assert_allclose(states[0], states[1], rtol=1e-12, atol=1e-15)
