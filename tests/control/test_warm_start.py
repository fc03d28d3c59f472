"""The pseudo-inverse solution, and exact answers that start from the set before."""

from itertools import pairwise

import numpy as np
import pytest

from dualarm_repro.control.contest import contest
from dualarm_repro.control.least_norm import least_norm
from dualarm_repro.control.neural.network_settings import NetworkSettings
from dualarm_repro.control.operations import exact_cost, exact_cost_after
from dualarm_repro.control.recorded import recorded_problems
from dualarm_repro.control.settings import ControllerSettings
from dualarm_repro.control.simulate import simulate
from dualarm_repro.control.solvers import solve
from dualarm_repro.control.warm_start import least_distance_from

from .conftest import random_problem


@pytest.fixture(scope="module")
def problems(crossing):
    settings = ControllerSettings()
    motion = simulate(*crossing.parts, settings, dt=5e-3)
    return recorded_problems(crossing.system, crossing.circles, motion, settings, 10)


def from_set(p, z, w):
    at_bound = np.sign(np.where(np.abs(w) > 1e-9, w, 0.0)).astype(np.int64)
    return least_distance_from(p.parts, z > 1e-9, at_bound)


def test_least_norm_is_the_pseudo_inverse():
    p = random_problem(np.random.default_rng(4))
    x, y = np.empty(p.size), np.empty(len(p.b))
    least_norm(p.target, p.A, p.b, x, y)
    expected = p.target + np.linalg.pinv(p.A) @ (p.b - p.A @ p.target)
    np.testing.assert_allclose(x, expected, atol=1e-12)
    np.testing.assert_allclose(x, p.target - p.A.T @ y, atol=1e-12)


def test_the_right_set_is_kept_and_gives_the_minimiser(problems):
    for p in problems:
        exact = solve(p)
        kept, status, x, y, z, w = from_set(p, exact.z, exact.w)
        assert kept
        assert status == 0
        for found, expected in zip((x, y, z, w), (exact.x, exact.y, exact.z, exact.w), strict=True):
            np.testing.assert_allclose(found, expected, atol=1e-7)


def test_a_wrong_set_is_noticed(problems):
    pressed = [p for p in problems if solve(p).z.max(initial=0.0) > 1e-3]
    assert pressed
    for p in pressed:
        exact = solve(p)
        for z in (np.zeros_like(exact.z), np.ones_like(exact.z)):
            kept, status, x, *_ = from_set(p, z, np.zeros(p.size))
            assert not kept or len(exact.z) == 1
            assert status == 0
            np.testing.assert_allclose(x, exact.x, atol=1e-9)


@pytest.mark.parametrize("every", [10, pytest.param(1, marks=pytest.mark.long)])
def test_from_the_set_before_the_exact_answer_is_cheap(problems, every):
    same = [(p, q) for p, q in pairwise(problems) if len(p.h) == len(q.h)][::every]
    assert len(same) > 10
    costs = [(exact_cost_after(q, p).total(), exact_cost(q).total()) for p, q in same]
    assert np.median([a / b for a, b in costs]) < 0.7
    entries = {e.solver: e for e in contest(problems, NetworkSettings(), (1,), (1,), repeats=3)}
    assert entries["active_set_warm"].error < 1e-9
