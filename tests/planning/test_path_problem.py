"""The problem a planner is given, what leaves a planner, and borders to code of somebody else."""

import pickle

import numpy as np
import pinocchio as pin
import pytest

from dualarm_repro.arms import load_arm
from dualarm_repro.errors import (
    ConfigurationError,
    DualArmError,
    InputError,
    UnknownNameError,
    UnsupportedArmError,
)
from dualarm_repro.planning import planner
from dualarm_repro.planning.arm_path import ArmPath
from dualarm_repro.planning.checks.whole_motion import require_paths
from dualarm_repro.planning.faults import MOST_TOLD, TaskFaults
from dualarm_repro.planning.foreign import asked, bordered
from dualarm_repro.planning.path_plan import ARRIVED, run_planner
from dualarm_repro.planning.planner import FoundPath, PathProblem, PlannerSettings
from dualarm_repro.planning.trials.speeds import mean_advance
from dualarm_repro.scene import JointPath, MovingShape, PlacedArm, PosePath, Scene, Sphere
from dualarm_repro.scene.clearance import distances
from dualarm_repro.scene.gradients import clearance_gradient

START, GOAL = np.zeros(12), np.full(12, 0.3)


@pytest.fixture(scope="module")
def scene():
    arm = load_arm("irb120")
    bases = [pin.SE3(np.eye(3), np.array([0.0, y, 0.0])) for y in (-0.6, 0.6)]
    arms = [PlacedArm(name, arm, base) for name, base in zip("ab", bases, strict=True)]
    return Scene(arms, {"ball": Sphere((1.5, 0.0, 0.5), 0.1)})


@pytest.fixture
def problem(scene):
    return PathProblem(scene, START, GOAL)


def test_every_distance_that_is_asked_for_counts(problem):
    q = np.full(12, 0.1)
    np.testing.assert_array_equal(problem.distances(q), distances(problem.scene, q))
    assert problem.clearance(q) == distances(problem.scene, q).min()
    found, slopes = problem.gradient(q)
    np.testing.assert_array_equal(slopes, clearance_gradient(problem.scene, q)[1])
    assert found.distance.shape == problem.distances(q).shape
    assert problem.evaluations == 4
    assert not problem.spent
    few = PathProblem(problem.scene, START, GOAL, PlannerSettings(evaluations=2))
    few.distances(q)
    assert not few.spent
    few.distances(q)
    assert few.spent


def test_the_margin_is_that_of_the_settings_or_half_of_what_the_ends_have(scene):
    least = distances(scene, np.array([START, GOAL])).min()
    assert least > 0.02
    assert PathProblem(scene, START, GOAL, PlannerSettings(margin=0.004)).margin == 0.004
    wide = PathProblem(scene, START, GOAL, PlannerSettings(margin=9.0))
    assert wide.margin == pytest.approx(0.5 * least)
    assert wide.evaluations == 0, "the ends are looked at for everybody"


@pytest.mark.parametrize(("least", "kept"), [(0.004, 0.002), (0.0, 0.0), (-0.1, 0.0)])
def test_ends_that_are_close_keep_half_of_that_and_ends_in_contact_nothing(
    scene, monkeypatch, least, kept
):
    problem = PathProblem(scene, START, GOAL, PlannerSettings(margin=9.0))
    monkeypatch.setattr(planner, "distances", lambda scene, q: np.array([[0.3, least]]))
    assert problem.margin == kept


def test_limits_reach_to_the_ends(scene):
    lower, upper = scene.limits
    beyond = upper + 0.5
    found = PathProblem(scene, START, beyond).limits
    np.testing.assert_array_equal(found[0], lower)
    np.testing.assert_array_equal(found[1], beyond)


def test_fewer_arms_have_the_rest_of_the_evaluations(problem):
    problem.evaluations = 100
    alone = problem.without({"b": START[6:]})
    assert list(alone.scene.columns) == ["a"]
    assert alone.start.tolist() == [0.0] * 6
    assert alone.goal.tolist() == [0.3] * 6
    assert alone.settings.evaluations == problem.settings.evaluations - 100
    # The other arm stands where it was said and still counts.
    q = np.full(6, 0.2)
    both = distances(problem.scene, np.concatenate([q, START[6:]])).min()
    assert alone.clearance(q) == pytest.approx(both, abs=1e-9)
    alone.at_rest("a planner")


def test_what_moves_by_itself_is_named(scene):
    path = PosePath([pin.SE3.Identity(), pin.SE3(np.eye(3), np.ones(3))], [0, 3])
    moving = {"cart": MovingShape(Sphere((3.0, 0, 0), 0.1), path)}
    made = PathProblem(Scene(scene.arms, {}, moving), START, GOAL)
    with pytest.raises(InputError, match="a planner: moving = 'cart': expected a scene in which"):
        made.at_rest("a planner")


def test_ends_of_another_length_are_refused(scene):
    with pytest.raises(ConfigurationError):
        PathProblem(scene, START[:6], GOAL)


def straight(problem):
    """From end to end."""
    return FoundPath(np.array([problem.start, problem.goal]), "reached")


def test_a_path_is_cut_to_the_arms_with_rows_close_together(problem):
    plan = run_planner("straight", straight, problem)
    assert set(plan.plans) == {"a", "b"}
    for name, part in plan.plans.items():
        assert part.reached
        assert np.abs(np.diff(part.path, axis=0)).max() <= 0.02 + 1e-12
        np.testing.assert_allclose(part.path[[0, -1]], [np.zeros(6), np.full(6, 0.3)])
        np.testing.assert_array_equal(plan.paths[name].configurations, part.path)
        assert part.length == pytest.approx(0.3 * np.sqrt(6))
        assert part.certificate is None
        assert part.outside_limits == ()
        assert list(part.to_frame().columns) == ["q1", "q2", "q3", "q4", "q5", "q6", "x", "y", "z"]


@pytest.mark.parametrize(
    ("off", "claim", "reached"),
    [(0.5 * ARRIVED, "reached", True), (2 * ARRIVED, "reached", False), (0.0, "stuck", False)],
)
def test_an_arm_has_arrived_if_it_is_there_and_the_planner_says_so(problem, off, claim, reached):
    def planner(given):
        end = given.goal.copy()
        end[7] += off
        return FoundPath(np.array([given.start, end]), claim)

    plans = run_planner("nearly", planner, problem).plans
    assert plans["b"].reached is reached
    assert plans["a"].reached is (claim == "reached")
    assert plans["a"].reason == claim


@pytest.mark.parametrize(
    ("answer", "line"),
    [
        (lambda p: None, "planner odd: answer = 'NoneType': expected a FoundPath"),
        (lambda p: FoundPath(np.array([p.goal]), "reached"), "planner odd: path = .*begin at the"),
        (lambda p: FoundPath(np.zeros(12), "reached"), r"planner odd: FoundPath: path .*\(N, nq\)"),
        (lambda p: FoundPath(np.zeros((2, 5)), "reached"), "planner odd"),
        (lambda p: 1 / 0, r"planner odd: method = 'odd'.*ZeroDivisionError: division by zero"),
        (lambda p: (_ for _ in ()).throw(SystemExit(3)), "planner odd.*SystemExit: 3"),
        (lambda p: p.nothing, "planner odd.*AttributeError"),
    ],
)
def test_what_is_no_answer_becomes_one_line(problem, answer, line):
    with pytest.raises(InputError, match=line) as caught:
        run_planner("odd", answer, problem)
    assert "\n" not in str(caught.value)


def test_a_planner_is_given_a_copy_and_only_its_count_comes_back(problem):
    def vandal(given):
        given.distances(given.start)
        given.goal[:] = 9.0
        given.start[:] = 9.0
        given.settings = None
        return FoundPath(np.array([START, GOAL]), "reached")

    found = asked("vandal", vandal, problem)
    assert found.claimed
    assert problem.evaluations == 1
    np.testing.assert_array_equal(problem.goal, GOAL)
    np.testing.assert_array_equal(problem.start, START)
    assert problem.settings == PlannerSettings()


def test_errors_keep_their_kind_across_the_border(capsys):
    kinds = [
        (UnsupportedArmError("no wrist"), UnsupportedArmError, "there: no wrist"),
        (InputError("file", "a", 1, "two"), InputError, "there: file: a = 1: expected two"),
        (DualArmError("odd"), DualArmError, "there: odd"),
        (ValueError("two\nlines"), InputError, r"expected one \(ValueError: two lines\)"),
    ]
    for raised, kind, line in kinds:
        with pytest.raises(kind, match=line), bordered("there", "field", 1, "one"):
            raise raised
    with pytest.raises(KeyboardInterrupt), bordered("there", "field", 1, "one"):
        raise KeyboardInterrupt
    with bordered("there", "field", 1, "one"):
        print("chatter of somebody else")
    shown = capsys.readouterr()
    assert shown.out == ""
    assert "chatter" in shown.err


def faults(count):
    return TaskFaults([InputError("file", f"field {k}", k, "less") for k in range(count)])


@pytest.mark.parametrize("count", [1, MOST_TOLD, MOST_TOLD + 3])
def test_faults_are_told_line_by_line_and_the_rest_counted(count):
    found = faults(count)
    assert len(found.lines) == min(count, MOST_TOLD) + (count > MOST_TOLD)
    assert found.lines[0] == "file: field 0 = 0: expected less"
    assert (found.field, found.value) == ("field 0", 0)
    if count > MOST_TOLD:
        assert found.lines[-1] == f"file: {count - MOST_TOLD} more of the kind"
    assert str(found).split("\n") == found.lines
    again = pickle.loads(pickle.dumps(found))
    assert again.lines == found.lines


def test_a_motion_of_all_arms_has_a_path_of_each(scene):
    path = JointPath(np.zeros((2, 6)))
    require_paths("here", scene, {"a": path, "b": path})
    for given, kind, line in (
        ({"a": path}, UnknownNameError, r"here: paths = \['a'\]: expected paths of all of a, b"),
        ({"a": path, "b": path, "c": path}, UnknownNameError, "paths"),
        ({"a": path, "b": np.zeros((2, 6))}, InputError, "here: path of b = .*a JointPath"),
        ([path, path], InputError, "here: paths = .*a mapping of arm"),
    ):
        with pytest.raises(kind, match=line):
            require_paths("here", scene, given)


def test_lengths_of_a_path_by_hand(scene):
    made = ArmPath()
    made.placed, made.path = scene.arms[0], np.array([[0.0] * 6, [0.3] + [0.0] * 5, [0.3] * 6])
    assert made.steps == 2
    assert made.length == pytest.approx(0.3 + 0.3 * np.sqrt(5))
    # The first joint turns the flange about the axis of the base.
    radius = np.hypot(*load_arm("irb120").positions(np.zeros(6))[:2])
    first = 2 * radius * np.sin(0.15)
    assert np.linalg.norm(made.tcp[1] - made.tcp[0]) == pytest.approx(first)
    assert made.tcp_length == pytest.approx(first + np.linalg.norm(made.tcp[2] - made.tcp[1]))
    np.testing.assert_array_equal(made.columns()["q1"], [0.0, 0.3, 0.3])


def test_mean_advance_is_the_length_over_the_last_instant():
    track = np.array([[0.0, 0, 0], [3.0, 4.0, 0], [3.0, 4.0, 1.0]])
    assert mean_advance(track, np.array([0.0, 1.0, 4.0])) == pytest.approx(1.5)


@pytest.mark.parametrize("path", [np.zeros(12), np.empty((0, 12)), np.zeros((2, 12, 1)), 0.0])
def test_a_path_has_rows(path):
    line = r"FoundPath: path \(its shape\) = .*finite numbers \(N, nq\), not empty"
    with pytest.raises(InputError, match=line):
        FoundPath(path, "reached")


def test_what_moves_is_where_it_is_at_the_start_unless_a_time_is_given():
    ways = [pin.SE3(np.eye(3), np.array([x, 0.5, 0.3])) for x in (-1.0, 1.0)]
    ball = MovingShape(Sphere(np.zeros(3), 0.05), PosePath(ways, [0.0, 1.0]))
    arm, q = PlacedArm("arm", load_arm("irb120")), np.zeros(6)
    problem = PathProblem(Scene([arm], moving={"ball": ball}, self_collision=False), q, q)
    at_start = problem.clearance(q, 0.0)
    assert problem.clearance(q) == at_start
    assert problem.clearance(q, 0.01) < at_start - 0.01
