import json
import textwrap

import jsonschema
import numpy as np
import pinocchio as pin
import pytest
import yaml

from dualarm_repro.arms import load_arm
from dualarm_repro.errors import DataFileError, InputError
from dualarm_repro.scene import PlacedArm, Scene, distances, facing, load_scene, window_frame
from dualarm_repro.scene.scene_file import json_schema
from dualarm_repro.scene.shapes import Box, Capsule, HalfSpace, Sphere

FULL = """
    arms:
      left:
        robot: irb120
        xyz: [0.35, 0, 0]
        rpy: [0, 0, pi/2]
        start: [0, 0, 0, 0, "90 deg", 0]
        goal: [0.5, 0, 0, 0, 0, 0]
      right: {robot: er16, xyz: [-0.8, 0, 0.1]}
    obstacles:
      ball: {kind: sphere, center: [0, 0.3, 0.6], radius: 0.1}
      pole: {kind: capsule, start: [0.4, 0.5, 0], end: [0.4, 0.5, 1], radius: 0.05}
      table: {kind: box, center: [0, 1, 0.3], size: [1, 0.5, 0.1], rpy: [0, 0, 0.2]}
      wall: {kind: halfspace, normal: [0, 1, 0], offset: -0.5}
      window:
        kind: window
        center: [0, 0.5, 0.5]
        normal: [1, 0.2, 0]
        opening_width: 0.6
        opening_height: 0.7
        bar_width: 0.1
        bar_depth: 0.05
      rock: {kind: hull, points: [[1, 1, 0], [1.2, 1, 0], [1, 1.2, 0], [1, 1, 0.2]]}
    floor: -0.2
    exempt: [[left/capsule_1_joint_1, floor], [right, ball]]
    self_collision: false
"""


def write(tmp_path, text):
    path = tmp_path / "scene.yaml"
    path.write_text(textwrap.dedent(text), encoding="utf-8")
    return path


def test_file_gives_the_scene_written_in_code(tmp_path):
    scene = load_scene(write(tmp_path, FULL))
    turn = pin.rpy.rpyToMatrix(0, 0, np.pi / 2)
    arms = [
        PlacedArm("left", load_arm("irb120"), pin.SE3(turn, np.array([0.35, 0, 0]))),
        PlacedArm("right", load_arm("er16"), pin.SE3(np.eye(3), np.array([-0.8, 0, 0.1]))),
    ]
    expected = Scene(
        arms,
        {
            "ball": Sphere((0, 0.3, 0.6), 0.1),
            "pole": Capsule((0.4, 0.5, 0), (0.4, 0.5, 1), 0.05),
            "table": Box((0, 1, 0.3), (1, 0.5, 0.1), pin.rpy.rpyToMatrix(0, 0, 0.2)),
            "wall": HalfSpace((0, 1, 0), -0.5),
            "window": window_frame((0, 0.5, 0.5), facing((1, 0.2, 0)), 0.6, 0.7, 0.1, 0.05),
            "rock": scene.obstacles["rock"],
        },
        floor=-0.2,
        exempt=[("left/capsule_1_joint_1", "floor"), ("right", "ball")],
        self_collision=False,
    )
    assert scene.pairs.names == expected.pairs.names
    q = np.random.default_rng(0).uniform(-1, 1, (10, 12))
    np.testing.assert_array_equal(distances(scene, q), distances(expected, q))
    assert scene.obstacles["rock"].volume == pytest.approx(0.2**3 / 6)
    left, right = scene.arms
    np.testing.assert_allclose(left.start, [0, 0, 0, 0, np.pi / 2, 0])
    np.testing.assert_allclose(left.goal, [0.5, 0, 0, 0, 0, 0])
    assert right.start is None


def test_smallest_file(tmp_path):
    scene = load_scene(write(tmp_path, "arms: {only: {robot: ur5}}"))
    assert scene.nq == 6
    assert scene.floor is None
    np.testing.assert_array_equal(scene.arms[0].placement.homogeneous, np.eye(4))


def test_robot_file_beside_the_scene_file(tmp_path):
    (tmp_path / "stick.urdf").write_text(
        """<robot name="stick"><link name="base"/>
        <link name="rod"><collision><geometry><cylinder radius="0.05" length="1"/></geometry>
        </collision></link><link name="tip"/>
        <joint name="hinge" type="revolute"><parent link="base"/><child link="rod"/>
        <axis xyz="0 1 0"/><limit lower="-1" upper="1" velocity="1" effort="1"/></joint>
        <joint name="end" type="fixed"><parent link="rod"/><child link="tip"/></joint></robot>""",
        encoding="utf-8",
    )
    text = """
        arms: {a: {robot: stick.urdf, flange: tip}}
        obstacles: {b: {kind: sphere, center: [1, 0, 0], radius: 0.2}}
    """
    scene = load_scene(write(tmp_path, text))
    np.testing.assert_allclose(distances(scene, [0.0]), [0.75], atol=1e-9)


def test_shapes_and_packages_of_an_arm(tmp_path):
    """The lower end of a rod is 1 m above a floor; without shapes no distance is left."""
    robot, mesh = (tmp_path / "cell" / "stick.urdf"), tmp_path / "parts" / "own" / "rod.obj"
    for path in (robot, mesh):
        path.parent.mkdir(parents=True)
    robot.write_text(
        """<robot name="stick"><link name="base"/><link name="rod"><collision><geometry>
        <mesh filename="package://own/rod.obj"/></geometry></collision></link>
        <joint name="hinge" type="continuous"><parent link="base"/><child link="rod"/></joint>
        </robot>"""
    )
    mesh.write_text("v 0 0 -1\nv 0 0 1\nv 0.1 0 0\nv 0 0.1 0\nf 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n")
    arm = "arms: {{a: {{robot: cell/stick.urdf, {}}}}}\nfloor: -2"
    with pytest.raises(DataFileError, match=r"own/rod\.obj'.*packages="):
        load_scene(write(tmp_path, arm.format("start: [7]")))
    scene = load_scene(write(tmp_path, arm.format("packages: [parts], start: [7]")))
    assert 0.9 < distances(scene, [6.0 * np.pi]).min() < 1.0
    bare = load_scene(write(tmp_path, arm.format("shapes: none")))
    assert distances(bare, np.zeros((3, 1))).shape == (3, 0)
    assert bare.pairs.bodies == ()


BAD = {
    "no arm": ("floor: 0", r"scene.yaml: arms = 'nothing': expected field required"),
    "empty arms": ("arms: {}", r"arms = "),
    "arm without robot": ("arms: {a: {xyz: [0, 0, 0]}}", r"arms\.a\.robot = 'nothing'"),
    "unknown robot": (
        "arms: {a: {robot: irb12}}",
        r"scene.yaml: arms\.a: name = 'irb12': expected one of .*irb120",
    ),
    "missing file": ("arms: {a: {robot: gone.urdf}}", r"gone\.urdf: file"),
    "misspelt field": ("arms: {a: {robot: irb120, zyx: [0, 0, 0]}}", r"arms\.a\.zyx"),
    "two coordinates": ("arms: {a: {robot: irb120, xyz: [0, 0]}}", r"arms\.a\.xyz"),
    "nan": ("arms: {a: {robot: irb120, xyz: [0, .nan, 0]}}", r"arms\.a\.xyz\.1 = nan"),
    "text": ("arms: {a: {robot: irb120, xyz: [0, zero, 0]}}", r"arms\.a\.xyz\.1 = 'zero'"),
    "bad angle": ("arms: {a: {robot: irb120, rpy: [0, 0, 90°]}}", r"arms\.a\.rpy\.2 = '90°'"),
    "short start": ("arms: {a: {robot: irb120, start: [0, 0]}}", r"arms\.a: shape of q = \(2,\)"),
    "infinite start": (
        "arms: {a: {robot: irb120, start: [0, 0, 0, 0, 0, .inf]}}",
        r"arms\.a\.start\.joints\.5 = inf",
    ),
    "lock of a DH arm": ("arms: {a: {robot: irb120, lock: {j: 0}}}", r"arms\.a: lock"),
    "arm name": ("arms: {a/b: {robot: irb120}}", r"arms\.a/b"),
    "floor": ("arms: {a: {robot: irb120}}\nfloor: low", r"floor = 'low'"),
    "exempt": ("arms: {a: {robot: irb120}}\nexempt: [[a, lamp]]", r"body = 'lamp'.*one of"),
    "exempt of three": ("arms: {a: {robot: irb120}}\nexempt: [[a, a, a]]", r"exempt\.0"),
    "self collision": ("arms: {a: {robot: irb120}}\nself_collision: 3", r"self_collision = 3"),
    "same name": (
        "arms: {a: {robot: irb120}}\nobstacles: {a: {kind: sphere, center: [0, 0, 0], radius: 1}}",
        r"name = 'a': expected distinct names",
    ),
    "key twice": ("arms: {a: {robot: irb120}, a: {robot: ur5}}", r"key 'a' is given twice"),
    "list": ("- arms", r"top level = 'list': expected a mapping"),
}
OBSTACLES = {
    "kind missing": ("{radius: 1}", r"obstacles\.x"),
    "kind unknown": ("{kind: cone, radius: 1}", r"obstacles\.x"),
    "radius missing": ("{kind: sphere, center: [0, 0, 0]}", r"x\.sphere\.radius = 'nothing'"),
    "zero radius": ("{kind: sphere, center: [0, 0, 0], radius: 0}", r"x\.sphere\.radius = 0"),
    "negative": (
        "{kind: capsule, start: [0, 0, 0], end: [0, 0, 1], radius: -1}",
        r"x\.capsule\.radius = -1",
    ),
    "flat box": ("{kind: box, center: [0, 0, 0], size: [1, 0, 1]}", r"x\.box\.size\.1 = 0"),
    "no normal": ("{kind: halfspace, normal: [0, 0, 0], offset: 1}", r"obstacles\.x\.normal"),
    "radius nan": ("{kind: sphere, center: [0, 0, 0], radius: .nan}", r"x\.sphere\.radius = nan"),
    "radius true": ("{kind: sphere, center: [0, 0, 0], radius: true}", r"x\.sphere\.radius = True"),
    "window up": (
        "{kind: window, center: [0, 0, 0], normal: [0, 0, 1], opening_width: 1,"
        " opening_height: 1, bar_width: 0.1, bar_depth: 0.1}",
        r"obstacles\.x\.up",
    ),
    "flat hull": (
        "{kind: hull, points: [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]}",
        r"obstacles\.x\.points.*do not lie in one plane",
    ),
}


@pytest.mark.parametrize(("text", "message"), BAD.values(), ids=BAD)
def test_bad_files(tmp_path, text, message):
    with pytest.raises(DataFileError, match=message) as caught:
        load_scene(write(tmp_path, text))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(("entry", "message"), OBSTACLES.values(), ids=OBSTACLES)
def test_bad_obstacles(tmp_path, entry, message):
    text = f"arms: {{a: {{robot: irb120}}}}\nobstacles: {{x: {entry}}}"
    with pytest.raises(DataFileError, match=message) as caught:
        load_scene(write(tmp_path, text))
    assert str(caught.value).startswith(str(tmp_path / "scene.yaml"))


def test_missing_file(tmp_path):
    with pytest.raises(DataFileError, match=r"none\.yaml: file"):
        load_scene(tmp_path / "none.yaml")


def test_schema_accepts_what_the_reader_accepts():
    schema = json.loads(json.dumps(json_schema()))
    jsonschema.validate(yaml.safe_load(FULL), schema)
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate({"arms": {"a": {"robot": "irb120", "zyx": [0, 0, 0]}}}, schema)


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        ((None,), "arms = None"),
        (("x",), "arms"),
        (([1],), r"arms\[0\] = 1: expected a PlacedArm"),
        (([], 3), "obstacles = 3"),
        (([], {}, []), r"moving = \[\]"),
        (([], {}, {"x": 1}), r"moving\['x'\] = 1: expected a MovingShape"),
        (([], {}, {}, "x"), "floor = 'x'"),
        (([], {}, {}, None, [1]), r"exempt\[0\] = 1: expected a tuple"),
        (([], {}, {}, None, (), "x"), "self_collision = 'x'"),
        (([], {3: 1}), "name = 3"),
    ],
)
def test_arguments_of_a_scene_are_named(arguments, told):
    with pytest.raises(InputError, match=told):
        Scene(*arguments)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("arm: {}", "arm = 'an empty mapping': expected one of the fields arms, obstacles"),
        (
            "arms: {a: {robot: irb120, strat: [0]}}",
            r"arms\.a\.strat.*one of the fields start, robot",
        ),
        (
            "arms: {a: {robot: irb120}}\nobstacles: {x: {kind: sphere, centre: [0, 0, 0]}}",
            r"x\.sphere\.centre.*one of the fields center, kind, radius",
        ),
    ],
)
def test_unknown_field_is_told_the_known_ones_most_similar_first(tmp_path, text, told):
    path = tmp_path / "scene.yaml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(DataFileError, match=told):
        load_scene(path)
