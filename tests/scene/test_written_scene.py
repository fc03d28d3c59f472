"""What more a scene file can hold: tools, cylinders, meshes, things that move, and no bombs."""

import textwrap

import coal
import numpy as np
import pinocchio as pin
import pytest

from dualarm_repro.arms import load_arm
from dualarm_repro.errors import DataFileError, InputError
from dualarm_repro.scene import (
    Capsule,
    HalfSpace,
    PlacedArm,
    Scene,
    Sphere,
    distances,
    load_scene,
    signed_distance,
)
from dualarm_repro.scene.mesh_parts import covering, divided, mesh_parts
from dualarm_repro.scene.posing import links_of
from dualarm_repro.scene.scene_file import MOST_OBSTACLES, scene_of
from dualarm_repro.scene.tool import with_tool
from dualarm_repro.written import LARGEST_FILE, read_written

#: An L of two bars as a triangle mesh: its hull holds the hollow, its parts do not.
L_CORNERS = [(0, 0), (0.4, 0), (0.4, 0.1), (0.1, 0.1), (0.1, 0.4), (0, 0.4)]


def write(folder, text, name="scene.yaml"):
    path = folder / name
    path.write_text(textwrap.dedent(text), encoding="utf-8")
    return path


def l_mesh(folder):
    """The L, 0.1 m thick, as an OBJ file."""
    lines = [f"v {x} {y} {z}" for z in (0.0, 0.1) for x, y in L_CORNERS]
    caps = [(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 5)]
    faces = [(c, b, a) for a, b, c in caps] + [(a + 6, b + 6, c + 6) for a, b, c in caps]
    for a in range(6):
        b = (a + 1) % 6
        faces += [(a, b, b + 6), (a, b + 6, a + 6)]
    lines += [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in faces]
    path = folder / "l.obj"
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def test_parts_hold_the_whole_surface_and_leave_the_hollow(tmp_path):
    parts = mesh_parts(l_mesh(tmp_path), (1.0, 1.0, 1.0), 8)
    assert 1 < len(parts) <= 8
    rng = np.random.default_rng(0)
    for _ in range(200):  # points of the surface: of the two caps and of the walls
        corner, span = rng.choice(6), rng.random()
        a, b = (np.array(L_CORNERS[k % 6]) for k in (corner, corner + 1))
        point = np.append(a + span * (b - a), 0.1 * rng.random())
        gaps = [signed_distance(Sphere(point, 1e-6), part).distance for part in parts]
        assert min(gaps) <= 1e-9
    hollow = Sphere([0.33, 0.33, 0.05], 1e-6)
    assert min(signed_distance(hollow, part).distance for part in parts) > 0.05
    (hull,) = mesh_parts(l_mesh(tmp_path), (1.0, 1.0, 1.0), 1)
    assert hull.volume == pytest.approx(0.1 * (0.16 - 0.5 * 0.3**2))


def test_a_part_grows_by_the_triangles_it_is_given():
    cube = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
    (grown,) = covering([cube], np.array([[[0, 0, 0], [1, 0, 0], [0.5, 0.5, 2.0]]], dtype=float))
    assert grown.vertices[:, 2].max() == 2.0


def test_divided_triangles_are_the_same_surface():
    one = np.array([[[0, 0, 0], [3, 0, 0], [0, 1, 0]]], dtype=float)
    many = divided(one, 0.3)
    edges = np.linalg.norm(many - np.roll(many, -1, axis=1), axis=2)
    assert edges.max() <= 0.3
    area = 0.5 * np.linalg.norm(np.cross(many[:, 1] - many[:, 0], many[:, 2] - many[:, 0]), axis=1)
    assert area.sum() == pytest.approx(1.5)


def test_scene_with_every_new_kind(tmp_path):
    l_mesh(tmp_path)
    text = """
        arms:
          left:
            robot: irb120
            tool:
              shapes:
                - {kind: cylinder, start: [0, 0, 0], end: [0, 0, 0.2], radius: 0.02}
                - {kind: box, center: [0, 0, 0.25], size: [0.1, 0.1, 0.1]}
              tip: {xyz: [0, 0, 0.3]}
        obstacles:
          pipe: {kind: cylinder, start: [2, 0, 0], end: [2, 0, 1], radius: 0.1}
          part: {kind: mesh, file: l.obj, xyz: [3, 0, 0], rpy: [0, 0, pi/2], scale: 2, parts: 8}
        moving:
          cart:
            shape: {kind: box, center: [0, 0, 0], size: [0.2, 0.2, 0.2]}
            path: [{at: 0, xyz: [4, 0, 0]}, {at: 10, xyz: [4, 1, 0]}]
    """
    scene = load_scene(write(tmp_path, text))
    plain, held = load_arm("irb120"), scene.arms[0].arm
    q = np.array([0.1, 0.2, -0.3, 0.4, 0.5, 0.6])
    tip = plain.fk(q) @ np.array([0.0, 0.0, 0.3, 1.0])
    assert held.fk(q)[:3, 3] == pytest.approx(tip[:3])
    assert held.fk(q)[:3, :3] == pytest.approx(plain.fk(q)[:3, :3])
    names = [name for name, _ in scene.pairs.names]
    assert {"left/tool_0", "left/tool_1"} <= set(names)
    pipe = signed_distance(Sphere([2.5, 0, 0.5], 0.1), scene.obstacles["pipe"]).distance
    assert 0.3 - 0.1 * 0.005 <= pipe <= 0.3 + 1e-12
    corners = np.vstack([part.vertices for part in scene.obstacles["part"]])
    # convex parts contain the mesh and may be a little larger [m]
    assert corners.min(axis=0) == pytest.approx([3 - 0.8, 0, 0], abs=0.02)
    cart = [k for k, pair in enumerate(scene.pairs.names) if pair == ("left/tool_1", "cart")]
    early, late = (distances(scene, q, time)[cart[0]] for time in (0.0, 10.0))
    assert early != pytest.approx(late)


def test_a_tool_collides_where_coal_says_so():
    """The capsule of a held rod against a ball, placed by Pinocchio and measured by coal."""
    arm = load_arm("panda")
    held = with_tool(arm, [Capsule([0, 0, 0.05], [0.1, 0, 0.3], 0.02)])
    q = np.array([0.1, 0.2, 0.3, -1.0, 0.2, 1.0, 0.3])
    flange = arm.fk(q)
    ends = [(flange @ np.array([*p, 1.0]))[:3] for p in ((0, 0, 0.05), (0.1, 0, 0.3))]
    links = links_of(held)
    assert links.names[-1] == "tool_0"
    assert len(links.names) == len(links_of(arm).names) + 1
    model, data = held.model, held.model.createData()
    pin.forwardKinematics(model, data, q)
    shape = held.geometry.geometryObjects[-1]
    at = data.oMi[shape.parentJoint] * shape.placement
    place = coal.Transform3s(at.rotation, at.translation)
    ball, to = coal.Sphere(0.1), coal.Transform3s(np.eye(3), ends[1] + np.array([0.0, 0.0, 0.4]))
    found = coal.distance(
        shape.geometry, place, ball, to, coal.DistanceRequest(), coal.DistanceResult()
    )
    wanted = signed_distance(Capsule(*ends, 0.02), Sphere(ends[1] + [0, 0, 0.4], 0.1)).distance
    assert found == pytest.approx(wanted, abs=1e-6)
    with pytest.raises(InputError, match="a shape with an end"):
        with_tool(arm, [HalfSpace([0, 0, 1], 0)])


COAXIAL = """<robot name="coaxial"><link name="b"/><link name="l1"><collision>
<origin xyz="0 0 0.1"/><geometry><sphere radius="0.05"/></geometry></collision></link>
<link name="l2"/><link name="tool"><collision><origin xyz="0.3 0 0"/><geometry>
<sphere radius="0.05"/></geometry></collision></link>{joints}</robot>"""
COAXIAL_JOINT = (
    "<joint name='j{0}' type='revolute'><parent link='{1}'/><child link='{2}'/><axis xyz='0 0 1'/>"
    "<limit lower='-1' upper='1' velocity='1' effort='1'/></joint>"
)


def test_a_tool_of_a_fitted_arm_is_watched_but_where_it_always_is(tmp_path):
    """One part of the tool sits in the first link for ever, another can meet it: a listed
    exclusion, and a watched pair."""
    names = ("b", "l1", "l2", "tool")
    joints = "".join(COAXIAL_JOINT.format(k, *names[k : k + 2]) for k in range(3))
    (tmp_path / "coaxial.urdf").write_text(COAXIAL.format(joints=joints), encoding="utf-8")
    arm = load_arm(tmp_path / "coaxial.urdf")
    held = with_tool(arm, [Sphere([0, 0, 0.1], 0.05), Sphere([0.3, 0, 0.1], 0.05)])
    assert arm.exclusions == ()
    (excluded,) = held.exclusions
    assert {excluded.first, excluded.second} == {"l1_0", "held_tool_0"}
    scene = Scene([PlacedArm("arm", held)], {"ball": Sphere([0, 0, 9], 1)})
    assert ("arm/l1_0", "arm/held_tool_1") in scene.pairs.names
    assert ("arm/l1_0", "arm/held_tool_0") not in scene.pairs.names
    assert {("arm/held_tool_0", "ball"), ("arm/held_tool_1", "ball")} <= set(scene.pairs.names)
    assert scene.pairs.between("arm/held_tool", "ball").sum() == 2


BOMB = "a: &a [x, x, x, x, x, x, x, x, x, x]\n" + "".join(
    f"{new}: &{new} [{', '.join([f'*{old}'] * 10)}]\n"
    for old, new in zip("abcdefgh", "bcdefghi", strict=True)
)
OVERWHELMING = {
    "aliases that multiply": (BOMB, "aliases that multiply: at most 500000 values are read"),
    "an alias that contains itself": ("a: &a [*a]\n", "values that end|well-formed YAML"),
    "brackets": ("a: " + "[" * 5000 + "]" * 5000, "at most 50 lists or mappings"),
    "indents": ("".join(" " * k + "a:\n" for k in range(1200)), "at most 50 lists or mappings"),
    "nested blocks": ("".join(" " * k + "a:\n" for k in range(200)), "at most 50|mapping"),
    "dashes": ("- " * 3000 + "a", "at most 50 lists or mappings"),
    "a date that is none": ("a: 2024-13-45\n", "well-formed YAML"),
}


@pytest.mark.parametrize(("text", "message"), OVERWHELMING.values(), ids=OVERWHELMING)
def test_no_file_overwhelms_the_reader(tmp_path, text, message):
    with pytest.raises(DataFileError, match=message) as caught:
        read_written(write(tmp_path, text))
    assert len(str(caught.value)) < 600


def test_a_file_may_be_too_large_or_a_folder(tmp_path):
    path = write(tmp_path, "a: 1\n" + "#" * LARGEST_FILE)
    with pytest.raises(DataFileError, match="at most 1 MB"):
        read_written(path)
    with pytest.raises(DataFileError, match="a folder"):
        read_written(tmp_path)
    with pytest.raises(DataFileError, match="file"):
        read_written(tmp_path / "a\0b.yaml")


def test_more_obstacles_than_a_scene_may_have(tmp_path):
    content = {"arms": {}, "obstacles": dict.fromkeys(map(str, range(MOST_OBSTACLES + 1)))}
    with pytest.raises(DataFileError, match=r"obstacles = 10001: expected at most 10000"):
        scene_of(tmp_path / "scene.yaml", content)


def test_an_alias_that_is_used_twice_is_welcome(tmp_path):
    path = write(tmp_path, "a: &a [1, 2]\nb: *a\nc: *a\n")
    assert read_written(path)["c"] == [1, 2]


@pytest.mark.parametrize(
    ("entry", "message"),
    [
        (
            "{kind: mesh, file: gone.obj}",
            r"gone\.obj: file = 'No such file or directory': expected a readable mesh",
        ),
        ("{kind: mesh, file: /etc/passwd}", r"expected a mesh file that ends in \.stl"),
        ("{kind: mesh, file: flat.obj}", "a mesh that spans a volume"),
        ("{kind: mesh, file: broken.stl}", "a mesh of triangles"),
        ("{kind: mesh, file: l.obj, parts: 0}", r"x\.mesh\.parts = 0"),
        ("{kind: mesh, file: l.obj, scale: -1}", r"scale"),
        ("{kind: cylinder, start: [0, 0, 0], end: [0, 0, 0], radius: 1}", "a point apart"),
    ],
)
def test_what_is_wrong_with_a_shape_is_named(tmp_path, entry, message):
    write(tmp_path, "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n", "flat.obj")
    write(tmp_path, "no mesh", "broken.stl")
    text = f"arms: {{a: {{robot: irb120}}}}\nobstacles: {{x: {entry}}}"
    with pytest.raises(DataFileError, match=message) as caught:
        load_scene(write(tmp_path, text))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("path", "message"),
    [
        ("[{at: 1}, {at: 0}]", r"moving\.m\.path\.index"),
        ("[]", r"moving\.m\.path"),
        ("[{at: 1.0e+9}]", r"moving\.m\.path\.0\.at = 1000000000"),
        ("[{at: .nan}]", r"moving\.m\.path\.0\.at = nan"),
    ],
)
def test_what_is_wrong_with_a_trajectory_is_named(tmp_path, path, message):
    shape = "{kind: sphere, center: [0, 0, 0], radius: 0.1}"
    moving = f"moving: {{m: {{shape: {shape}, path: {path}}}}}"
    with pytest.raises(DataFileError, match=message):
        load_scene(write(tmp_path, f"arms: {{a: {{robot: irb120}}}}\n{moving}"))
