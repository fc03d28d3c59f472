"""The problem as stated, what certifies a solution, and small problems solved by hand."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualarm_repro.control.few_constraints import most_violated
from dualarm_repro.control.parts import ProgramParts, program_of, shapes, with_task
from dualarm_repro.control.problem import NoSolution, QuadraticProgram, Solution
from dualarm_repro.control.recorded import stacked
from dualarm_repro.control.relaxed import least_distance_with_slack
from dualarm_repro.control.solvers import SOLVERS, solve
from dualarm_repro.errors import InputError

from .conftest import random_problem

NONE = np.empty((0, 2)), np.empty(0)
FREE = np.full(2, -np.inf), np.full(2, np.inf)
#: Problems in the plane with minimiser and multipliers y, z, w worked out by hand.
BY_HAND = {
    "nearest point of a line": (
        QuadraticProgram([0, 0], [[3, 4]], [25], *NONE, *FREE),
        ([3, 4], [-1], [], [0, 0]),
    ),
    "nearest point of a half-plane": (
        QuadraticProgram([2, 2], *NONE, [[1, 1]], [2], *FREE),
        ([1, 1], [], [1], [0, 0]),
    ),
    "corner of a box": (
        QuadraticProgram([3, -4], *NONE, *NONE, [-1, -1], [1, 1]),
        ([1, -1], [], [], [2, -3]),
    ),
    "row that does not press": (
        QuadraticProgram([0.5, 0], *NONE, [[1, 1]], [2], [-1, -1], [1, 1]),
        ([0.5, 0], [], [0], [0, 0]),
    ),
    "line within a box": (
        QuadraticProgram([0, 0], [[1, 1]], [1.5], *NONE, [-1, 1], [2, 2]),
        ([0.5, 1], [-0.5], [], [0, -0.5]),
    ),
}


@pytest.mark.parametrize("name", list(BY_HAND))
@pytest.mark.parametrize("solver", SOLVERS)
def test_small_problems_have_the_answer_worked_out_by_hand(name, solver):
    problem, expected = BY_HAND[name]
    found = solve(problem, solver)
    for part, right in zip((found.x, found.y, found.z, found.w), expected, strict=True):
        # interior-point methods end about 1e-5 from the minimiser
        np.testing.assert_allclose(part, right, atol=3e-5)
    exact = Solution(problem, *(np.array(part, dtype=float) for part in expected))
    assert exact.residual < 1e-14


@pytest.mark.parametrize(
    ("change", "primal", "dual", "gap"),
    [
        ({}, 0.0, 0.0, 0.0),
        ({"x": [1.5, 1.0]}, 0.5, 0.5, 0.5),
        ({"z": [-1.0]}, 0.0, 2.0, 0.0),
        ({"z": [3.0]}, 0.0, 2.0, 0.0),
        ({"x": [0.0, 1.0]}, 0.0, 1.0, 1.0),
    ],
)
def test_residuals_of_a_wrong_answer_by_hand(change, primal, dual, gap):
    problem, (x, y, z, w) = BY_HAND["nearest point of a half-plane"]
    parts = {"x": x, "y": y, "z": z, "w": w} | change
    found = Solution(problem, *(np.array(part, dtype=float) for part in parts.values()))
    assert found.primal_residual == pytest.approx(primal)
    assert found.dual_residual == pytest.approx(dual)
    assert found.gap == pytest.approx(gap)
    size = 1.0 + abs(found.z[0])
    assert found.residual == pytest.approx(max(primal, dual / size, gap / size))
    assert found.certified() is (not change)
    assert found.certified(found.residual + 1e-12)


def test_slack_counts_as_taken_off_the_task():
    problem, _ = BY_HAND["nearest point of a line"]
    off = Solution(problem, np.zeros(2), np.zeros(1), np.zeros(0), np.zeros(2), np.array([25.0]))
    assert off.primal_residual == 0.0
    none = Solution(problem, np.zeros(2), np.zeros(1), np.zeros(0), np.zeros(2))
    assert none.slack == pytest.approx([0.0])
    assert none.primal_residual == 25.0


def test_a_task_that_may_yield_gives_up_by_hand():
    """min x^2/2 + 4 s^2/2 with x + s = 5, x <= 1 binding not: x = 4, s = 1; with it s = 4."""
    bounds = np.array([-np.inf]), np.array([np.inf])
    none = np.empty((0, 1)), np.empty(0)
    parts = QuadraticProgram([0], [[1]], [5], *none, *bounds).parts
    status, x, y, _, _, s = least_distance_with_slack(parts, 4.0)
    assert status == 0
    assert (x[0], s[0], y[0]) == pytest.approx((4.0, 1.0, -4.0))
    held = QuadraticProgram([0], [[1]], [5], *none, bounds[0], [1]).parts
    status, x, y, _, w, s = least_distance_with_slack(held, 4.0)
    assert (x[0], s[0], y[0], w[0]) == pytest.approx((1.0, 4.0, -16.0, 15.0))


@settings(max_examples=20)
@given(seed=st.integers(0, 10**6))
def test_more_weight_on_the_slack_gives_up_less(seed):
    p = random_problem(np.random.default_rng(seed), 4, 6)
    hard = QuadraticProgram(p.target, p.A, p.b + 3.0, p.G, p.h, p.lower, p.upper)
    sizes = []
    for weight in (0.1, 1.0, 10.0, 100.0):
        status, *_, s = least_distance_with_slack(hard.parts, weight)
        assert status == 0
        sizes.append(float(np.linalg.norm(s)))
    assert (np.diff(sizes) <= 1e-9).all()


@pytest.mark.parametrize(
    ("x", "expected"),
    [
        ([0.0, 0.0], -1),
        ([2.0, 0.0], 0),  # the row by 1, the upper bound by 0.5
        ([-3.0, 0.0], 1),  # the lower bound of the first
        ([0.0, -3.0], 2),
        ([-2.0, 3.0], 4),  # upper bound of the second, beyond by 1.5
    ],
)
def test_constraints_are_numbered_rows_first_then_lower_then_upper(x, expected):
    G, h = np.array([[1.0, 0.0]]), np.array([1.0])
    box = np.full(2, -1.5), np.full(2, 1.5)
    assert most_violated(np.array(x), G, h, *box) == expected


def test_parts_have_the_shapes_of_a_problem_and_another_task_changes_nothing_else():
    p = random_problem(np.random.default_rng(0), 3, 5)
    assert {n: getattr(p, n).shape for n in ProgramParts._fields} == shapes(14, 3, 5)
    other = with_task(p.parts, p.b + 1.0)
    np.testing.assert_array_equal(other.b, p.b + 1.0)
    for name in set(ProgramParts._fields) - {"b"}:
        np.testing.assert_array_equal(getattr(other, name), getattr(p, name))


def test_a_stack_of_problems_with_no_rows_has_none():
    problems = [random_problem(np.random.default_rng(k), 3, rows) for k, rows in ((0, 0), (1, 2))]
    stack = stacked(problems)
    assert stack.rows.tolist() == [0, 2]
    assert stack.parts.G.shape == (2, 2, 14)
    assert program_of(stack, 0).h.shape == (0,)


@pytest.mark.parametrize(
    ("field", "value", "line"),
    [
        (
            "b",
            np.zeros((3, 1)),
            r"b \(its shape\) = \(3, 1\): expected finite numbers \(m,\), m = 3",
        ),
        ("b", np.zeros(4), r"b \(its shape\) = \(4,\): expected finite numbers \(m,\), m = 3"),
        ("G", np.zeros((5, 3)), r"G \(its shape\) = \(5, 3\): .* \(k, n\), n = 14"),
        ("A", "a", r"QuadraticProgram: A = 'a'"),
        ("h", [np.inf] * 5, r"QuadraticProgram: h = inf: expected finite numbers"),
        ("upper", [np.nan] * 14, r"QuadraticProgram: upper = nan"),
        ("upper", [-50.0] * 14, r"QuadraticProgram: lower\[\d+\] = .*at most upper, -50"),
    ],
)
def test_each_wrong_part_is_named_in_one_line(field, value, line):
    p = random_problem(np.random.default_rng(0), 3, 5)
    fields = {name: getattr(p, name) for name in p.__dataclass_fields__}
    with pytest.raises(InputError, match=line) as caught:
        QuadraticProgram(**{**fields, field: value})
    assert "\n" not in str(caught.value)


def test_a_failure_keeps_its_problem_and_says_its_size():
    p = random_problem(np.random.default_rng(0), 3, 5)
    error = NoSolution("here", p, "two\nlines")
    assert error.problem is p
    assert str(error).startswith(
        "here: problem = 14 unknowns, 3 equalities, 5 inequalities: expected a solution, "
    )
    assert "\n" not in str(error)
