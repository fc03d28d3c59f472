"""The penalised problem from its parts, against the compiled code and against the exact problem."""

import numpy as np
import pytest

from dualarm_repro.control.neural.network_settings import NetworkSettings
from dualarm_repro.control.neural.penalised import (
    blocks,
    code_error,
    inequalities,
    lagrangian_gradient,
    minimiser,
    objective,
    penalties,
    rest_point,
    state_matrix,
    state_with_error,
)
from dualarm_repro.control.solvers import solve
from dualarm_repro.differences import central_differences

from ..conftest import random_problem

FORMS = [
    NetworkSettings(penalty="squared_softplus", factor=10.0, sharpness=20.0),
    NetworkSettings(penalty="softplus", factor=10.0, sharpness=20.0),
]


@pytest.fixture(scope="module")
def p():
    return random_problem(np.random.default_rng(4))


@pytest.mark.parametrize("network", FORMS, ids=lambda n: n.penalty)
def test_code_and_parts_agree(p, network):
    y = np.random.default_rng(0).normal(size=p.size + len(p.b))
    E, _, e = blocks(p, network, y)
    np.testing.assert_allclose(code_error(p, network, y), E @ y - e, atol=1e-9)
    np.testing.assert_allclose(
        lagrangian_gradient(p, network, y), code_error(p, network, y), rtol=1e-6, atol=1e-6
    )
    slopes = central_differences(lambda at: code_error(p, network, at), y).T
    np.testing.assert_allclose(state_matrix(p, network, y), slopes, rtol=1e-5, atol=1e-5)


@pytest.mark.parametrize("network", FORMS, ids=lambda n: n.penalty)
def test_the_network_rests_at_the_minimiser(p, network):
    y, x = rest_point(p, network), minimiser(p, network)
    np.testing.assert_allclose(y[: p.size], x, atol=1e-6)
    np.testing.assert_allclose(p.A @ x, p.b, atol=1e-9)
    free = np.linalg.svd(p.A)[2][len(p.b)]
    assert objective(p, network, x) < min(
        objective(p, network, x + side * free) for side in (0.01, -0.01)
    )


def test_a_state_has_the_error_asked_for(p):
    xi = 0.1 * np.random.default_rng(1).normal(size=p.size + len(p.b))
    np.testing.assert_allclose(code_error(p, FORMS[0], state_with_error(p, FORMS[0], xi)), xi)


def test_stacked_inequalities_hold_where_the_exact_minimiser_is(p):
    C, d = inequalities(p)
    assert C.shape == (len(p.h) + 2 * p.size, p.size)
    x = solve(p).x
    assert (C @ x <= d + 1e-8).all()
    assert penalties(p, FORMS[0], x).shape == (len(d), 3)
    stiff = NetworkSettings(penalty="squared_softplus", factor=1e5, sharpness=1e4)
    # a stiff penalty is not an infinite one
    np.testing.assert_allclose(rest_point(p, stiff)[: p.size], x, atol=1e-2)
