"""Joint steps: each rule against its definition on potentials whose answer is known."""

from itertools import product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from window_scene import FIXED, SEARCH

from dualarm_repro.planning import JointAttraction, Sum, Update
from dualarm_repro.planning.descent.updates import next_configuration

FREE = np.full(6, -np.inf), np.full(6, np.inf)
GRADIENT = Update(rule="gradient", gain=0.05, max_step=0.02)
TARGET = np.array([0.3, -0.2, 0.1, 0.0, 0.4, -0.6])
starts = st.lists(st.floats(-2, 2), min_size=6, max_size=6).map(np.array)


class Valley:
    """U = |q_1|, a crease: the gradient never vanishes beside it."""

    def value(self, q, step=0):
        return np.abs(q[..., 0])

    def gradient(self, q, step=0):
        return np.sign(q) * (np.arange(len(q)) == 0)


@given(starts)
def test_gradient_step_is_bounded_downhill_and_along_the_gradient(q):
    potential = JointAttraction(TARGET, 4.0)
    step = next_configuration(potential, q, 0, GRADIENT, FREE) - q
    assert np.linalg.norm(step) <= 0.02 * (1 + 1e-12)
    assert potential.value(q + step) <= potential.value(q)
    if step.any():
        slope = potential.gradient(q)
        assert step @ slope == pytest.approx(-np.linalg.norm(step) * np.linalg.norm(slope))


def test_gradient_step_takes_gain_times_gradient_close_to_the_target():
    q = TARGET + 1e-3
    step = next_configuration(JointAttraction(TARGET, 4.0), q, 0, GRADIENT, FREE) - q
    assert step == pytest.approx(np.full(6, -0.05 * 4.0 * 1e-3))


def test_a_step_that_overshoots_is_halved():
    """With gain 0.05 and stiffness 1000 the full step multiplies the error by -49."""
    stiff, q = JointAttraction(TARGET, 1000.0), TARGET + 1e-4 * np.eye(6)[0]
    after = next_configuration(stiff, q, 0, GRADIENT, FREE)
    assert stiff.value(after) < stiff.value(q)
    assert after[0] - TARGET[0] == pytest.approx(1e-4 * (1 - 0.05 / 2**5 * 1000))


def test_on_a_crease_the_halvings_come_to_an_end():
    q = 1e-18 * np.eye(6)[0]
    assert np.array_equal(next_configuration(Valley(), q, 0, GRADIENT, FREE), q)


@given(starts)
def test_fixed_length(q):
    step = next_configuration(JointAttraction(TARGET, 4.0), q, 0, FIXED, FREE) - q
    assert np.linalg.norm(step) == pytest.approx(0.02)


@pytest.mark.parametrize("update", [GRADIENT, FIXED, SEARCH])
def test_at_the_minimum_nothing_moves(update):
    after = next_configuration(JointAttraction(TARGET, 4.0), TARGET, 0, update, FREE)
    assert np.array_equal(after, TARGET)


@given(starts)
def test_the_neighbour_is_the_best_of_all(q):
    potential = JointAttraction(TARGET, 4.0)
    after = next_configuration(potential, q, 0, SEARCH, FREE)
    every = [q + 0.03 * np.array(offset) for offset in product((-1, 0, 1), repeat=6)]
    assert potential.value(after) <= min(map(potential.value, every)) * (1 + 1e-11)
    assert np.abs((after - q) / 0.03 - np.round((after - q) / 0.03)).max() < 1e-9


def test_of_equal_neighbours_the_joint_stays():
    potential = JointAttraction(np.zeros(6), 1.0)
    q = 0.015 * np.eye(6)[2]
    assert np.array_equal(next_configuration(potential, q, 0, SEARCH, FREE), q)


@pytest.mark.parametrize("update", [GRADIENT, FIXED, SEARCH])
def test_limits_stop_a_step(update):
    lower, upper = np.full(6, -0.01), np.full(6, 0.01)
    after = next_configuration(JointAttraction(TARGET, 4.0), np.zeros(6), 0, update, (lower, upper))
    assert np.all((after >= lower) & (after <= upper))
    assert after.any()


def test_steps_of_a_sum_follow_the_sum():
    both = Sum([JointAttraction(TARGET, 1.0), JointAttraction(-TARGET, 1.0)])
    after = next_configuration(both, np.ones(6), 0, FIXED, FREE)
    assert np.all(after < 1.0)
