"""The compiled step against the parts it is made of, and the controller that calls it."""

import numpy as np
import pytest

from dualarm_repro.control.assembly import make_buffers
from dualarm_repro.control.controller import VelocityController
from dualarm_repro.control.few_constraints import make_work
from dualarm_repro.control.least_distance import SOLVED
from dualarm_repro.control.settings import ControllerSettings
from dualarm_repro.control.solvers import solve
from dualarm_repro.control.step import NOT_FINITE, control_step, make_step, taken
from dualarm_repro.errors import ConfigurationError, InputError
from dualarm_repro.scene.clearance import distances

SETTINGS = ControllerSettings(outer=0.5, inner=0.02, repetition=0.4)
VELOCITY = np.array([[0.05, -0.02, 0.03], [-0.04, 0.06, 0.01]])


@pytest.fixture(scope="module")
def parts(system):
    numbers = SETTINGS.numbers()
    buffers = make_buffers(system.arrays, numbers)
    return system.arrays, numbers, buffers, make_work(system.nq, 6, len(buffers.program.h))


@pytest.mark.parametrize("seed", range(3))
def test_a_step_is_the_minimiser_of_the_stated_problem(system, parts, seed):
    arrays, numbers, buffers, work = parts
    q = np.random.default_rng(seed).uniform(0.4 * arrays.lower, 0.4 * arrays.upper)
    home, tips = 0.5 * q, system.tips(q)
    found = control_step(arrays, numbers, q, home, tips, VELOCITY, buffers, work)
    status, rows, worst, smallest = found
    p = VelocityController(system, SETTINGS, home=home).problem(q, tips, VELOCITY)
    assert status == SOLVED
    assert rows == len(p.h)
    assert worst < 1e-10
    assert smallest == pytest.approx(distances(system.scene, q).min(), abs=1e-12)
    np.testing.assert_allclose(work.x, solve(p, "daqp").x, atol=1e-8)
    np.testing.assert_allclose(p.target, -0.4 * (q - home), atol=1e-15)


def test_what_is_bound_gives_the_same_step_and_writes_the_answer(system, q, parts):
    arrays, numbers, buffers, work = parts
    tips = system.tips(q)
    expected = control_step(arrays, numbers, q, q, tips, VELOCITY, buffers, work)
    step, x, answer = make_step(arrays, numbers, q, buffers, work), np.empty(14), work.x.copy()
    assert taken(step, q, tips, VELOCITY, x) == expected
    np.testing.assert_array_equal(x, answer)


@pytest.mark.parametrize("which", range(3))
@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_what_is_not_finite_is_not_computed_with(system, q, parts, which, value):
    arrays, numbers, buffers, work = parts
    step, x = make_step(arrays, numbers, q, buffers, work), np.full(14, 7.0)
    given = [q.copy(), system.tips(q), VELOCITY.copy()]
    given[which].flat[-1] = value
    assert taken(step, *given, x)[0] == NOT_FINITE
    assert (x == 7.0).all()


def test_lists_integers_and_other_orders_give_the_same_velocity(system, q):
    controller, tips = VelocityController(system, SETTINGS), system.tips(q)
    expected = controller.velocity(q, tips, VELOCITY)
    for given in (
        (q.tolist(), tips.tolist(), VELOCITY.tolist()),
        (q, np.asfortranarray(tips), np.repeat(VELOCITY, 2, axis=1)[:, ::2]),
    ):
        np.testing.assert_array_equal(controller.velocity(*given), expected)


def test_home_is_the_first_configuration_unless_it_is_given(system, q):
    tips = system.tips(q)
    for options, home in (({}, q), ({"home": np.zeros(14)}, np.zeros(14))):
        controller = VelocityController(system, SETTINGS, **options)
        controller.velocity(q, tips, VELOCITY)
        later = controller.problem(0.5 * q, tips, VELOCITY)
        np.testing.assert_allclose(later.target, -0.4 * (0.5 * q - home), atol=1e-15)


def test_what_a_controller_hands_out_stays_as_it_was(system, q):
    """Buffers are reused; an answer of before must not change with the next step."""
    controller, tips = VelocityController(system, SETTINGS), system.tips(q)
    first = controller.solution(q, tips, VELOCITY)
    kept = [part.copy() for part in (first.x, first.y, first.z, first.w, first.problem.G)]
    seen = controller.tips
    controller.velocity(0.99 * q, tips, -VELOCITY)
    for now, before in zip(
        (first.x, first.y, first.z, first.w, first.problem.G), kept, strict=True
    ):
        np.testing.assert_array_equal(now, before)
    np.testing.assert_allclose(seen, tips, atol=1e-12)
    assert np.abs(controller.tips - seen).max() > 1e-3


@pytest.mark.parametrize(
    ("place", "value", "kind", "line"),
    [
        (0, np.zeros(13), ConfigurationError, r"shape"),
        (1, [[0, 0], [0, 0]], InputError, r"controller: shape of position = \(2, 2\)"),
        (2, [["a"] * 3] * 2, InputError, r"controller: velocity = .*expected finite numbers"),
        (2, [[1, 2, np.inf]] * 2, InputError, r"controller: velocity = inf: expected finite"),
        (1, [[1, 2, 3j]] * 2, InputError, r"controller: position = "),
    ],
)
def test_each_wrong_argument_is_named_in_one_line(system, q, place, value, kind, line):
    given = [q, system.tips(q), VELOCITY]
    given[place] = value
    with pytest.raises(kind, match=line) as caught:
        VelocityController(system, SETTINGS).velocity(*given)
    assert "\n" not in str(caught.value)


def test_a_home_of_another_shape_is_refused_before_the_first_step(system):
    with pytest.raises(ConfigurationError):
        VelocityController(system, home=np.zeros(7))
