"""What is read wrongly: noise, angles that are off, angles that are late."""

import numpy as np
import pytest

from dualarm_repro.control.neural.fixed_step import simulate_network
from dualarm_repro.control.neural.network_settings import NetworkSettings
from dualarm_repro.control.neural.primal_dual import simulate_primal_dual
from dualarm_repro.control.readings import Readings, angles_at, low_pass, noise_at
from dualarm_repro.control.settings import ControllerSettings
from dualarm_repro.control.simulate import simulate

SETTINGS = ControllerSettings()
SOLVERS = {
    "exact": lambda parts, r: simulate(*parts, SETTINGS, dt=5e-3, readings=r),
    "network": lambda parts, r: simulate_network(
        *parts, SETTINGS, NetworkSettings(), dt=5e-3, readings=r
    ),
    "primal-dual": lambda parts, r: simulate_primal_dual(
        *parts, SETTINGS, iterations=50, dt=5e-3, readings=r
    ),
}


def test_what_is_read(system):
    q = np.arange(3.0 * system.nq).reshape(3, -1)
    plain = Readings.of(system)
    assert noise_at(plain, 1).shape == (0,)
    assert angles_at(plain, q, 2) == pytest.approx(q[2])
    wrong = Readings.of(system, noise=np.ones((2, 4)), offset=np.full(system.nq, 0.5), delay=2)
    assert noise_at(wrong, 1) == pytest.approx(np.ones(4))
    assert angles_at(wrong, q, 2) == pytest.approx(q[0] + 0.5)
    assert angles_at(wrong, q, 1) == pytest.approx(q[0] + 0.5)


@pytest.mark.parametrize("solver", list(SOLVERS))
def test_a_wrong_or_late_angle_shows_in_the_tips_of_every_solver(crossing, solver):
    go = SOLVERS[solver]
    plain = go(crossing.parts, None)
    for wrong in ({"offset": np.full(crossing.system.nq, 0.005)}, {"delay": 4}):
        found = go(crossing.parts, Readings.of(crossing.system, **wrong))
        assert found.largest_error > 3 * plain.largest_error


def test_a_low_pass_takes_noise_down_and_leaves_a_constant():
    rng = np.random.default_rng(0)
    noise = rng.normal(size=(4000, 2))
    assert low_pass(noise, 1e-3, 0.02)[500:].std() < 0.25
    assert low_pass(np.ones((400, 1)), 1e-3, 0.02)[-1] == pytest.approx([1.0])
