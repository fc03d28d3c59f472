"""Recorded problems and the contest of solvers in compiled loops."""

import numpy as np
import pytest

from dualarm_repro.control.contest import contest, exact_batch
from dualarm_repro.control.neural.network_settings import NetworkSettings
from dualarm_repro.control.parts import program_of
from dualarm_repro.control.recorded import recorded_problems, stacked
from dualarm_repro.control.settings import ControllerSettings
from dualarm_repro.control.simulate import simulate
from dualarm_repro.control.solvers import SOLVERS, solve
from dualarm_repro.errors import InputError


@pytest.fixture(scope="module")
def problems(crossing):
    settings = ControllerSettings()
    motion = simulate(*crossing.parts, settings, dt=5e-3)
    made = recorded_problems(crossing.system, crossing.circles, motion, settings, 20)
    for k, problem in enumerate(made[::10]):
        np.testing.assert_allclose(solve(problem).x, motion.x[200 * k], atol=1e-9)
    return made


@pytest.mark.parametrize("every", [0, -1, 2.0])
def test_steps_are_taken_one_in_so_many(crossing, every):
    motion = simulate(*crossing.parts, ControllerSettings(), dt=5e-2)
    given = crossing.system, crossing.circles, motion, ControllerSettings()
    with pytest.raises(InputError, match=f"recorded_problems: every = {every}: .*at least 1"):
        recorded_problems(*given, every)


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


def test_the_pseudo_inverse_is_timed_as_such(problems):
    entries = contest(problems, NetworkSettings(), (1,), (1,), repeats=3)
    (pinv,) = (e for e in entries if e.solver == "pseudo_inverse")
    apart = [np.abs(np.linalg.pinv(p.A) @ p.b - solve(p).x).max() for p in problems]
    assert pinv.error == pytest.approx(max(apart), rel=1e-9)
    assert pinv.error > 0.01
    assert pinv.violation > 0.01  # it knows no inequality


def test_every_solver_of_the_batch_answers_alike(problems):
    entries = exact_batch(problems[::10], repeats=1)
    assert [e.solver for e in entries] == list(SOLVERS)
    for e in entries:
        assert e.error < 1e-5
        assert e.microseconds > 0
