"""Solvers agree pairwise, answers carry their certificate, and failures are loud."""

from itertools import combinations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dualarm_repro.control import solvers
from dualarm_repro.control.certificate import residual
from dualarm_repro.control.least_distance import INFEASIBLE, ITERATION_LIMIT, SOLVED
from dualarm_repro.control.problem import NoSolution, QuadraticProgram, Solution
from dualarm_repro.control.relaxed import least_distance_with_slack
from dualarm_repro.control.solvers import OPTIONAL_SOLVERS, SOLVERS, solve
from dualarm_repro.errors import InputError, UnknownNameError

from .conftest import random_problem

#: Agreement of the minimisers with an exact solver; interior-point methods end at about 1e-5.
AGREES = {
    "active_set": 1e-9,
    "daqp": 1e-9,
    "quadprog": 1e-9,
    "proxqp": 1e-6,
    "piqp": 2e-5,
    "cvxpy": 1e-5,
}


@pytest.fixture(scope="module")
def answers():
    problems = [
        random_problem(np.random.default_rng(seed), equalities, rows, 0.2)
        for seed, (equalities, rows) in enumerate([(6, 12), (0, 12), (6, 0), (6, 24), (3, 5)])
    ]
    return [{name: solve(problem, name).x for name in AGREES} for problem in problems]


@pytest.mark.parametrize(("a", "b"), list(combinations(AGREES, 2)))
def test_solvers_agree_pairwise(answers, a, b):
    for found in answers:
        np.testing.assert_allclose(found[a], found[b], rtol=0, atol=max(AGREES[a], AGREES[b]))


@given(st.integers(0, 10**6), st.sampled_from([0, 3, 6]), st.sampled_from([0, 4, 24]))
def test_active_set_is_optimal_and_equals_daqp(seed, equalities, rows):
    problem = random_problem(np.random.default_rng(seed), equalities, rows)
    own = solve(problem)
    assert own.residual < 1e-10
    np.testing.assert_allclose(own.x, solve(problem, "daqp").x, rtol=0, atol=1e-8)


@given(st.integers(0, 10**6))
def test_compiled_residual_equals_the_readable_one(seed):
    rng = np.random.default_rng(seed)
    p = random_problem(rng)
    parts = [rng.normal(size=size) for size in (14, 6, 12, 14)]
    readable = Solution(p, *parts).residual
    compiled = residual(p.parts, *parts)
    assert compiled == pytest.approx(readable, rel=1e-12)


def test_dependent_equalities_are_accepted_and_contradictions_found():
    p = random_problem(np.random.default_rng(0), 3, 4)
    twice = QuadraticProgram(
        p.target, np.vstack([p.A, p.A]), np.r_[p.b, p.b], p.G, p.h, p.lower, p.upper
    )
    np.testing.assert_allclose(solve(twice).x, solve(p).x, atol=1e-9)
    against = QuadraticProgram(
        p.target, np.vstack([p.A, p.A]), np.r_[p.b, p.b + 1], p.G, p.h, p.lower, p.upper
    )
    for solver in ("active_set", "daqp", "quadprog"):
        with pytest.raises(NoSolution) as caught:
            solve(against, solver)
        assert caught.value.problem is against


def test_infeasible_inequalities_are_found():
    n = 3
    G = np.array([[1.0, 0, 0], [-1.0, 0, 0]])
    problem = QuadraticProgram(
        np.zeros(n), np.zeros((0, n)), [], G, [-1.0, -1.0], -np.ones(n), np.ones(n)
    )
    for solver in AGREES:
        with pytest.raises(NoSolution, match="problem"):
            solve(problem, solver)


def test_why_there_is_no_answer_is_told(monkeypatch):
    """By the status of the own method where nobody else has an answer."""
    problem = random_problem(np.random.default_rng(5))
    right = solve(problem)
    answers = {
        "exclude each other": (INFEASIBLE, right.x),
        "iteration limit": (ITERATION_LIMIT, right.x),
        "the residual": (SOLVED, right.x + 1e-3),
    }
    monkeypatch.setattr(solvers, "second_opinion", lambda _: None)
    for reason, (status, x) in answers.items():
        found = (status, x, right.y, right.z, right.w)
        monkeypatch.setattr(solvers, "least_distance", lambda _, found=found: found)
        with pytest.raises(NoSolution, match=reason):
            solve(problem)


def test_every_solver_is_compared():
    assert set(AGREES) == set(SOLVERS) | set(OPTIONAL_SOLVERS)


def test_a_solver_of_an_extra_that_is_not_installed_is_named(monkeypatch):
    """The plain install lacks quadprog: one line says which extra brings it."""
    monkeypatch.setattr(solvers, "available_solvers", ["daqp", "piqp", "proxqp"])
    problem = random_problem(np.random.default_rng(0))
    with pytest.raises(UnknownNameError, match=r"quadprog \(extra `solvers`\)"):
        solve(problem, "quadprog")
    assert solve(problem).residual < 1e-10


def test_a_wrong_answer_is_not_certified():
    problem = random_problem(np.random.default_rng(1))
    right = solve(problem)
    assert right.certified()
    moved = Solution(problem, right.x + 1e-4, right.y, right.z, right.w)
    assert not moved.certified()
    assert not Solution(problem, np.full(14, np.nan), right.y, right.z, right.w).certified()


def test_slack_is_zero_in_the_limit_and_satisfies_the_inequalities_always():
    p = random_problem(np.random.default_rng(2), 6, 6, 0.0)
    status, *found = least_distance_with_slack(p.parts, 1e9)
    assert status == 0
    assert np.abs(found[-1]).max() < 1e-6
    hard = QuadraticProgram(p.target, p.A, p.b + 50.0, p.G, p.h, p.lower, p.upper)
    with pytest.raises(NoSolution):
        solve(hard)
    status, *found = least_distance_with_slack(hard.parts, 1e4)
    solution = Solution(hard, *found)
    assert solution.certified()
    assert np.abs(solution.slack).max() > 1.0


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("target", [np.nan] * 14),
        ("b", [np.inf] * 6),
        ("G", np.zeros((12, 3))),
        ("lower", [9.0] * 14),
    ],
)
def test_bad_problems_are_refused(field, value):
    p = random_problem(np.random.default_rng(3))
    fields = {name: getattr(p, name) for name in p.__dataclass_fields__}
    with pytest.raises(InputError, match=field):
        QuadraticProgram(**{**fields, field: value})


def test_unknown_solver():
    with pytest.raises(UnknownNameError, match="daqp"):
        solve(random_problem(np.random.default_rng(4)), "simplex")


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_multiplier_of_a_bound_that_is_not_met_counts_on_either_side(sign):
    """Only complementarity is violated: |w| times the distance from the bound, over 1 + |w|."""
    p = random_problem(np.random.default_rng(4), 0, 0)
    x = 0.5 * (p.lower + p.upper)
    w = np.zeros_like(x)
    w[3] = 2.0 * sign
    at = QuadraticProgram(x + w, p.A, p.b, p.G, p.h, p.lower, p.upper)
    bound = at.upper if sign > 0 else at.lower
    right = 2.0 * abs(bound[3] - x[3]) / 3.0
    assert residual(at.parts, x, np.zeros(0), np.zeros(0), w) == pytest.approx(right)
