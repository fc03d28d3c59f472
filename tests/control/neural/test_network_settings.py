"""Settings of the network as its kernels read them, and the gain over time."""

import numpy as np
import pytest

from dualarm_repro.control.neural.activation import Activation
from dualarm_repro.control.neural.fixed_step import divergence_time
from dualarm_repro.control.neural.network import gain_at
from dualarm_repro.control.neural.network_settings import FeedForward, NetworkSettings
from dualarm_repro.control.neural.penalty import Penalty
from dualarm_repro.errors import InputError
from dualarm_repro.settings import code


def test_numbers_hold_what_was_set():
    made = NetworkSettings(
        penalty="softplus",
        factor=2.0,
        sharpness=3.0,
        activation="tanh",
        gamma=4.0,
        growing=False,
        hessian=False,
        feed_forward="none",
        integral=5.0,
    ).numbers()
    assert (made.penalty, made.activation) == (code(Penalty.SOFTPLUS), code(Activation.TANH))
    assert made.feed_forward == code(FeedForward.NONE)
    assert (made.factor, made.sharpness, made.gamma, made.integral) == (2.0, 3.0, 4.0, 5.0)
    assert (made.growing, made.hessian) == (False, False)


@pytest.mark.parametrize(
    ("activation", "cap"),
    [
        ("linear", 500.0),
        ("tanh", 500.0 / 3.0),
        ("bipolar_sigmoid", 500.0 * np.tanh(2.0) / 2.0),
        ("power", 500.0),
        ("sign_bi_power", 500.0),
    ],
)
def test_the_cap_makes_an_euler_step_one_newton_step(activation, cap):
    assert NetworkSettings(activation=activation).numbers(2e-3).cap == pytest.approx(cap)


def test_no_step_or_no_cap_leaves_the_gain_unlimited():
    assert NetworkSettings().numbers().cap == np.inf
    assert NetworkSettings(capped=False).numbers(1e-3).cap == np.inf
    with pytest.raises(InputError, match="dt = 0"):
        NetworkSettings().numbers(0.0)


def test_the_gain_grows_until_its_cap_or_stays():
    growing = NetworkSettings(gamma=10.0).numbers(1e-3)
    assert gain_at(growing, 0.0) == 10.0
    assert gain_at(growing, 2.0) == pytest.approx(10.0 * np.e**2)
    assert gain_at(growing, np.log(100.0) + 0.1) == 1000.0
    constant = NetworkSettings(gamma=10.0, growing=False).numbers(1e-3)
    assert gain_at(constant, 8.0) == 10.0


@pytest.mark.parametrize(("gamma", "dt"), [(10.0, 1e-3), (1.0, 5e-3)])
def test_divergence_is_due_where_the_gain_takes_two_steps_in_one(gamma, dt):
    uncapped = NetworkSettings(gamma=gamma, capped=False).numbers(dt)
    assert gain_at(uncapped, divergence_time(gamma, dt)) * dt == pytest.approx(2.0)
