"""The steps of the proof of convergence, the integral, and single precision."""

import numpy as np
import pytest

from dualarm_repro.control.neural.activation import Activation
from dualarm_repro.control.neural.continuous import integrate_network
from dualarm_repro.control.neural.fixed_step import simulate_network
from dualarm_repro.control.neural.network_settings import NetworkSettings
from dualarm_repro.control.neural.penalty import Penalty
from dualarm_repro.control.neural.primal_dual import simulate_primal_dual
from dualarm_repro.control.neural.single_precision import simulate_in_single_precision
from dualarm_repro.control.neural.stability import odd_and_increasing, proof_steps
from dualarm_repro.control.problem import QuadraticProgram
from dualarm_repro.control.settings import ControllerSettings
from dualarm_repro.errors import InputError

from ..conftest import random_problem


@pytest.mark.parametrize("form", list(Activation))
def test_every_activation_is_odd_and_increasing(form):
    odd, increase = odd_and_increasing(form)
    assert odd < 1e-12
    assert increase >= 0.0


@pytest.mark.parametrize("form", list(Penalty))
def test_the_matrix_is_regular_with_as_many_negative_eigenvalues_as_equalities(form):
    rng = np.random.default_rng(4)
    p, network = random_problem(rng), NetworkSettings(penalty=form, factor=10.0, sharpness=1.0)
    for _ in range(10):
        found = proof_steps(p, network, 0.1 * rng.normal(size=p.size + len(p.b)))
        assert found.least_eigenvalue >= 1.0 - 1e-9
        assert found.least_singular > 0.0
        assert found.negative == len(p.b)


def test_without_full_rank_it_is_singular():
    p = random_problem(np.random.default_rng(4))
    A, b = np.vstack([p.A, p.A[:1]]), np.append(p.b, p.b[0])
    twice = QuadraticProgram(p.target, A, b, p.G, p.h, p.lower, p.upper)
    found = proof_steps(twice, NetworkSettings(), np.zeros(p.size + len(b)))
    assert found.least_singular_task < 1e-12
    assert found.least_singular < 1e-9


def test_the_integral_takes_out_a_constant_push(crossing):
    steps, size = 10_000, crossing.system.nq + 6
    push = np.tile(0.1 * np.ones(size), (steps, 1))
    late = {}
    for integral in (0.0, 1e3):
        network = NetworkSettings(integral=integral)
        motion = simulate_network(*crossing.parts, ControllerSettings(), network, disturbance=push)
        late[integral] = np.median(motion.error[steps // 2 :].max(axis=1))
    assert late[1e3] < 0.5 * late[0.0]
    with pytest.raises(InputError, match="integral"):
        integrate_network(*crossing.parts, ControllerSettings(), NetworkSettings(integral=1.0))


@pytest.mark.parametrize(
    ("state", "line"),
    [
        ({"y0": np.zeros(19)}, r"shape of y0 = \(19,\): expected \(20,\)"),
        (
            {"y0": np.zeros((1, 20))},
            r"y0 \(its shape\) = \(1, 20\): expected finite numbers \(n,\)",
        ),
        ({"y0": np.full(20, np.nan)}, "y0 = nan"),
        ({"disturbance": np.zeros((3, 19))}, r"shape of disturbance = \(3, 19\): .*\(steps, 20\)"),
        ({"disturbance": np.zeros(20)}, r"disturbance \(its shape\) = \(20,\).*\(T, n \+ m\)"),
        ({"disturbance": [[np.inf] * 20]}, "disturbance = inf"),
    ],
)
def test_states_of_another_network_are_refused(crossing, state, line):
    """Two arms of seven joints, three task rows each."""
    given = *crossing.parts, ControllerSettings()
    with pytest.raises(InputError, match=f"simulate_network: {line}"):
        simulate_network(*given, NetworkSettings(), **state)
    if "y0" in state:
        with pytest.raises(InputError, match=f"integrate_network: {line}"):
            integrate_network(*given, NetworkSettings(), **state)
    else:
        with pytest.raises(InputError, match=f"simulate_primal_dual: {line}"):
            simulate_primal_dual(*given, **state)


@pytest.mark.parametrize("iterations", [0, -1, 10**9])
def test_the_primal_dual_network_makes_a_bounded_number_of_iterations(crossing, iterations):
    with pytest.raises(InputError, match=rf"iterations = {iterations}: .*at least 1, at most \d+"):
        simulate_primal_dual(*crossing.parts, ControllerSettings(), iterations=iterations)


def test_single_precision_stays_near_double(crossing):
    runs = [
        go(*crossing.parts, ControllerSettings(), NetworkSettings(), dt=2e-2)
        for go in (simulate_network, simulate_in_single_precision)
    ]
    apart = np.abs(runs[0].q - runs[1].q).max()
    assert 0.0 < apart < 1e-2
    # round-off of single precision along the whole run
    assert runs[1].largest_error == pytest.approx(runs[0].largest_error, rel=0.05)
