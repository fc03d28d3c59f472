"""Closed loop: the arms stay apart, the task is kept, and nothing fails in silence."""

import numpy as np
import pytest

from dualarm_repro.control.circle import Circles
from dualarm_repro.control.controller import VelocityController
from dualarm_repro.control.problem import NoSolution
from dualarm_repro.control.settings import ControllerSettings
from dualarm_repro.control.simulate import UNDISTURBED, pseudo_inverse, simulate
from dualarm_repro.control.solvers import solve
from dualarm_repro.errors import ConfigurationError, InputError, UnknownNameError
from dualarm_repro.papers.patent.document import frozen

STILL = np.zeros((2, 3))


def run(scenario, settings, **options):
    return simulate(*scenario.parts, settings, **options)


def test_avoidance_keeps_the_inner_range_where_naive_motion_collides(crossing):
    naive = run(crossing, pseudo_inverse(ControllerSettings()))
    motion = run(crossing, ControllerSettings())
    assert naive.smallest_distance < -0.05
    assert motion.completed
    assert motion.smallest_distance >= 0.03 - 5e-4
    assert motion.largest_error <= 5e-5


def test_without_inequalities_the_minimiser_is_the_pseudo_inverse(crossing):
    settings = pseudo_inverse(ControllerSettings())
    controller = VelocityController(crossing.system, settings)
    position, velocity = crossing.circles.at(2.0)
    problem = controller.problem(crossing.q0, position, velocity)
    x = controller.velocity(crossing.q0, position, velocity)
    np.testing.assert_allclose(x, np.linalg.pinv(problem.A) @ problem.b, atol=1e-10)


def test_error_falls_with_the_step_and_the_feedback(crossing):
    coarse, fine = (run(crossing, ControllerSettings(), dt=dt).largest_error for dt in (2e-3, 1e-3))
    # first order in the step; the second one still weighs
    assert fine == pytest.approx(coarse / 2, rel=0.1)
    assert run(crossing, ControllerSettings(feedback=0.0)).largest_error > 10 * fine


def test_each_row_holds_along_the_motion(crossing):
    motion = run(crossing, ControllerSettings(), dt=2e-3)
    controller = VelocityController(crossing.system)
    for k in range(0, len(motion.x), 400):
        problem = controller.problem(motion.q[k], *crossing.circles.at(motion.time[k]))
        solution = solve(problem, "daqp")
        np.testing.assert_allclose(solution.x, motion.x[k], atol=1e-8)


def test_inside_the_inner_range_the_arms_separate():
    scenario = frozen("too_close")
    motion = run(scenario, ControllerSettings())
    assert 0 < motion.distance[0] < 0.015
    assert motion.completed
    assert motion.distance[-1] >= 0.03 - 5e-4
    early = motion.distance[: round(0.5 / motion.dt)]
    assert (np.diff(early) > -1e-6).all()


def test_limits_hold_where_naive_motion_leaves_the_range():
    scenario = frozen("limits")
    arrays = scenario.system.arrays
    naive, motion = (
        run(scenario, pseudo_inverse(ControllerSettings())),
        run(scenario, ControllerSettings()),
    )
    assert ((naive.q > arrays.upper) | (naive.q < arrays.lower)).any()
    assert motion.completed
    assert (motion.q <= arrays.upper).all()
    assert (motion.q >= arrays.lower).all()
    assert (np.abs(motion.x) <= arrays.speed + 1e-9).all()


def test_repetition_ends_where_it_began(crossing):
    free = run(crossing, ControllerSettings(), dt=5e-3, cycles=5).drift(10.0)
    tied = run(crossing, ControllerSettings(repetition=2.0), dt=5e-3, cycles=5).drift(10.0)
    assert len(free) == len(tied) == 5
    assert tied.max() < 0.05 * free.max()


def test_unreachable_paths_stop_or_yield(crossing):
    tips = crossing.system.tips(crossing.q0)
    away = np.array([[0.0, 2.0, 0.0], [0.0, -2.0, 0.0]])
    far = Circles(tips + away, -away, np.roll(away, 1, axis=1), 10.0)
    stopped = simulate(crossing.system, far, crossing.q0, ControllerSettings(), dt=5e-3)
    assert not stopped.completed
    assert "no joint velocity satisfies all constraints at t =" in stopped.stopped
    yielding = simulate(
        crossing.system, far, crossing.q0, ControllerSettings(), dt=5e-3, slack=True
    )
    assert yielding.finished
    assert yielding.broken == ("path",)
    assert yielding.slack.max() > 0.1
    assert yielding.smallest_distance > 0.0


def test_controller_raises_or_yields(crossing):
    strict = VelocityController(crossing.system)
    yielding = VelocityController(crossing.system, slack=True)
    tips = crossing.system.tips(crossing.q0)
    with pytest.raises(NoSolution, match="exclude each other") as caught:
        strict.velocity(crossing.q0, tips, STILL + 5.0)
    assert caught.value.problem.size == 14
    solution = yielding.solution(crossing.q0, tips, STILL + 5.0)
    assert solution.certified()
    assert np.abs(solution.slack).max() > 1.0
    assert strict.distance == pytest.approx(yielding.distance)


def test_velocity_and_solution_agree(crossing):
    controller = VelocityController(crossing.system)
    position, velocity = crossing.circles.at(0.3)
    solution = controller.solution(crossing.q0, position, velocity)
    np.testing.assert_array_equal(controller.velocity(crossing.q0, position, velocity), solution.x)
    assert solution.certified()


def test_nan_is_refused(crossing):
    controller = VelocityController(crossing.system)
    tips = crossing.system.tips(crossing.q0)
    with pytest.raises(ConfigurationError, match="nan"):
        controller.velocity(np.full(14, np.nan), tips, STILL)
    for arguments in ((np.full((2, 3), np.nan), STILL), (tips, STILL + np.inf), (tips[:1], STILL)):
        with pytest.raises(InputError, match="controller"):
            controller.velocity(crossing.q0, *arguments)


@pytest.mark.parametrize(
    ("field", "value"),
    [("duration", 0.0), ("duration", np.nan), ("centre", [[np.nan] * 3] * 2), ("u", [[0.0] * 3])],
)
def test_bad_circles_are_refused(field, value):
    fields = {"centre": np.zeros((2, 3)), "u": np.eye(3)[:2], "v": np.eye(3)[1:]}
    with pytest.raises(InputError, match=field):
        Circles(**{**fields, field: value})
    with pytest.raises(UnknownNameError):
        Circles(**fields, law="backwards")


def test_a_circle_may_last_less_than_a_second():
    short = Circles(*np.eye(3)[:, None, :], 0.25)
    start, end = short.at(0.0)[0], short.at(0.25)[0]
    np.testing.assert_allclose(start, end, atol=1e-12)


def test_bad_runs_are_refused(crossing):
    for options in ({"dt": 0.0}, {"dt": np.nan}, {"dt": 20.0}, {"cycles": 0}):
        with pytest.raises(InputError, match="simulate"):
            run(crossing, ControllerSettings(), **options)


def test_circle_velocity_is_the_derivative(crossing):
    step = 1e-6
    for t in (0.3, 4.9, 7.7):
        later, earlier = crossing.circles.at(t + step)[0], crossing.circles.at(t - step)[0]
        difference = (later - earlier) / (2 * step)
        np.testing.assert_allclose(crossing.circles.at(t)[1], difference, atol=1e-8)
    np.testing.assert_allclose(crossing.circles.at(0.0)[0], crossing.system.tips(crossing.q0))
    np.testing.assert_allclose(crossing.circles.at(0.0)[1], 0.0)


def test_no_step_of_an_undisturbed_run_has_a_row_of_noise():
    assert UNDISTURBED.shape == (0, 0)
