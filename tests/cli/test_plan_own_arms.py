"""`dualarm plan` on arms that people own, each plan judged again by full geometry.

What is reported must never be better than what Pinocchio and coal find on the collision shapes of
the URDF along the written rows.
"""

import json
from pathlib import Path

import coal
import numpy as np
import pandas as pd
import pinocchio as pin
import pytest
from example_robot_data import getModelPath
from full_geometry import Replay
from long_tests import long_where

#: The documents of a URDF may differ from it in rounding only [m].
ROUNDING = 1e-6
LIFT = """<robot name="lift">
<link name="column"><collision><origin xyz="0 0 0.4"/><geometry><box size="0.15 0.15 0.8"/>
</geometry></collision></link>
<link name="carriage"><collision><origin xyz="0.15 0 0"/><geometry><box size="0.1 0.2 0.1"/>
</geometry></collision></link>
<link name="upper"><collision><origin xyz="0.2 0 0" rpy="0 1.5708 0"/><geometry>
<cylinder radius="0.05" length="0.3"/></geometry></collision></link>
<link name="fore"><collision><origin xyz="0.2 0 0" rpy="0 1.5708 0"/><geometry>
<capsule radius="0.04" length="0.3"/></geometry></collision></link>
<link name="hand"><collision><origin xyz="0.05 0 0"/><geometry><sphere radius="0.05"/>
</geometry></collision></link>
<joint name="up" type="prismatic"><parent link="column"/><child link="carriage"/>
<origin xyz="0 0 0.2"/><axis xyz="0 0 1"/><limit lower="0" upper="0.5" velocity="1" effort="9"/>
</joint>
<joint name="shoulder" type="revolute"><parent link="carriage"/><child link="upper"/>
<origin xyz="0.25 0 0"/><axis xyz="0 0 1"/><limit lower="-2" upper="2" velocity="2" effort="9"/>
</joint>
<joint name="elbow" type="continuous"><parent link="upper"/><child link="fore"/>
<origin xyz="0.4 0 0.15"/><axis xyz="0 0 1"/><limit velocity="2" effort="9"/></joint>
<joint name="wrist" type="revolute"><parent link="fore"/><child link="hand"/>
<origin xyz="0.4 0 0"/><axis xyz="0 1 0"/><limit lower="-2" upper="2" velocity="2" effort="9"/>
</joint></robot>
"""


def public(file):
    """A file of example-robot-data."""
    return str(Path(getModelPath(file)) / file)


def arm(name, robot, xyz, start, goal=None, yaw=0.0):
    """A line of a scene file."""
    turned = f"rpy: [0, 0, {yaw}], " if yaw else ""
    ends = f"start: {start}" + (f", goal: {goal}" if goal else "")
    return f"  {name}: {{robot: {json.dumps(robot)}, xyz: {xyz}, {turned}{ends}}}\n"


def facing(robot, half, start, goal, other=None, back=None):
    """An arm and another of its kind that face each other, this far from the middle."""
    left = arm("left", robot, [-half, 0, 0], start, goal)
    return left + arm("right", robot, [half, 0, 0], other or start, back or goal, yaw=np.pi)


UR5, UR10, PANDA, XARM, Z1, KINOVA = map(public, (
    "ur_description/urdf/ur5_robot.urdf",
    "ur_description/urdf/ur10_robot.urdf",
    "panda_description/urdf/panda.urdf",
    "xarm_description/urdf/xarm7.urdf",
    "z1_description/urdf/z1.urdf",
    "kinova_description/robots/kinova.urdf",
))  # fmt: skip
ASIDE, DOWN = [1.4, 0, 0, 0, 0, 0], [0.9, 0.4, -0.2, 0, 0.4, 0]
READY, TURNED = [0.9, -1.2, 1.2, -1.5, -1.5, 0], [0.5, -1.0, 1.4, -1.5, -1.5, 0]
BENT, SWUNG = [0.8, -0.3, 0, -1.8, 0, 1.5, 0], [0.4, 0.1, 0, -1.6, 0.2, 1.6, 0.4]
PARKED = arm("parked", "irb120", [0, 1.1, 0], [-1.5, 0.3, 0, 0, 0, 0])
SCENES = {
    "two irb120": ("apf-improved", facing("irb120", 0.45, ASIDE, DOWN)),
    "two ur5": ("rrt-connect-simplified", facing(UR5, 0.45, READY, TURNED)),
    "two ur10": ("mutual-avoidance-qp", facing(UR10, 0.7, READY, TURNED)),
    "two panda": ("cbf-qp", facing(PANDA, 0.55, BENT, SWUNG)),
    "xarm7 with z1": (
        "rrt-connect-in-turn",
        arm("xarm", XARM, [0, 0, 0], [0.5, 0, 0, 1, 0, 0.8, 0], [-0.4, 0.3, 0, 1.2, 0, 0.8, 0.5])
        + arm("z1", Z1, [0.95, 0, 0], [1, 0.8, -0.8, 0.2, 0, 0], [0.2, 1.2, -1.2, 0, 0.3, 0], 3.0),
    ),
    "a prismatic lift": (
        "rrt-connect-simplified",
        arm("left", "lift.urdf", [0, 0, 0], [0.1, 0.2, 3.0, 0], [0.4, 0.6, -3.0, 0.5])
        + arm("right", "irb120", [1.1, 0, 0], ASIDE, DOWN, yaw=np.pi),
    ),
    "a mirrored pair": (
        "mutual-avoidance-qp",
        arm("left", "es165d", [0, 1.3, 0], [0, -1.5, 0.1, 0, 0.3, 0], [-0.4, -1.3, 0, 0, 0.3, 0])
        + arm("right", "es165d-slave", [0, -1.3, 0], [0, 1.5, -0.1, 0, -0.3, 0],
              [0.4, 1.3, 0, 0, -0.3, 0]),
    ),
    "three arms": (
        "apf-improved",
        facing("irb120", 0.45, ASIDE, DOWN)
        + arm("third", "irb120", [0, 1.6, 0], [0, 0, 0, 0, 0, 0], [0.5, 0.2, 0, 0, 0, 0]),
    ),
    "a parked arm": ("bit-star", facing("irb120", 0.45, ASIDE, DOWN) + PARKED),
    "a mesh obstacle": (
        "mutual-avoidance-qp",
        facing("irb120", 0.45, ASIDE, DOWN)
        + "obstacles: {part: {kind: mesh, file: part.obj, xyz: [0, 0.2, 0.4]}}\n",
    ),
}  # fmt: skip

TURNING = facing(KINOVA, 0.5, [3.0, 2.9, 1.3, 3.0, 1.4, 0], [-3.0, 2.7, 1.5, -2.8, 1.4, 0.4])


def written(folder, text):
    (folder / "lift.urdf").write_text(LIFT, encoding="utf-8")
    points, faces = bracket()
    lines = [f"v {x} {y} {z}" for x, y, z in points] + [f"f {a} {b} {c}" for a, b, c in faces + 1]
    (folder / "part.obj").write_text("\n".join(lines), encoding="utf-8")
    path = folder / "cell.yaml"
    path.write_text(f"arms:\n{text}", encoding="utf-8")
    at = pin.SE3(np.eye(3), np.array([0.0, 0.2, 0.4]))
    solids = []
    if "part.obj" in text:
        made = coal.BVHModelOBBRSS()
        made.beginModel(len(faces), len(points))
        made.addSubModel(coal_points(points), coal_triangles(faces))
        made.endModel()
        solids = [(made, at)]
    return path, solids


def bracket():
    """Two bars that cross: corners (16, 3) and triangles (24, 3)."""
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    sides = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    halves = np.array([[a, b, c] for a, b, c, d in sides for a, b, c in ((a, b, c), (a, c, d))])
    bars = [corners * half for half in ([0.15, 0.025, 0.025], [0.025, 0.025, 0.15])]
    return np.concatenate(bars), np.concatenate([halves, halves + 8])


def coal_points(vertices):
    found = coal.StdVec_Vec3s()
    for vertex in vertices:
        found.append(np.asarray(vertex, dtype=float))
    return found


def coal_triangles(faces):
    found = coal.StdVec_Triangle()
    for face in faces.tolist():
        found.append(coal.Triangle(*face))
    return found


#: Kinematics of their own are compiled for these.
LONG = ("two ur5", "two ur10", "two panda", "xarm7 with z1")


@pytest.fixture(scope="module")
def known():
    """What was planned of the scenes above."""
    return {}


@pytest.fixture
def planned(dualarm, tmp_path, known):
    """A scene above planned once: its file, its meshes, its plan."""

    def plan(name):
        if name not in known:
            method, text = SCENES[name]
            path, solids = written(tmp_path, text)
            out = tmp_path / "out"
            code, _, err = dualarm("plan", path, "--method", method, "--out", out)
            assert (code, err) == (0, "")
            known[name] = path, solids, out
        return known[name]

    return plan


@pytest.mark.parametrize("name", long_where(LONG.__contains__, SCENES))
def test_plan_is_free_by_full_geometry(planned, name):
    path, solids, out = planned(name)
    summary = json.loads((out / "cell.json").read_text())
    judged_again(path, out, solids, summary)
    for name, one in summary["arms"].items():
        assert one["reached"] is True, name


def judged_again(path, out, solids, summary):
    """The report against the replay."""
    replay = Replay(path, out, solids)
    least = replay.smallest()
    assert np.isfinite(least)
    assert least >= summary["links"]["minimum_distance_m"] - ROUNDING
    if summary["links"]["collision_free"]:
        assert least > 0.0
        assert replay.touching() == set()


@pytest.mark.parametrize("count", [500, pytest.param(3000, marks=pytest.mark.long)])
def test_many_obstacles(dualarm, tmp_path, count):
    """Balls all around two arms; the report is that of those near by, and of all."""
    rng = np.random.default_rng(11)
    at = rng.uniform([-4, -4, 0.1], [4, 4, 3], (9000, 3))
    at = at[np.linalg.norm(at[:, :2], axis=1) > 1.2][:count].round(3)
    balls = "".join(
        f"  ball{k}: {{kind: sphere, center: {one.tolist()}, radius: 0.04}}\n"
        for k, one in enumerate(at)
    )
    path, _ = written(tmp_path, facing("irb120", 0.45, ASIDE, DOWN) + f"obstacles:\n{balls}")
    out = tmp_path / "out"
    code, _, err = dualarm("plan", path, "--method", "mutual-avoidance-qp", "--out", out)
    assert (code, err) == (0, "")
    summary = json.loads((out / "cell.json").read_text())
    assert len(at) == count
    judged_again(path, out, [], summary)


def test_a_plan_that_collides_is_said_to_by_both(dualarm, tmp_path):
    """Attraction alone drives the forearms of two UR5 through each other."""
    across = [-0.3, *READY[1:]]
    path, _ = written(tmp_path, facing(UR5, 0.4, [0.9, *READY[1:]], [-0.9, *across[1:]]))
    out = tmp_path / "out"
    code, told, _ = dualarm("plan", path, "--method", "attraction-only", "--out", out)
    assert code == 3
    assert "COLLISION" in told
    summary = json.loads((out / "cell.json").read_text())
    replay = Replay(path, out)
    assert summary["links"]["collision_free"] is False
    assert summary["links"]["minimum_distance_m"] - ROUNDING <= replay.smallest() <= 0.0


@pytest.mark.long(short="test_a_continuous_joint_goes_the_short_way")
def test_continuous_joints_go_the_short_way(dualarm, tmp_path):
    """From 3.0 to -3.0 rad is 0.28 rad over the back, not six the other way round."""
    path, solids = written(tmp_path, TURNING)
    out = tmp_path / "out"
    code, _, err = dualarm("plan", path, "--method", "trajectory-optimisation", "--out", out)
    assert (code, err) == (0, "")
    summary = json.loads((out / "cell.json").read_text())
    judged_again(path, out, solids, summary)
    assert all(one["reached"] is True for one in summary["arms"].values())
    for name in ("left", "right"):
        q = pd.read_csv(out / f"cell_{name}.csv")[["q1", "q4"]].to_numpy()
        short = np.array([2 * np.pi - 6.0, 2 * np.pi - 5.8])
        # a search ends within its own tolerance of the goal
        assert q[-1] - q[0] == pytest.approx(short, abs=1e-2)
        # and may sway on its way, by much less than a turn
        assert np.abs(np.diff(q, axis=0)).sum(axis=0) == pytest.approx(short, abs=0.2)
    assert dualarm("check", path, out / "cell_left.csv", out / "cell_right.csv")[0] == 0


def test_a_continuous_joint_goes_the_short_way(planned):
    """The elbow of the lift, from 3.0 to -3.0 rad."""
    _, _, out = planned("a prismatic lift")
    elbow = pd.read_csv(out / "cell_left.csv")["q3"].to_numpy()
    # a search ends within its own tolerance of the goal
    assert elbow[-1] - elbow[0] == pytest.approx(2 * np.pi - 6.0, abs=1e-2)


@pytest.mark.parametrize("method", ["apf-improved", "apf-bidirectional", "apf-whole-links"])
def test_a_method_that_knows_turning_joints_only_says_so(dualarm, tmp_path, method):
    path, _ = written(tmp_path, SCENES["a prismatic lift"][1])
    code, out, err = dualarm("plan", path, "--method", method, "--out", tmp_path / "out")
    assert (code, out) == (2, "")
    assert "joint up is prismatic, and this method knows joints that turn only: lock=" in err
    assert len(err.splitlines()) == 1
    assert not (tmp_path / "out").exists()


#: For a second method much is compiled anew; what is locked is locked before either is asked.
METHODS = long_where("apf-bidirectional".__eq__, ["apf-improved", "apf-bidirectional"])


@pytest.mark.parametrize("method", METHODS)
def test_with_its_lift_locked_an_arm_is_planned_by_these_methods(dualarm, tmp_path, method):
    """The remedy of the line above."""
    text = SCENES["a prismatic lift"][1].replace('"lift.urdf"', '"lift.urdf", lock: {up: 0.2}')
    text = text.replace("[0.1, 0.2, 3.0, 0]", "[0.2, 3.0, 0]").replace("[0.4, 0.6,", "[0.6,")
    path, _ = written(tmp_path, text)
    out = tmp_path / "out"
    code, _, err = dualarm("plan", path, "--method", method, "--out", out)
    assert (code, err) == (0, "")
    judged_again(path, out, [], json.loads((out / "cell.json").read_text()))


def test_a_lift_that_is_parked_hinders_nobody(dualarm, tmp_path):
    """It stands as an obstacle, raised as its start says, for a method that cannot move it."""
    parked = arm("lift", "lift.urdf", [1.2, 0, 0], [0.4, 0.2, 3.0, 0])
    text = arm("mover", "irb120", [0, 0, 0], ASIDE, DOWN) + parked
    path, _ = written(tmp_path, text)
    out = tmp_path / "out"
    code, told, _ = dualarm("plan", path, "--method", "apf-improved", "--out", out)
    assert code == 0
    assert "lift: parked" in told
    judged_again(path, out, [], json.loads((out / "cell.json").read_text()))


@pytest.mark.parametrize("pair", ["[right/capsule_1_joint_1, floor]", "[right, floor]"])
def test_an_exemption_may_name_a_parked_arm(dualarm, tmp_path, pair):
    text = arm("left", "irb120", [-0.45, 0, 0], ASIDE, DOWN)
    text += arm("right", "irb120", [0.45, 0, 0], ASIDE, yaw=np.pi)
    text += f"floor: 0\nexempt: [[left/capsule_1_joint_1, floor], {pair}]\n"
    path, _ = written(tmp_path, text)
    out = tmp_path / "out"
    code, _, err = dualarm("plan", path, "--method", "apf-improved", "--out", out)
    assert (code, err) == (0, "")


@pytest.mark.parametrize(
    "shape", ["<capsule radius='0.2' length='0.4'/>", "<cone radius='0.2'/>", ""]
)
def test_an_arm_inside_a_wall_is_never_planned(dualarm, tmp_path, shape):
    """A capsule counts, what is no shape of a URDF is refused by name, and so is no shape."""
    body = f"<collision><geometry>{shape}</geometry></collision>" if shape else ""
    joints = "".join(
        f"<joint name='j{k}' type='revolute'><parent link='l{k}'/><child link='l{k + 1}'/>"
        "<origin xyz='0 0 0.2'/><axis xyz='0 1 0'/>"
        "<limit lower='-2' upper='2' velocity='1' effort='1'/></joint>"
        for k in range(2)
    )
    (tmp_path / "own.urdf").write_text(
        f"<robot name='r'><link name='l0'/><link name='l1'>{body}</link><link name='l2'/>{joints}"
        "</robot>"
    )
    wall = "obstacles: {wall: {kind: box, center: [0, 0, 0.3], size: [1, 1, 1]}}\n"
    path, _ = written(tmp_path, arm("a", "own.urdf", [0, 0, 0], [0, 0.2], [0.5, 0.2]) + wall)
    code, out, err = dualarm("plan", path, "--method", "apf-improved", "--out", tmp_path / "out")
    said = {"<cap": "a/l1_0 - wall -0.7 m", "<con": "link l1: geometry = 'cone'"}
    assert (code, out) == (2, "")
    assert said.get(shape[:4], "collision shapes = 0") in err
    assert len(err.splitlines()) == 1
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("robot", [UR5, UR10], ids=["ur5", "ur10"])
@pytest.mark.parametrize("start", [[0.0] * 6, [0.0, -1.57, 1.57, -1.57, -1.57, 0.0]], ids=str)
def test_poses_in_which_meshes_are_clear_are_accepted(dualarm, tmp_path, robot, start):
    goal = [0.6, *start[1:]]
    path, _ = written(tmp_path, arm("only", robot, [0, 0, 0], start, goal))
    assert dualarm("check", path)[0] == 0
    table = pd.DataFrame([start, goal], columns=[f"q{k + 1}" for k in range(6)])
    (tmp_path / "out").mkdir()
    table.to_csv(tmp_path / "out" / "cell_only.csv")
    assert Replay(path, tmp_path / "out").touching() == set()


def test_what_touches_by_its_meshes_is_refused(dualarm, tmp_path):
    """Of random postures of a UR5, in which its meshes touch, not one is let through."""
    q = np.random.default_rng(5).uniform(-2.5, 2.5, (25, 6)).round(3)
    names = [f"q{k + 1}" for k in range(6)]
    (tmp_path / "out").mkdir()
    touching = 0
    for start in q.tolist():
        path, _ = written(tmp_path, arm("only", UR5, [0, 0, 0], start, start))
        pd.DataFrame([start], columns=names).to_csv(tmp_path / "out" / "cell_only.csv")
        if Replay(path, tmp_path / "out").touching():
            touching += 1
            code, _, err = dualarm("check", path)
            assert code == 2
            assert err.count("only/") >= 2
    assert touching >= 3


@pytest.mark.parametrize(
    "start",
    [
        [3.0685, 2.4113, -0.5825, -3.9672, 0.8241, 5.8918],
        [3.4858, 0.5656, -2.5584, -4.0475, -2.4232, 5.3441],
        [-3.0515, -4.0894, -0.5542, -5.7515, 0.6468, 4.1067],
    ],
    ids=str,
)
@pytest.mark.parametrize("end", ["start", "goal"])
def test_a_contact_that_watched_capsules_do_not_see_is_refused(dualarm, tmp_path, start, end):
    """Meshes of a UR5 touch, and no two capsules that are watched do."""
    both = {"start": [0.0] * 6, "goal": [0.0] * 6, end: start}
    path, _ = written(tmp_path, arm("only", UR5, [0, 0, 0], both["start"], both["goal"]))
    (tmp_path / "out").mkdir()
    table = pd.DataFrame([start], columns=[f"q{k + 1}" for k in range(6)])
    table.to_csv(tmp_path / "out" / "cell_only.csv")
    assert Replay(path, tmp_path / "out").touching()
    code, _, err = dualarm("check", path)
    assert code == 2
    assert f": {end} = " in err
    assert len(err.splitlines()) == 1
