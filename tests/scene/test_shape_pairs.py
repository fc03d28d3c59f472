"""Distances of links of one arm by their exact shapes, where hulls overlap that are clear."""

from importlib import import_module

import numpy as np
import pinocchio as pin
import pytest

from dualarm_repro.arms import load_arm
from dualarm_repro.arms.fit.postures import contacts
from dualarm_repro.scene import (
    PlacedArm,
    Scene,
    certified_minimum,
    clearance,
    distances,
    hull_pairs,
)
from dualarm_repro.scene.certificate import reach
from dualarm_repro.scene.posing import links_of
from dualarm_repro.scene.shape_pairs import NEAR, shape_pairs, shapes_of

LIMIT = "<limit lower='-1' upper='1' effort='1' velocity='1'/>"


def ring(inner=0.2, outer=0.24, half=0.05, sides=32):
    """OBJ text of a ring about z: its hull is full, and so are the capsules of its parts."""
    turn = 2.0 * np.pi * np.arange(sides) / sides
    rows, faces = [], []
    for radius, z in ((inner, -half), (outer, -half), (outer, half), (inner, half)):
        rows += [f"v {radius * np.cos(t)} {radius * np.sin(t)} {z}" for t in turn]
    for ring_ in range(4):
        a, b = ring_ * sides, (ring_ + 1) % 4 * sides
        for k in range(sides):
            m = (k + 1) % sides
            faces += [f"f {a + k + 1} {a + m + 1} {b + k + 1}"]
            faces += [f"f {a + m + 1} {b + m + 1} {b + k + 1}"]
    return "\n".join([*rows, *faces]) + "\n"


@pytest.fixture(scope="module")
def arm(tmp_path_factory):
    """A ball of 0.03 m inside a ring of radius 0.2 m and 0.01 m thickness, pushed about in it."""
    folder = tmp_path_factory.mktemp("ring")
    (folder / "ring.obj").write_text(ring(0.2, 0.21, 0.15), encoding="utf-8")
    solid = "<collision><geometry>{}</geometry></collision>"
    parts = [
        f"<link name='l0'>{solid.format('<mesh filename=' + chr(39) + 'ring.obj' + chr(39) + '/>')}"
        "</link><link name='l1'/>",
        f"<link name='l2'>{solid.format('<sphere radius=' + chr(39) + '0.03' + chr(39) + '/>')}"
        "</link>",
    ]
    for k, axis in enumerate(("1 0 0", "0 1 0")):
        limit = LIMIT.replace("-1", "-0.19").replace("'1' eff", "'0.19' eff")
        parts.append(
            f"<joint name='j{k}' type='prismatic'><parent link='l{k}'/><child link='l{k + 1}'/>"
            f"<axis xyz='{axis}'/>{limit}</joint>"
        )
    path = folder / "ring.urdf"
    path.write_text(f"<robot name='r'>{''.join(parts)}</robot>", encoding="utf-8")
    return load_arm(path)


def test_the_room_inside_a_ring_is_free(arm):
    """The ball is r from the middle: 0.2 cos(pi/32) - r - 0.03 or a little more from the ring."""
    scene = Scene([PlacedArm("a", arm)])
    q = np.array([[0.0, 0.0], [0.1, 0.0], [0.0, -0.163], [0.165, 0.0], [0.19, 0.0]])
    before = distances(scene, q).min(axis=1)
    touching = contacts(arm.model, arm.solids, [(0, 1)], q)[:, 0]
    assert touching.tolist() == [False, False, False, False, True]
    assert (before[:4] > 0.0).all(), "no false alarm"
    assert before[4] <= 0.0
    true = 0.2 - np.hypot(*q.T) - 0.03
    assert (before[:4] <= true[:4] + 1e-6).all(), "never optimistic"


def test_witnesses_and_bounds(arm):
    base = pin.SE3(pin.rpy.rpyToMatrix(0.3, -0.2, 1.0), np.array([0.4, -0.1, 0.7]))
    scene = Scene([PlacedArm("a", arm, base)])
    q = np.array([[0.15, 0.03], [0.166, 0.0], [-0.1, -0.12]])
    found = clearance(scene, q)
    assert found.distance == pytest.approx(distances(scene, q), abs=1e-9)
    at = found.point_a + found.distance[..., None] * found.normal
    assert found.point_b == pytest.approx(at, abs=1e-9)
    path = np.array([[-0.16, 0.0], [0.16, 0.0]])
    bracket = certified_minimum(scene, path, tolerance=1e-3)
    between = path[0] + np.linspace(0, 1, 400)[:, None] * (path[1] - path[0])
    least = distances(scene, between).min()
    assert 0.0 < bracket.lower <= least + 1e-9
    assert bracket.upper <= least + 1e-3


def test_hulls_alone_refuse_what_the_shapes_allow(arm, monkeypatch):
    """All over the room in which the ball is 1 mm or more from the ring."""
    scene = Scene([PlacedArm("a", arm)])
    q = arm.random_configurations(300, np.random.default_rng(0))
    q = q[np.hypot(*q.T) < 0.2 * np.cos(np.pi / 32) - 0.031]
    found = distances(scene, q)
    with monkeypatch.context() as patch:
        module = import_module("dualarm_repro.scene.clearance")
        patch.setattr(module, "refine", hull_pairs.refine)
        alone = distances(scene, q)
    assert (alone <= 0.0).any()
    assert (found > 0.0).all()
    assert (found >= alone).all()
    assert (found[found > alone] <= NEAR).all()


def test_only_capsules_as_they_were_fitted_have_shapes(arm):
    assert set(shapes_of(arm)) == set(links_of(arm).names)

    def thicker():
        made = pin.GeometryModel()
        for one in arm.geometry.geometryObjects:
            solid = type(one.geometry)(one.geometry.radius + 0.01, 2.0 * one.geometry.halfLength)
            made.addGeometryObject(
                pin.GeometryObject(one.name, one.parentJoint, one.placement, solid)
            )
        return made

    assert shapes_of(arm.reshaped(thicker)) == {}
    assert shapes_of(load_arm("panda")) == {}
    assert shape_pairs(Scene([PlacedArm("a", load_arm("irb120"))])) == {}
    assert reach(arm, np.array([0.2, 0.2])).shape == (arm.geometry.ngeoms, 2)
