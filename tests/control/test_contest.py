"""Recorded problems and the contest of solvers in compiled loops."""

import numpy as np
import pytest

from dualarm_repro.control.contest import contest
from dualarm_repro.control.neural.network_settings import NetworkSettings
from dualarm_repro.control.parts import program_of
from dualarm_repro.control.recorded import recorded_problems, stacked
from dualarm_repro.control.settings import ControllerSettings
from dualarm_repro.control.simulate import simulate
from dualarm_repro.control.solvers import solve


@pytest.fixture(scope="module")
def problems(crossing):
    settings = ControllerSettings()
    motion = simulate(*crossing.parts, settings, dt=5e-3)
    made = recorded_problems(crossing.system, crossing.circles, motion, settings, 20)
    for k, problem in enumerate(made[::10]):
        np.testing.assert_allclose(solve(problem).x, motion.x[200 * k], atol=1e-9)
    return made


def test_stacking_keeps_every_row(problems):
    stack = stacked(problems)
    assert stack.rows.max() > 0
    for k, p in enumerate(problems):
        for found, expected in zip(program_of(stack, k), p.parts, strict=True):
            np.testing.assert_array_equal(found, expected)


def test_contest_measures_errors_against_the_exact_method(problems):
    entries = contest(problems, NetworkSettings(), (1, 4), (1, 50), repeats=3)
    error = {(e.solver, e.effort): e.error for e in entries}
    assert error["active_set", 1] == 0.0
    assert 1e-6 < error["network", 4] < 0.02
    assert error["primal_dual", 50] < error["primal_dual", 1]
    for e in entries:
        assert 0 < e.low <= e.microseconds <= e.high
        assert e.violation >= 0
