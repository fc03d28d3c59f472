"""Task files and the planners by name: a user's own arms from YAML to plans."""

import numpy as np
import pytest

from dualarm_repro.arms import load_arm
from dualarm_repro.errors import DataFileError, DualArmError, InputError, UnknownNameError
from dualarm_repro.planning import (
    METHODS,
    APFSettings,
    FollowReason,
    StopReason,
    load_tasks,
    method,
    plan_file,
    settings_schema,
)
from dualarm_repro.planning.defaults import default_settings
from dualarm_repro.planning.field.control_points import end_effector
from dualarm_repro.planning.search.bidirectional_arms import TwoArmSettings
from dualarm_repro.scene import load_scene

SCENE = """\
arms:
  left: {robot: irb120, xyz: [0.35, 0, 0], rpy: [0, 0, "pi/2"]}
  right:
    robot: irb120
    xyz: [-0.35, 0, 0]
    rpy: [0, 0, "pi/2"]
    start: [0, 0, 0, 0, 0, 0]
    goal: [-0.8, 0.3, 0.1, 0, 0.5, 0]
obstacles:
  ball: {kind: sphere, center: [0.05, 0.55, 0.35], radius: 0.05}
"""
TASKS = """\
scene: cell.yaml
tasks:
  left: {start: [0, 0, 0, 0, 0, 0], goal: {position: [0.05, 0.3, 0.55], tool: radial}}
  right: {goal: ["-pi/4", "10 deg", 0, 0, 0.5, 0]}
"""
SETTINGS = """\
settings:
  attraction: {gain: 1.0, joint_weight: 0.1}
  control_points: [3, 5, 7]
  repulsion: {gain: 1.0e-4, influence: 0.05}
  update: {rule: gradient, gain: 0.5, max_step: 0.03}
  termination:
    joint_tolerance: 0.01
    position_tolerance: 0.005
    step_limit: 2000
    trap: {rule: block_means, steps: 50, threshold: 1.0e-3}
"""
SEARCH_SETTINGS = """\
settings:
  attraction: {gain: 1.0, threshold: 0.4}
  repulsion: {gain: 1.0e-4, influence: 0.1}
  control_points: [3, 5, 7]
  step: {length: 0.05}
  ending: {tolerance: 0.06, search_limit: 300, stuck_searches: 50}
  hull_radius: 0.06
"""
APF = [name for name, method in METHODS.items() if method.settings is APFSettings]


@pytest.fixture
def write(tmp_path):
    (tmp_path / "cell.yaml").write_text(SCENE, encoding="utf-8")

    def task_file(text):
        path = tmp_path / "task.yaml"
        path.write_text(text, encoding="utf-8")
        return path

    return task_file


def parked(path):
    """The scene file beside a task file, with a place where its left arm is parked."""
    cell = path.with_name("parked.yaml")
    left = 'rpy: [0, 0, "pi/2"], start: [0, 0, 0, 0, 0, 0]}'
    cell.write_text(SCENE.replace('rpy: [0, 0, "pi/2"]}', left, 1), encoding="utf-8")
    return cell


def test_positions_become_joints_and_gaps_are_filled_from_the_scene(write):
    given = load_tasks(write(TASKS))
    assert list(given.tasks) == ["left", "right"]
    assert given.settings["left"] == default_settings(given.scene.arms[0].arm)
    left = next(placed for placed in given.scene.arms if placed.name == "left")
    assert end_effector(left, given.tasks["left"].goal) == pytest.approx([0.05, 0.3, 0.55])
    assert given.tasks["right"].start == pytest.approx(np.zeros(6))
    assert given.tasks["right"].goal[:2] == pytest.approx([-np.pi / 4, np.pi / 18])


def test_a_position_alone_is_enough(write):
    text = TASKS.replace(", tool: radial", "")
    given = load_tasks(write(text))
    left = given.scene.arms[0]
    assert end_effector(left, given.tasks["left"].goal) == pytest.approx(
        [0.05, 0.3, 0.55], abs=1e-6
    )


def test_a_scene_file_with_start_and_goal_is_enough(write):
    given = load_tasks(parked(write(TASKS)))
    assert list(given.tasks) == ["right"]
    assert given.parked["left"] == pytest.approx(np.zeros(6))
    assert set(given.starts) == set(given.goals) == {"left", "right"}


@pytest.mark.parametrize("name", METHODS)
@pytest.mark.parametrize("given", [False, True])
def test_every_method_runs_a_users_own_scene(write, name, given):
    family = SEARCH_SETTINGS if METHODS[name].settings is TwoArmSettings else SETTINGS
    result = plan_file(write(TASKS + family * given), name)
    assert set(result.plans) == {"left", "right"}
    for plan in result.plans.values():
        assert plan.reason in {*StopReason, *FollowReason}
        assert plan.reached == (plan.certificate is None)
    assert np.isfinite(result.links(0.05).minimum)
    assert len({len(path.index) for path in result.paths.values()}) == 1 or name in APF
    if name == "attraction-only":
        assert all(plan.reached and not plan.repulsive.any() for plan in result.plans.values())


def test_methods_differ_in_what_they_are_named_after():
    base = default_settings(load_arm("irb120"))
    improved, traditional, points, alone = (
        METHODS[name].adapted(base)
        for name in ("apf-improved", "apf-traditional", "apf-traditional-points", "attraction-only")
    )
    assert improved == base
    assert improved.attraction.joint_weight > 0
    assert traditional.control_points == "end_effector"
    assert points.control_points == base.control_points
    for settings in (traditional, points):
        assert settings.attraction.joint_weight == 0.0
        assert settings.virtual_point is None
        assert settings.termination.joint_tolerance is None
    assert alone.repulsion is None


def test_default_settings_scale_with_the_arm():
    """Everything with a length in it follows the reach: an arm of twice the size plans alike."""
    sizes = [default_settings(load_arm(name)) for name in ("irb120", "es165d")]
    reach = [
        np.linalg.norm(load_arm(n).chain.translation[1:], axis=1).sum()
        for n in ("irb120", "es165d")
    ]
    ratio = reach[1] / reach[0]
    assert sizes[1].repulsion.influence == pytest.approx(ratio * sizes[0].repulsion.influence)
    assert sizes[1].repulsion.gain == pytest.approx(ratio**4 * sizes[0].repulsion.gain)
    assert sizes[1].attraction.joint_weight == pytest.approx(
        ratio**2 * sizes[0].attraction.joint_weight
    )
    assert sizes[1].update.gain == pytest.approx(sizes[0].update.gain / ratio**2)


def test_schema_of_a_method_lists_its_settings():
    schema = settings_schema("apf-improved")
    assert {"attraction", "repulsion", "update", "termination"} <= set(schema["properties"])
    assert "d_0 [m]" in str(schema)


def test_unknown_method():
    with pytest.raises(UnknownNameError, match="one of apf-improved, apf-traditional"):
        method("apf")


@pytest.mark.parametrize(
    ("old", "new", "field", "expected"),
    [
        (
            "position: [0.05, 0.3, 0.55]",
            "position: [0.05, 1.3, 0.55]",
            "tasks.left.goal: position",
            "out of reach by",
        ),
        (
            "[0, 0, 0, 0, 0, 0], goal",
            "[0, 0, .nan, 0, 0, 0], goal",
            "tasks.left.start",
            "a number in radians",
        ),
        ("[0, 0, 0, 0, 0, 0], goal", "[0, 0, 0], goal", "tasks.left.start: shape of q", "6 finite"),
        ("start: [0, 0, 0, 0, 0, 0], ", "", "tasks.left.start", "a joint vector or a position"),
        ("left:", "middle:", "tasks", "one of left, right"),
        ("gain: 1.0,", "gain: -1.0,", "settings: Attraction.gain", "greater than 0"),
        ("step_limit: 2000", "steps: 2000", "settings: Termination.steps", "fields step_limit"),
        ("scene: cell.yaml", "scene: none.yaml", "file", "a readable YAML file"),
        ("tool: radial", "tool: sideways", "tasks.left.goal", "radial"),
    ],
)
def test_a_wrong_file_names_the_field(write, old, new, field, expected):
    text = TASKS + SETTINGS
    assert old in text
    with pytest.raises(DataFileError, match=expected) as caught:
        load_tasks(write(text.replace(old, new)))
    assert caught.value.field.startswith(field)
    assert str(caught.value.source).endswith((".yaml",))


def test_no_arm_has_a_task(tmp_path):
    path = tmp_path / "idle.yaml"
    path.write_text("arms: {left: {robot: irb120}}\n", encoding="utf-8")
    with pytest.raises(DataFileError, match="an arm with start and goal"):
        load_tasks(path)


def test_links_that_collide_at_the_start_end_the_run(write):
    path = write(TASKS)
    cell = path.with_name("cell.yaml")
    cell.write_text(SCENE.replace("[0.05, 0.55, 0.35]", "[0.35, 0.0, 0.45]"), encoding="utf-8")
    assert load_scene(cell).columns
    with pytest.raises(InputError, match=r"left/.* and ball apart, not at a distance of -"):
        plan_file(path, "apf-improved")


def test_every_error_is_one_the_command_line_knows():
    assert issubclass(DataFileError, DualArmError)


@pytest.mark.parametrize("name", ["apf-bidirectional", "apf-one-sided"])
def test_both_arms_are_played_to_their_ends(write, name):
    """The slave waits or stays, so that the master arrives whatever becomes of the slave."""
    result = plan_file(write(TASKS + SEARCH_SETTINGS), name)
    left, right = result.plans.values()
    assert left.reached
    # within the ending tolerance of the settings
    assert left.path[-1] == pytest.approx(left.goal, abs=0.06)
    assert len(left.path) == len(right.path)
    steps = np.abs(np.diff(np.hstack([left.path, right.path]), axis=0)).max()
    assert steps < 0.15
    if name == "apf-bidirectional":
        assert right.path[-1] == pytest.approx(right.goal, abs=1e-4)


def test_the_search_takes_one_arm_or_two(write, tmp_path):
    alone = plan_file(parked(write(TASKS)), "apf-bidirectional")
    assert list(alone.plans) == ["right"]
    text = TASKS + "master_points: end_effector\n"
    with pytest.raises(InputError, match="master_points"):
        plan_file(write(text), "apf-bidirectional")
    task = "start: [0, 0, 0, 0, 0, 0], goal: [1, 0, 0, 0, 0, 0]"
    far = f"  far: {{robot: irb120, xyz: [3, 0, 0], {task}}}"
    third = SCENE.replace("obstacles:", far + "\nobstacles:")
    (tmp_path / "cell.yaml").write_text(third, encoding="utf-8")
    three = TASKS + "  far: {}\n"
    with pytest.raises(InputError, match="a master and a slave"):
        plan_file(write(three), "apf-bidirectional")


def test_a_point_out_of_reach_is_refused_or_approached(write):
    point = "position: [0.05, 0.3, 0.55], tool: radial"
    with pytest.raises(DataFileError, match=r"tasks.left.goal.*out of reach by 0\.\d{4} m"):
        load_tasks(write(TASKS.replace(point, "position: [0.35, 0, 1.2]")))
    near = TASKS.replace(point, "position: [0.35, 0, 1.2], best_effort: true")
    result = plan_file(write(near), "apf-bidirectional")
    missed = np.linalg.norm(end_effector(result.master.placed, result.master.goal) - [0.35, 0, 1.2])
    assert result.residuals == {"left": pytest.approx(missed)}
    with pytest.raises(DataFileError, match="best_effort without tool"):
        load_tasks(write(TASKS.replace(point, point + ", best_effort: true")))


def test_what_a_start_misses_is_not_told_of_the_goal(write):
    start = "start: {position: [0.35, 0, 1.2], best_effort: true}, goal: [0, 0, 0, 0, 0, 0]"
    text = f"scene: cell.yaml\ntasks:\n  left: {{{start}}}\n"
    assert load_tasks(write(text)).tasks["left"].residual == 0.0
