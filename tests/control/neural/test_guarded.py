"""The guard around the network: it takes over, slows down, and says where a path is blocked."""

import numpy as np
import pytest

from dualarm_repro.control.circle import Circles
from dualarm_repro.control.neural.fixed_step import simulate_network
from dualarm_repro.control.neural.guarded import TOLERANCE, simulate_guarded, violation
from dualarm_repro.control.neural.network_settings import NetworkSettings
from dualarm_repro.control.settings import ControllerSettings
from dualarm_repro.control.solvers import solve
from dualarm_repro.papers.patent.document import frozen

from ..conftest import random_problem

SETTINGS, NETWORK = ControllerSettings(), NetworkSettings()


def test_violation_is_the_largest_of_task_rows_and_bounds():
    p = random_problem(np.random.default_rng(2))
    x = solve(p).x
    assert violation(p.parts, x) < 1e-9
    for k, bound in ((3, p.upper), (5, p.lower)):
        moved = x.copy()
        moved[k] = bound[k] + np.sign(bound[k] - x[k] or 1.0) * 5.0
        assert violation(p.parts, moved) >= 5.0 - 1e-9
    assert violation(p.parts, x + 1e-3) >= np.abs(p.A @ (x + 1e-3) - p.b).max()
    assert violation(p.parts, x * np.nan) == np.inf


def test_where_nothing_is_wrong_the_network_is_left_alone(crossing):
    plain = simulate_network(*crossing.parts, SETTINGS, NETWORK)
    guarded, shares = simulate_guarded(*crossing.parts, SETTINGS, NETWORK)
    assert shares.slowed == 0.0
    assert shares.handed_over < 0.01
    assert guarded.completed
    assert guarded.q[-1] == pytest.approx(plain.q[-1], abs=1e-3)


def test_a_task_that_is_too_fast_is_slowed_down_within_the_limits():
    fast = frozen("limits", duration=2.0)
    plain = simulate_network(*fast.parts, SETTINGS, NETWORK)
    assert plain.finished
    assert not plain.completed
    assert "speed" in plain.broken
    guarded, shares = simulate_guarded(*fast.parts, SETTINGS, NETWORK)
    assert guarded.completed
    assert shares.slowed > 0.0
    assert guarded.time[-1] > fast.period


def test_a_path_out_of_reach_is_blocked_without_harm(crossing):
    tips = crossing.system.tips(crossing.q0)
    away = np.array([[0.0, 2.0, 0.0], [0.0, -2.0, 0.0]])
    far = Circles(tips + away, -away, np.roll(away, 1, axis=1), 10.0)
    motion, shares = simulate_guarded(
        crossing.system, far, crossing.q0, SETTINGS, NETWORK, dt=5e-3, tolerance=TOLERANCE
    )
    assert "the path is blocked at t =" in motion.stopped
    assert motion.broken == ()
    assert shares.handed_over >= shares.slowed > 0.0
