"""The varying-parameter network: a flow whose rest points are the optimality conditions.

Asking the error xi = F(y, t) to decay as dxi/dt = -gamma e^t Psi(xi), and moving what depends on
the unknown rate to the left, gives

    M(y) dy/dt = -dF/dt|_y - gamma e^t Psi(F),

with M of :mod:`.optimality`. The Hessian of the penalty in M is what differentiating e(y, t) in
E y = e demands. dF/dt at fixed y, as the robot moves with x and the path goes on, is taken as a
central difference along the motion: it holds the rates of A, b, G and h at once.
"""

from __future__ import annotations

import numpy as np

from ...kernel import kernel
from ...settings import code
from ..assembly import sense, state
from ..circle import follow
from .activation import activation
from .network_settings import FeedForward
from .optimality import optimality, penalised_hessian
from .saddle import solve_saddle

#: Half step of the central difference [s].
HALF_STEP = 1e-5
_WITHOUT_BARRIER_RATE = code(FeedForward.WITHOUT_BARRIER_RATE)
_NONE_GIVEN = code(FeedForward.NONE)


@kernel
def gain_at(network, t):
    """min(gamma e^t, cap) or min(gamma, cap) [1/s]."""
    return min(network.gamma * (np.exp(t) if network.growing else 1.0), network.cap)


@kernel
def network_rate(network, gain, feed_forward, program, y, rate):
    """dy/dt (n + m,) of one problem; ``feed_forward`` (n + m,) is dF/dt at fixed y."""
    optimality(network, program, y, rate)
    for i in range(len(rate)):
        rate[i] = -feed_forward[i] - gain * activation(network.activation, rate[i])
    n = len(program.target)
    H = np.empty((n, n))
    penalised_hessian(network, program, y, H)
    solve_saddle(H, program.A, rate)


@kernel
def problem_rate(arrays, numbers, network, circle, q, home, t, count, y, noise, B, drift):
    """dF/dt at fixed y (n + m,), with the pairs that give rows held; overwrites the buffers.

    ``B`` has to have been filled at (q, t), so that it knows the pairs.
    """
    n = len(q)
    position, velocity = np.empty((len(B.tips), 3)), np.empty((len(B.tips), 3))
    F = np.empty(len(y))
    chosen, h = B.chosen[:count].copy(), B.program.h.copy()
    for sign in (-1.0, 1.0):
        step = sign * HALF_STEP
        moved = q + step * y[:n]
        sense(arrays, numbers, moved, noise, B)
        B.chosen[:count] = chosen
        follow(circle, t + step, position, velocity)
        program = state(arrays, numbers, moved, home, position, velocity, count, B)
        if network.feed_forward == _WITHOUT_BARRIER_RATE:
            program.h[:] = h[: len(program.h)]
        optimality(network, program, y, F)
        drift += sign * F / (2.0 * HALF_STEP)


@kernel
def state_rate(arrays, numbers, network, circle, q, home, t, y, noise, disturbance, buffers, rate):
    """dy/dt (n + m,) of the network that drives the arms at (q, t); returns the number of rows.

    Parameters
    ----------
    noise : (P,) or (0,)
        Error of the distance readings [m].
    disturbance : (n + m,)
        Added to the right-hand side.
    buffers
        Left as filled at (q, t).
    """
    B, drift = buffers, np.zeros(len(y))
    position, velocity = np.empty((len(B.tips), 3)), np.empty((len(B.tips), 3))
    follow(circle, t, position, velocity)
    count = sense(arrays, numbers, q, noise, B)
    if network.feed_forward != _NONE_GIVEN:
        state(arrays, numbers, q, home, position, velocity, count, B)
        problem_rate(arrays, numbers, network, circle, q, home, t, count, y, noise, B, drift)
        sense(arrays, numbers, q, noise, B)
    program = state(arrays, numbers, q, home, position, velocity, count, B)
    drift -= disturbance
    network_rate(network, gain_at(network, t), drift, program, y, rate)
    return len(program.h)
