"""Collision elements: each of the file is a shape of the arm, or refused by name."""

import coal
import numpy as np
import pytest
from numpy.testing import assert_allclose

from dualarm_repro.arms import load_arm
from dualarm_repro.errors import DataFileError, UnknownNameError, UnsupportedArmError

from .texts import ROD, joint, link, one_link, write

TETRAHEDRON = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"


def test_a_capsule_of_the_file_is_that_capsule(tmp_path):
    arm = load_arm(one_link(tmp_path, "<capsule radius='0.2' length='0.4'/>"))
    (one,) = arm.geometry.geometryObjects
    assert (one.name, one.geometry.radius, one.geometry.halfLength) == ("l1_0", 0.2, 0.2)
    assert isinstance(arm.solids.geometryObjects[0].geometry, coal.Capsule)
    assert_allclose(one.placement.translation, (0, 0, 0.15))


@pytest.mark.parametrize(
    "shape",
    [
        "<cone radius='0.1' length='0.2'/>",
        "<box size='0.1 0.2'/>",
        "<box size='0.1 0.2 -0.3'/>",
        "<box size='0.1 0.2 nan'/>",
        "<sphere radius='-1'/>",
        "<sphere/>",
        "<cylinder radius='0' length='1'/>",
        "<cylinder radius='0,1' length='1'/>",
        "<capsule radius='0.1'/>",
        "<mesh filename='x.stl' scale='0.001'/>",
        "<mesh filename='x.stl' scale='1 0 1'/>",
        "<mesh filename=''/>",
        "<sphere radius='1'/><sphere radius='2'/>",
        " ",
    ],
)
def test_what_is_no_shape_is_refused_with_its_link(shape, tmp_path):
    with pytest.raises(DataFileError, match=r'collision 0 of link l1: .*shapes="none"'):
        load_arm(one_link(tmp_path, shape))
    assert load_arm(one_link(tmp_path, shape), shapes="none").geometry.ngeoms == 0


def test_an_origin_that_is_no_place_is_refused(tmp_path):
    with pytest.raises(DataFileError, match=r"collision 0 of link l1: xyz = '0 0': .*three finite"):
        load_arm(one_link(tmp_path, ROD, origin="<origin xyz='0 0'/>"))


def test_all_elements_of_a_link_count(tmp_path):
    several = "".join(
        f"<collision name='{name}'><origin xyz='0 0 {z}'/><geometry>{shape}</geometry></collision>"
        for name, z, shape in (
            ("a", 0, "<sphere radius='0.1'/>"),
            ("b", 1, "<capsule radius='0.1' length='0.2'/>"),
            ("", 2, ROD),
        )
    )
    body = f"<link name='l1'>{several}</link>"
    arm = load_arm(write(tmp_path, link("b"), body, joint("j1", "b", "l1")), shapes="enclosing")
    assert [one.name for one in arm.geometry.geometryObjects] == ["b_0", "l1_0", "l1_1", "l1_2"]
    kinds = [type(one.geometry).__name__ for one in arm.solids.geometryObjects]
    assert kinds == ["Cylinder", "Sphere", "Capsule", "Cylinder"]


def test_no_shape_at_all_is_an_error_unless_asked_for(tmp_path):
    path = one_link(tmp_path, None)
    with pytest.raises(DataFileError, match=r'collision shapes = 0: .*shapes="none"'):
        load_arm(path)
    arm = load_arm(path, shapes="none")
    assert (arm.nq, arm.geometry.ngeoms, arm.exclusions) == (1, 0, None)
    with pytest.raises(UnknownNameError, match="shapes = 'nothing': expected one of fitted"):
        load_arm(path, shapes="nothing")


def test_visual_shapes_are_taken_only_when_asked_for(tmp_path):
    path = one_link(tmp_path, ROD, tag="visual")
    with pytest.raises(DataFileError, match='shapes="visual" for its 1 visual shapes'):
        load_arm(path)
    assert load_arm(path, shapes="visual").solids.ngeoms == 1
    assert load_arm(path, shapes="none").remarks == ("link l1 has a visual but no collision shape",)


def test_a_table_without_capsules_is_no_body_unless_asked_for(two_links):
    arm = load_arm(two_links())
    with pytest.raises(UnsupportedArmError, match=r'no capsules.*shapes="none"'):
        _ = arm.geometry
    assert load_arm(two_links(), shapes="none").geometry.ngeoms == 0


def test_a_mesh_is_enclosed_and_a_broken_one_named(tmp_path):
    (tmp_path / "part.obj").write_text(TETRAHEDRON)
    path = one_link(tmp_path, "<mesh filename='part.obj' scale='1 -2 0.5'/>", origin="")
    corners = np.array([(0, 0, 0), (1, 0, 0), (0, -2, 0), (0, 0, 0.5)])
    for shapes in ("fitted", "enclosing"):
        gaps = []
        for one in load_arm(path, shapes=shapes).geometry.geometryObjects:
            local = (corners - one.placement.translation) @ one.placement.rotation
            local[:, 2] -= local[:, 2].clip(-one.geometry.halfLength, one.geometry.halfLength)
            gaps.append(np.linalg.norm(local, axis=1) - one.geometry.radius)
        assert np.min(gaps, axis=0).max() < 1e-9
    (tmp_path / "part.obj").write_text("v 0 0 x\nf 1 2 3\n")
    with pytest.raises(DataFileError, match=r"mesh of collision 0 of link l1 = .*part\.obj"):
        _ = load_arm(path).geometry
