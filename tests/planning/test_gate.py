"""One gate before any method: each way in which a start or goal can be wrong, told at once."""

import pickle

import numpy as np
import pytest
from own_scenes import FLOOR, LEFT, RIGHT, both, written

from dualarm_repro.errors import DataFileError, InputError
from dualarm_repro.planning import load_tasks, plan_file
from dualarm_repro.planning.faults import MOST_TOLD, TaskFaults
from dualarm_repro.planning.gate import require_sound
from dualarm_repro.scene import distances

UP = "[0, 0, 0, 0, 0, 0]"
ASIDE = '["90 deg", 0, 0, 0, 0, 0]'
INWARD = '[0, "60 deg", -0.5, 0, 0, 0]'


def lines(folder, text, **how):
    given = load_tasks(written(folder, text))
    with pytest.raises(TaskFaults) as caught:
        require_sound(given.path, given.scene, given.starts, given.goals, **how)
    assert len(str(caught.value).splitlines()) == len(caught.value.lines)
    return caught.value.lines


def test_goals_inside_each_other_when_all_have_arrived(tmp_path):
    """Mirror images: the forearm cores cross, so -2 x 0.055 m. Each goal alone is free."""
    ends = f"start: {ASIDE}, goal: {INWARD}"
    told = lines(tmp_path, both(ends, ends))
    assert len(told) == 1
    assert "goal = " in told[0]
    assert "at a distance of -0.11 m" in told[0]
    for k, kept in enumerate(("left", "right")):
        alone = [ends, ends]
        alone[1 - k] = f"start: {ASIDE}, goal: {UP}"
        given = load_tasks(written(tmp_path, both(*alone)))
        require_sound(given.path, given.scene, given.starts, given.goals)
        assert kept in given.tasks


def test_a_goal_below_the_floor(tmp_path):
    left = f'start: {ASIDE}, goal: ["90 deg", "105 deg", 0, 0, 0, 0]'
    told = lines(tmp_path, both(left, f"start: {ASIDE}, goal: {UP}", FLOOR))
    assert len(told) == 1
    assert "left/capsule" in told[0]
    assert "and floor apart, not at a distance of -0.19" in told[0]


def test_all_faults_at_once_one_line_each(tmp_path):
    """Limits of two joints, a start in a ball, a goal below the floor, a parked arm beyond one."""
    left = 'start: ["175 deg", 0, 0, 0, 0, 0], goal: ["90 deg", "105 deg", 0, 0, 0, "500 deg"]'
    rest = FLOOR + "obstacles: {ball: {kind: sphere, center: [-0.4, 0, 0.5], radius: 0.1}}\n"
    told = lines(tmp_path, both(left, 'start: [0, 0, "80 deg", 0, 0, 0]', rest))
    for part in (
        "left.start: joint_1 = 3.05",
        "left.goal: joint_6 = 8.72",
        "right.start: joint_3 = 1.39",
        "and ball apart",
        "and floor apart",
    ):
        assert sum(part in line for line in told) == 1, part
    assert all(line.startswith(str(tmp_path / "cell.yaml")) for line in told)
    assert not any("\n" in line for line in told)


def test_an_arm_that_folds_into_itself_at_its_goal(tmp_path):
    """Of the corners of its joint range some put the wrist of a Panda into its foot."""
    text = "arms: {only: {robot: panda, start: [0, -0.3, 0, -1.8, 0, 1.5, 0], goal: %s}}"
    given = load_tasks(written(tmp_path, text % "[0, 0, 0, -1.8, 0, 1.5, 0]"))
    arm = given.scene.arms[0].arm
    q = arm.random_configurations(200, np.random.default_rng(0))
    found = distances(given.scene, q)
    worst = q[found.min(axis=1).argmin()]
    assert found.min() < 0.0
    told = lines(tmp_path, text % worst.tolist())
    assert len(told) == 1
    assert told[0].count("only/") == 2


def test_bodies_that_stand_on_something_are_told_with_their_exemption(tmp_path):
    ends = f'start: {ASIDE}, goal: ["70 deg", 0, 0, 0, 0, 0]'
    told = lines(tmp_path, both(ends, ends, "floor: 0.2\n"))
    assert len(told) == 2
    for arm in ("left", "right"):
        wanted = f"`exempt: [[{arm}/capsule_1_joint_1, floor]]`"
        assert sum(wanted in line for line in told) == 1
    rest = (
        "floor: 0.2\nexempt: [[left/capsule_1_joint_1, floor], [right/capsule_1_joint_1, floor]]\n"
    )
    given = load_tasks(written(tmp_path, both(ends, ends, rest)))
    require_sound(given.path, given.scene, given.starts, given.goals)


def test_collisions_are_let_pass_only_when_asked_and_limits_never(tmp_path):
    left = f"start: {ASIDE}, goal: {INWARD}"
    given = load_tasks(written(tmp_path, both(left, left)))
    require_sound(given.path, given.scene, given.starts, given.goals, allow_collision=True)
    beyond = left.replace('"60 deg"', '"160 deg"')
    told = lines(tmp_path, both(beyond, f"start: {ASIDE}"), allow_collision=True)
    assert "left.goal: joint_2" in told[0]


def test_a_parked_arm_is_looked_at(tmp_path):
    at = f"arms:\n  {LEFT.replace('-60 deg', '0 deg')}\n  {RIGHT}\n"
    told = lines(tmp_path, at)
    assert any("left/" in line and "right/" in line for line in told)


def test_an_arm_without_any_posture_is_refused(tmp_path):
    bare = RIGHT[: RIGHT.index(", start")] + "}"
    with pytest.raises(DataFileError, match=r"arms\.right\.start = None: expected where the arm"):
        load_tasks(written(tmp_path, f"arms:\n  {LEFT}\n  {bare}\n"))
    written(tmp_path, f"arms:\n  {LEFT}\n  {bare}\n")
    text = "scene: cell.yaml\ntasks: {left: {}}\nparked: {right: [0, 0, 0, 0, 0, 0]}\n"
    given = load_tasks(written(tmp_path, text, "tasks.yaml"))
    assert given.parked["right"] == pytest.approx(np.zeros(6))
    with pytest.raises(TaskFaults, match="an arm without a task"):
        load_tasks(written(tmp_path, text.replace("right:", "left:"), "tasks.yaml"))


def test_faults_of_several_arms_are_read_at_once(tmp_path):
    far = "start: [0, 0, 0, 0, 0, 0], goal: {position: [0, 0, 9]}"
    with pytest.raises(TaskFaults) as caught:
        load_tasks(written(tmp_path, both(far, far)))
    assert [line.count("out of reach by") for line in caught.value.lines] == [1, 1]


def test_every_method_passes_the_gate(tmp_path):
    ends = f"start: {ASIDE}, goal: {INWARD}"
    path = written(tmp_path, both(ends, ends))
    for name in ("apf-improved", "apf-bidirectional", "attraction-only"):
        with pytest.raises(TaskFaults):
            plan_file(path, name)


def test_faults_travel_between_processes():
    faults = TaskFaults([DataFileError("f", str(k), k, "less") for k in range(MOST_TOLD + 3)])
    again = pickle.loads(pickle.dumps(faults))
    assert again.lines == faults.lines
    assert again.lines[-1] == "f: 3 more of the kind"
    assert (again.source, again.field, again.value) == ("f", "0", 0)


LIFT = """<robot name="lift"><link name="foot"><collision><geometry><box size="0.6 0.4 0.1"/>
</geometry></collision></link><link name="l1"><collision><origin xyz="0 0 0.2"/><geometry>
<box size="0.6 0.4 0.02"/></geometry></collision></link><link name="l2"><collision>
<origin xyz="0 0 0.4"/><geometry><sphere radius="0.05"/></geometry></collision></link>
<joint name="up" type="prismatic"><parent link="foot"/><child link="l1"/><axis xyz="0 0 1"/>
<limit lower="0" upper="0.4" velocity="1" effort="1"/></joint>
<joint name="turn" type="continuous"><parent link="l1"/><child link="l2"/><axis xyz="0 0 1"/>
<limit velocity="1" effort="1"/></joint></robot>"""


def lift(folder, start, goal, rest=""):
    (folder / "lift.urdf").write_text(LIFT, encoding="utf-8")
    return f"arms: {{lift: {{robot: lift.urdf, start: {start}, goal: {goal}}}}}\n{rest}"


def test_limits_of_a_lift_are_metres_and_what_turns_for_ever_has_none(tmp_path):
    told = lines(tmp_path, lift(tmp_path, "[0.1, 40]", "[0.5, -70]"))
    assert len(told) == 1
    assert told[0].endswith("lift.goal: up = 0.5: expected 0 to 0.4 m")


def test_the_goal_of_what_turns_for_ever_is_the_near_one(tmp_path):
    """From 3 to -3 rad by 0.28, whatever the number of turns in the file."""
    text = lift(tmp_path, "[0.1, 3.0]", "[0.3, -3.0]")
    task = load_tasks(written(tmp_path, text)).tasks["lift"]
    assert task.goal == pytest.approx([0.3, 2 * np.pi - 3.0], abs=1e-14)
    assert task.goal[0] == 0.3
    text = lift(tmp_path, "[0.1, 40.0]", "[0.3, 0.0]")
    assert load_tasks(written(tmp_path, text)).tasks["lift"].goal[1] == pytest.approx(12 * np.pi)


def test_a_mounting_is_one_line_for_all_capsules_of_a_shape(tmp_path):
    """The lowest plate of a lift, fitted by several capsules, stands in a block."""
    block = "obstacles: {block: {kind: box, center: [0, 0, 0.4], size: [1, 1, 0.6]}}\n"
    text = lift(tmp_path, "[0.1, 0]", "[0.2, 0]", block)
    told = lines(tmp_path, text)
    mounts = [line for line in told if "mounting = " in line]
    assert len(mounts) == 1
    assert "`exempt: [[lift/l1_0, block]]`" in mounts[0]
    cured = text + "exempt: [[lift/l1_0, block], [lift/l2, block]]\n"
    given = load_tasks(written(tmp_path, cured))
    require_sound(given.path, given.scene, given.starts, given.goals)


@pytest.mark.parametrize("source", [np.nan, None, 3])
def test_the_source_that_is_named_is_a_file(tmp_path, source):
    rest = f"start: {UP}, goal: {UP}"
    given = load_tasks(written(tmp_path, both(rest, rest)))
    with pytest.raises(InputError, match=r"require_sound: source = .*a path, or text"):
        require_sound(source, given.scene, given.starts, given.goals)
