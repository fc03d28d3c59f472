"""The network in closed loop: rates, Newton steps, divergence, agreement with the exact one."""

import numpy as np
import pytest

from dualarm_repro.control.assembly import make_buffers, sense, state
from dualarm_repro.control.neural.continuous import integrate_network
from dualarm_repro.control.neural.fixed_step import divergence_time, simulate_network
from dualarm_repro.control.neural.network import network_rate, problem_rate
from dualarm_repro.control.neural.network_settings import NetworkSettings
from dualarm_repro.control.neural.optimality import optimality
from dualarm_repro.control.neural.primal_dual import (
    direction,
    iterate,
    projection_error,
    simulate_primal_dual,
)
from dualarm_repro.control.settings import ControllerSettings
from dualarm_repro.control.simulate import simulate
from dualarm_repro.control.solvers import solve
from dualarm_repro.errors import InputError, UnknownNameError

from ..conftest import random_problem
from .test_parts import readable_optimality

NO_NOISE = np.empty(0)


def test_one_step_with_unit_gain_is_one_newton_step():
    rng = np.random.default_rng(0)
    p, y, rate = random_problem(rng), rng.normal(size=20), np.empty(20)
    settings = NetworkSettings(penalty="softplus", factor=2.0, sharpness=3.0)
    network_rate(settings.numbers(), 1000.0, np.zeros(20), p.parts, y, rate)
    F, M = readable_optimality(p, settings, y)
    np.testing.assert_allclose(y + 1e-3 * rate, y - np.linalg.solve(M, F), atol=1e-9)


def test_the_flow_ends_near_the_exact_minimiser():
    p = random_problem(np.random.default_rng(3), 4, 4)
    exact, errors = solve(p), []
    for factor in (1e3, 1e4, 1e5):
        settings = NetworkSettings(penalty="quadratic", factor=factor)
        y, rate, F = np.zeros(18), np.empty(18), np.empty(18)
        for _ in range(400):  # Euler steps of the flow; full Newton steps can cycle on the kinks
            network_rate(settings.numbers(), 1.0, np.zeros(18), p.parts, y, rate)
            y += 0.1 * rate
        optimality(settings.numbers(), p.parts, y, F)
        assert np.abs(F).max() < 1e-8
        errors.append(np.abs(y[:14] - exact.x).max())
    # The bias of the quadratic penalty is the multiplier over the factor, to first order.
    assert errors[0] / errors[1] == pytest.approx(10, rel=0.2)
    assert errors[1] / errors[2] == pytest.approx(10, rel=0.2)  # to first order, as above


def test_problem_rate_is_the_derivative_along_the_motion(crossing):
    arrays, numbers = crossing.system.arrays, ControllerSettings(outer=0.3).numbers()
    network, circle = (
        NetworkSettings(penalty="softplus", factor=1.0, sharpness=2.0),
        crossing.circles,
    )
    y = 0.3 * np.random.default_rng(0).normal(size=20)
    buffers, drift = make_buffers(arrays, numbers), np.zeros(20)
    q0, t = crossing.q0, 3.0

    def F(s):
        """F at fixed y, moved along by s."""
        q = q0 + s * y[:14]
        count = sense(arrays, numbers, q, NO_NOISE, buffers)
        program = state(arrays, numbers, q, q0, *circle.at(t + s), count, buffers)
        out = np.empty(20)
        optimality(network.numbers(), program, y, out)
        return out, count

    _, count = F(0.0)
    assert count > 0
    given = (arrays, numbers, network.numbers(), circle.numbers(), q0, q0, t, count, y, NO_NOISE)
    problem_rate(*given, buffers, drift)
    step = 1e-4
    np.testing.assert_allclose(drift, (F(step)[0] - F(-step)[0]) / (2 * step), atol=1e-5)


def test_capped_network_follows_the_exact_controller(crossing):
    q0, circles, settings = crossing.q0, crossing.circles, ControllerSettings()
    exact = simulate(crossing.system, circles, q0, settings)
    motion = simulate_network(crossing.system, circles, q0, settings, NetworkSettings())
    assert motion.completed
    assert motion.smallest_distance > settings.inner - 5e-4
    assert motion.largest_error < 1e-4
    assert np.abs(motion.x - exact.x).max() < 0.05


@pytest.mark.parametrize("gamma", [1.0, 10.0, 80.0])
def test_growing_gain_diverges_when_predicted(crossing, gamma):
    motion = simulate_network(
        crossing.system,
        crossing.circles,
        crossing.q0,
        ControllerSettings(),
        NetworkSettings(gamma=gamma, capped=False),
    )
    assert "diverged" in motion.stopped
    assert motion.time[-1] == pytest.approx(divergence_time(gamma, 1e-3), abs=0.4)  # steps


def test_without_the_hessian_the_network_diverges(crossing):
    motion = simulate_network(
        crossing.system,
        crossing.circles,
        crossing.q0,
        ControllerSettings(),
        NetworkSettings(hessian=False),
    )
    assert not motion.completed


@pytest.mark.parametrize("integrator", ["bdf", "radau"])
def test_stiff_integration_needs_no_cap(crossing, integrator):
    motion, evaluations = integrate_network(
        crossing.system,
        crossing.circles,
        crossing.q0,
        ControllerSettings(),
        NetworkSettings(),
        integrator=integrator,
    )
    assert motion.completed
    assert motion.smallest_distance > 0.0295
    assert motion.largest_error < 1e-6
    assert evaluations > 500


def test_unknown_integrator(crossing):
    with pytest.raises(UnknownNameError, match="bdf"):
        integrate_network(
            crossing.system,
            crossing.circles,
            crossing.q0,
            ControllerSettings(),
            NetworkSettings(),
            integrator="lsoda",
        )


def test_a_step_of_the_primal_dual_network_leads_nearer_to_the_solution():
    rng = np.random.default_rng(7)
    p = random_problem(rng, 4, 4)
    size = p.size + len(p.b) + len(p.h)
    solution = np.zeros(size)
    assert iterate(p.parts, solution, 500_000, 1e-10) < 500_000
    np.testing.assert_allclose(solution[: p.size], solve(p).x, atol=1e-6)
    e, d = np.empty(size), np.empty(size)
    for _ in range(50):
        u = 3.0 * rng.normal(size=size)
        projection_error(p.parts, u, e)
        direction(p.parts, e, d)
        assert (u - solution) @ d >= e @ e - 1e-8
        before = np.linalg.norm(u - solution)
        iterate(p.parts, u, 1, 0.0)
        assert np.linalg.norm(u - solution) < before


def test_primal_dual_improves_with_iterations(crossing):
    q0, circles, settings = crossing.q0, crossing.circles, ControllerSettings()
    few, many = (
        simulate_primal_dual(crossing.system, circles, q0, settings, iterations=count)
        for count in (2, 60)
    )
    assert many.largest_error < few.largest_error
    assert many.completed
    with pytest.raises(InputError, match="iterations"):
        simulate_primal_dual(crossing.system, circles, q0, settings, iterations=0)
    with pytest.raises(InputError, match="form"):
        simulate_primal_dual(crossing.system, circles, q0, ControllerSettings(form="arm_axes"))
