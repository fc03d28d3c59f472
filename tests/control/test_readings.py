"""What is read wrongly: noise, angles that are off, angles that are late."""

import numpy as np
import pytest

from dualarm_repro.control.neural.fixed_step import simulate_network
from dualarm_repro.control.neural.network_settings import NetworkSettings
from dualarm_repro.control.neural.primal_dual import simulate_primal_dual
from dualarm_repro.control.readings import Readings, angles_at, low_pass, noise_at
from dualarm_repro.control.settings import ControllerSettings
from dualarm_repro.control.simulate import simulate
from dualarm_repro.errors import InputError

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


@pytest.mark.parametrize(
    ("wrong", "line"),
    [
        ({"noise": np.ones(4)}, r"noise \(its shape\) = \(4,\): expected finite numbers \(T, P\)"),
        ({"noise": [[np.nan]]}, "noise = nan"),
        ({"offset": np.zeros(3)}, "length of offset = 3: expected 14"),
        ({"offset": np.zeros((2, 14))}, r"offset \(its shape\)"),
        ({"delay": -1}, "delay = -1: expected a whole number, at least 0"),
    ],
)
def test_wrong_readings_are_named(system, wrong, line):
    with pytest.raises(InputError, match=line):
        Readings.of(system, **wrong)


@pytest.mark.parametrize("solver", list(SOLVERS))
def test_readings_of_another_system_are_refused_by_every_solver(crossing, solver):
    """A kernel would look for the last pairs and joints beyond the end of the arrays."""
    pairs, still = len(crossing.system.arrays.pairs), np.zeros(crossing.system.nq)
    few = Readings.of(crossing.system, noise=np.ones((4, pairs - 1)))
    line = rf"shape of noise = \(4, {pairs - 1}\): expected \(steps, {pairs}\), one for each"
    with pytest.raises(InputError, match=line):
        SOLVERS[solver](crossing.parts, few)
    for made in (Readings(np.empty((0, 0)), still[1:], 0), Readings(np.ones(3), still, 0)):
        with pytest.raises(InputError, match=r"Readings\.of: "):
            SOLVERS[solver](crossing.parts, made)
