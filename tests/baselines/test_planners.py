"""Every baseline on tasks whose answer is known, judged by all bodies."""

import sys

import numpy as np
import pinocchio as pin
import pytest
from crossing_pair import BLOCKED, FREE, written

from dualarm_repro.arms import load_arm
from dualarm_repro.baselines import BASELINES
from dualarm_repro.errors import DualArmError, InputError
from dualarm_repro.planning import FoundPath, PathProblem, PlannerSettings, truth
from dualarm_repro.planning.path_plan import run_planner
from dualarm_repro.planning.planner import FARTHEST
from dualarm_repro.planning.tasks.task_file import load_tasks
from dualarm_repro.scene import MovingShape, PlacedArm, PosePath, Scene, Sphere, distances
from dualarm_repro.settings import Settings

PACKAGES = {
    "cbf-qp": "pink",
    "trajectory-optimisation": "crocoddyl",
    "rrt-connect": "ompl",
    "rrt-connect-simplified": "ompl",
    "rrt-connect-in-turn": "ompl",
    "bit-star": "ompl",
}


def problem_of(folder, text, **settings):
    given = load_tasks(written(folder, text), Settings)
    ends = (given.scene.stack(**given.starts), given.scene.stack(**given.goals))
    return PathProblem(given.scene, *ends, PlannerSettings(**settings))


def judged(name, problem):
    if name in PACKAGES:
        pytest.importorskip(PACKAGES[name])
    plan = run_planner(name, BASELINES[name], problem)
    return plan, truth(problem.scene, plan.paths)


@pytest.mark.parametrize("name", BASELINES)
def test_baseline_does_a_task_that_is_free(name, tmp_path):
    """It begins at the start, ends at the goal, is certified free and counts what it asks."""
    problem = problem_of(tmp_path, FREE, evaluations=4000)
    plan, found = judged(name, problem)
    assert all(one.reached for one in plan.plans.values())
    assert found.collision_free
    assert found.within_limits
    path = np.hstack([one.path for one in plan.plans.values()])
    np.testing.assert_allclose(path[0], problem.start, atol=1e-12)
    np.testing.assert_allclose(path[-1], problem.goal, atol=1e-3)
    assert 0 < problem.evaluations <= 6000  # a sweep that has begun is finished


_LINK = (
    '<link name="{0}"><collision><origin xyz="0 0 0.1"/><geometry><box size="0.02 0.02 0.1"/>'
    "</geometry></collision></link>"
)
_JOINT = (
    '<joint name="{0}" type="revolute"><parent link="{1}"/><child link="{2}"/>'
    '<origin xyz="0 0 0.2"/><axis xyz="0 1 0"/>'
    '<limit lower="-{3}" upper="{3}" effort="1" velocity="1"/></joint>'
)


@pytest.mark.parametrize("reach", ["0.002", "1e16"])
@pytest.mark.parametrize("name", BASELINES)
def test_an_arm_whose_limits_are_narrower_than_the_resolution_or_as_good_as_none(
    name, reach, tmp_path
):
    links = "".join(map(_LINK.format, "abc"))
    joints = _JOINT.format("j1", "a", "b", reach) + _JOINT.format("j2", "b", "c", reach)
    (tmp_path / "stiff.urdf").write_text(f'<robot name="stiff">{links}{joints}</robot>')
    scene = "arms: {only: {robot: stiff.urdf, start: [0.001, -0.001], goal: [-0.001, 0.002]}}"
    problem = problem_of(tmp_path, scene, evaluations=400)
    assert np.ptp(problem.limits, axis=0).max() < 60.0
    plan, found = judged(name, problem)
    assert all(one.reached for one in plan.plans.values())
    assert found.collision_free


def test_ends_too_far_apart_for_ompl_are_refused(tmp_path):
    pytest.importorskip("ompl")
    links = "".join(map(_LINK.format, "abc"))
    joints = _JOINT.format("j1", "a", "b", "1e16") + _JOINT.format("j2", "b", "c", "1e16")
    (tmp_path / "stiff.urdf").write_text(f'<robot name="stiff">{links}{joints}</robot>')
    given = problem_of(tmp_path, "arms: {only: {robot: stiff.urdf, start: [0, 0], goal: [1, 0]}}")
    problem = PathProblem(given.scene, given.start, np.array([1e15, 0.0]), given.settings)
    with pytest.raises(InputError, match=r"range of the joints.*at most 1e\+09"):
        BASELINES["rrt-connect"](problem)


@pytest.mark.parametrize(
    "name", ["rrt-connect", "rrt-connect-simplified", "rrt-connect-compiled", "cbf-qp"]
)
def test_same_seed_same_path(name, tmp_path):
    """Also after other runs in the same process."""
    first, _ = judged(name, problem_of(tmp_path, BLOCKED, seed=3, evaluations=4000))
    judged(name, problem_of(tmp_path, FREE, seed=5, evaluations=500))
    again, _ = judged(name, problem_of(tmp_path, BLOCKED, seed=3, evaluations=4000))
    for arm, one in first.plans.items():
        np.testing.assert_array_equal(one.path, again.plans[arm].path)


@pytest.mark.parametrize("name", BASELINES)
def test_claim_and_truth_agree_or_the_truth_says_no(name, tmp_path):
    """The straight line of both collides; whoever arrives is judged by all bodies."""
    problem = problem_of(tmp_path, BLOCKED, evaluations=4000)
    plan, found = judged(name, problem)
    if name in ("rrt-connect", "rrt-connect-simplified", "rrt-connect-compiled"):
        assert all(one.reached for one in plan.plans.values())
    if name in ("mutual-avoidance-qp", "cbf-qp"):  # they yield rather than touch
        assert found.collision_free
    if not all(one.reached for one in plan.plans.values()):
        assert plan.master.reason != "reached"


def test_simplified_path_is_shorter(tmp_path):
    long, short = (
        judged(name, problem_of(tmp_path, BLOCKED, seed=1, evaluations=8000))[0]
        for name in ("rrt-connect", "rrt-connect-simplified")
    )
    length = [sum(one.length for one in plan.plans.values()) for plan in (long, short)]
    assert length[1] < length[0]


COMPILED = ["rrt-connect-compiled", "rrt-connect-compiled-in-turn"]


@pytest.mark.parametrize("name", [*sorted(PACKAGES), *COMPILED])
def test_obstacle_that_moves_by_itself_is_refused_by_name(name, tmp_path):
    if name in PACKAGES:
        pytest.importorskip(PACKAGES[name])
    problem = problem_of(tmp_path, FREE)
    track = PosePath([pin.SE3.Identity()] * 2, [0.0, 9.0])
    ball = MovingShape(Sphere([0.0, 0.0, 2.0], 0.1), track)
    scene = problem.scene
    problem.scene = type(scene)(scene.arms, moving={"ball": ball})
    with pytest.raises(InputError, match="ball"):
        run_planner(name, BASELINES[name], problem)


@pytest.mark.parametrize(
    ("answer", "told"),
    [
        (lambda problem: 1 / 0, "ZeroDivisionError"),
        (lambda problem: None, "NoneType"),
        (lambda problem: FoundPath(problem.start, "reached"), "path"),
        (lambda problem: FoundPath(problem.goal[None], "reached"), "begin at the start"),
        (lambda problem: FoundPath(problem.start[None] * np.nan, "reached"), "finite"),
        (lambda problem: sys.exit("enough"), "planner theirs: method = .*SystemExit: enough"),
        (lambda problem: next(_ending(BaseException("a"))), "BaseException: a"),
        (lambda problem: problem.scene.stack(nobody=1), "planner theirs: scene: arms"),
    ],
)
def test_planner_of_somebody_else_cannot_hurt(answer, told, tmp_path):
    """Whatever it raises or answers becomes one line of the library."""
    with pytest.raises(DualArmError, match=told) as caught:
        run_planner("theirs", answer, problem_of(tmp_path, FREE))
    assert "\n" not in str(caught.value)


def _ending(error):
    raise error
    yield


def test_interruption_of_the_user_goes_through_a_planner(tmp_path):
    with pytest.raises(KeyboardInterrupt):
        run_planner(
            "theirs", lambda p: next(_ending(KeyboardInterrupt())), problem_of(tmp_path, FREE)
        )


def _cheating(problem):
    """Claims to have arrived where it stands, after moving everything that could tell."""
    problem.goal[:] = problem.start
    problem.scene.arms[0].arm.lower[:] = -1e9
    problem.scene.bodies.radius[:] = 0.0
    problem.scene.obstacles.clear()
    problem.scene.arms.pop()
    problem.evaluations = 17
    print("I print where the JSON goes")
    return FoundPath(problem.start[np.newaxis], "reached")


def test_planner_writes_into_its_own_copy_only(tmp_path, capsys):
    problem = problem_of(tmp_path, BLOCKED)
    scene, before = problem.scene, (problem.start.copy(), problem.goal.copy())
    known = (scene.arms[0].arm.lower.copy(), scene.bodies.radius.copy(), len(scene.arms))
    plan = run_planner("theirs", _cheating, problem)
    assert not any(one.reached for one in plan.plans.values())
    for kept, now in zip(before, (problem.start, problem.goal), strict=True):
        np.testing.assert_array_equal(kept, now)
    np.testing.assert_array_equal(known[0], scene.arms[0].arm.lower)
    np.testing.assert_array_equal(known[1], scene.bodies.radius)
    assert (len(scene.arms), problem.evaluations) == (known[2], 17)
    assert capsys.readouterr().out == ""


def test_answer_is_a_copy_too(tmp_path):
    kept = []

    def planner(problem):
        kept.append(np.array([problem.start, problem.goal]))
        return FoundPath(kept[0], "reached")

    plan = run_planner("theirs", planner, problem_of(tmp_path, FREE))
    ends = plan.master.path[-1].copy()
    kept[0][:] = 0.0
    np.testing.assert_array_equal(plan.master.path[-1], ends)


def test_margin_is_half_of_what_the_ends_have(tmp_path):
    problem = problem_of(tmp_path, FREE, margin=0.005)
    assert problem.margin == 0.005
    wide = problem_of(tmp_path, FREE, margin=10.0)
    least = distances(wide.scene, np.array([wide.start, wide.goal])).min()
    assert wide.margin == pytest.approx(0.5 * least)


def test_bounds_of_a_search_hold_its_ends_and_are_finite():
    """A joint that turns for ever is searched over two turns, or as far as an end lies, and none
    farther from its ends than FARTHEST."""
    scene = Scene([PlacedArm("arm", load_arm("kinova-j2s6s200"))])
    arm = scene.arms[0].arm
    start = np.array([40.0, 2.9, 1.3, 0.0, 1.4, 0.0])
    problem = PathProblem(scene, start, start + 0.1)
    lower, upper = problem.limits
    assert np.isfinite([lower, upper]).all()
    assert (lower[0], upper[0]) == (40.0 - FARTHEST, 40.1)
    assert (lower[3], upper[3]) == (-2 * np.pi, 2 * np.pi)
    still = ~arm.turns_for_ever
    assert lower[still].tolist() == arm.lower[still].tolist()
    assert upper[still].tolist() == arm.upper[still].tolist()
