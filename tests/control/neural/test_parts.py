"""Penalties, activations, matrices of the network and the primal-dual network, part by part."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dualarm_repro.control.neural.activation import SLOPE_AT_ZERO, Activation, activation
from dualarm_repro.control.neural.network_settings import NetworkSettings
from dualarm_repro.control.neural.optimality import optimality, penalised_hessian
from dualarm_repro.control.neural.penalty import Penalty, penalty
from dualarm_repro.control.neural.primal_dual import direction, iterate, projection_error
from dualarm_repro.control.neural.saddle import solve_saddle
from dualarm_repro.control.solvers import solve
from dualarm_repro.errors import InputError, UnknownNameError
from dualarm_repro.settings import code

from ..conftest import random_problem

KINDS = range(len(Penalty))


@pytest.mark.parametrize("kind", KINDS)
@given(g=st.floats(-0.3, 0.3), s=st.sampled_from([1.0, 10.0, 100.0]))
def test_penalty_derivatives_pass_finite_differences(kind, g, s):
    step = 1e-5 / s
    if list(Penalty)[kind] is Penalty.QUADRATIC and abs(g) < step:
        g = 2 * step
    value, first, second = penalty(kind, 3.0, s, g)
    after, before = (penalty(kind, 3.0, s, g + side * step) for side in (1, -1))
    assert (after[0] - before[0]) / (2 * step) == pytest.approx(first, rel=1e-6, abs=1e-6)
    assert (after[1] - before[1]) / (2 * step) == pytest.approx(second, rel=1e-6, abs=1e-6 * s)
    assert value >= 0
    assert first >= 0
    assert second >= 0


@pytest.mark.parametrize("kind", KINDS)
def test_penalties_stay_finite_far_out(kind):
    for g in (-1e6, 1e6):
        assert np.isfinite(penalty(kind, 1e4, 1e3, g)).all()


def test_softplus_forms_tend_to_the_sharp_ones():
    g = np.linspace(-0.1, 0.1, 11)
    soft = np.array([penalty(1, 2.0, 1e5, v)[1] for v in g if v])
    np.testing.assert_allclose(soft, [2.0 * (v > 0) for v in g if v], atol=1e-12)
    squared = np.array([penalty(2, 2.0, 1e5, v)[1] for v in g])
    np.testing.assert_allclose(squared, 2.0 * g.clip(min=0), atol=2e-5)


@pytest.mark.parametrize("kind", range(len(Activation)))
def test_activations_are_odd_increasing_and_have_the_named_slope(kind):
    u = np.linspace(-1.5, 1.5, 301)
    psi = np.array([activation(kind, v) for v in u])
    np.testing.assert_allclose(psi, -psi[::-1], atol=1e-12)
    assert (np.diff(psi) >= 0).all()
    slope = SLOPE_AT_ZERO[list(Activation)[kind]]
    measured = activation(kind, 1e-9) / 1e-9
    if np.isinf(slope):
        assert measured > 1e3
    else:
        assert measured == pytest.approx(slope, rel=1e-6, abs=1e-12)


@given(st.integers(0, 10**6))
def test_saddle_systems_equal_a_dense_solve(seed):
    rng = np.random.default_rng(seed)
    C, A, f = rng.normal(size=(20, 14)), rng.normal(size=(6, 14)), rng.normal(size=20)
    H = np.eye(14) + C.T @ (rng.random(20)[:, None] * C)
    dense = np.linalg.solve(np.block([[H, A.T], [A, np.zeros((6, 6))]]), f)
    solve_saddle(H, A, f)
    np.testing.assert_allclose(f, dense, atol=1e-8)


def readable_optimality(p, settings, y):
    """F(y) and M(y) in matrices."""
    n = p.size
    C = np.vstack([p.G, np.eye(n), -np.eye(n)])
    d = np.concatenate([p.h, p.upper, -p.lower])
    kind = code(settings.penalty)
    P = np.array([penalty(kind, settings.factor, settings.sharpness, g) for g in C @ y[:n] - d])
    F = np.concatenate([y[:n] - p.target + p.A.T @ y[n:] + C.T @ P[:, 1], p.A @ y[:n] - p.b])
    H = np.eye(n) + C.T @ (P[:, 2:] * C)
    return F, np.block([[H, p.A.T], [p.A, np.zeros((len(p.b),) * 2)]])


@pytest.mark.parametrize("name", Penalty)
def test_optimality_and_its_jacobian(name):
    rng = np.random.default_rng(0)
    p = random_problem(rng)
    settings = NetworkSettings(penalty=name, factor=2.0, sharpness=3.0)
    parts = p.parts
    y = 0.3 * rng.normal(size=20)
    F, H = np.empty(20), np.empty((14, 14))
    optimality(settings.numbers(), parts, y, F)
    penalised_hessian(settings.numbers(), parts, y, H)
    readable, M = readable_optimality(p, settings, y)
    np.testing.assert_allclose(F, readable, atol=1e-12)
    np.testing.assert_allclose(H, M[:14, :14], atol=1e-12)
    step, ends = 1e-6, np.empty((2, 20))
    for k in range(20):
        for end, sign in zip(ends, (1, -1), strict=True):
            moved = y.copy()
            moved[k] += sign * step
            optimality(settings.numbers(), parts, moved, end)
        np.testing.assert_allclose((ends[0] - ends[1]) / (2 * step), M[:, k], rtol=1e-6, atol=1e-4)


@given(st.integers(0, 10**6))
def test_primal_dual_network_in_matrices_and_at_its_rest_point(seed):
    rng = np.random.default_rng(seed)
    p = random_problem(rng, 6, 5)
    parts = p.parts
    n, m, k = 14, 6, 5
    M = np.block(
        [
            [np.eye(n), -p.A.T, p.G.T],
            [p.A, np.zeros((m, m + k))],
            [-p.G, np.zeros((k, m + k))],
        ]
    )
    q = np.concatenate([-p.target, -p.b, p.h])
    u = rng.normal(size=n + m + k)
    low = np.concatenate([p.lower, np.full(m, -np.inf), np.zeros(k)])
    high = np.concatenate([p.upper, np.full(m + k, np.inf)])
    e, d = np.empty_like(u), np.empty_like(u)
    projection_error(parts, u, e)
    np.testing.assert_allclose(e, u - (u - (M @ u + q)).clip(low, high), atol=1e-12)
    direction(parts, e, d)
    np.testing.assert_allclose(d, e + M.T @ e, atol=1e-12)
    exact = solve(p)
    projection_error(parts, np.concatenate([exact.x, -exact.y, exact.z]), e)
    assert np.abs(e).max() < 1e-9


def test_primal_dual_iteration_converges():
    p = random_problem(np.random.default_rng(1), 6, 5)
    u = np.zeros(25)
    made = iterate(p.parts, u, 200_000, 1e-8)
    assert made < 200_000
    np.testing.assert_allclose(u[:14], solve(p).x, atol=1e-6)


@pytest.mark.parametrize("wrong", [{"gamma": -1.0}, {"factor": np.nan}, {"sharpness": 0.0}])
def test_bad_settings_are_refused(wrong):
    with pytest.raises(InputError, match="NetworkSettings"):
        NetworkSettings(**wrong)


@pytest.mark.parametrize("name", ["penalty", "activation", "feed_forward"])
def test_unknown_names_are_refused(name):
    with pytest.raises(UnknownNameError, match="should be"):
        NetworkSettings(**{name: "other"})
