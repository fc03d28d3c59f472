"""Visual meshes: few triangles, near the originals, and only with a licence."""

import numpy as np

from dualarm_repro.arms import load_arm
from dualarm_repro.view.scenes import urdf_meshes
from dualarm_repro.view.scenes.urdf_meshes import decimated, visual_parts


def sphere(count):
    u, v = np.meshgrid(np.linspace(0, np.pi, count), np.linspace(0, 2 * np.pi, count))
    points = np.stack([np.sin(u) * np.cos(v), np.sin(u) * np.sin(v), np.cos(u)], axis=-1)
    first = (np.arange(count - 1)[:, np.newaxis] * count + np.arange(count - 1)).ravel()
    faces = [
        np.column_stack([first, first + 1, first + count]),
        np.column_stack([first + 1, first + count + 1, first + count]),
    ]
    return points.reshape(-1, 3), np.concatenate(faces)


def test_decimated_triangles_stay_near():
    vertices, faces = decimated(*sphere(60), 0.2)
    assert 50 < len(faces) < 1000
    assert abs(np.linalg.norm(vertices, axis=1) - 1.0).max() < 0.06
    assert faces.max() < len(vertices)
    assert (np.diff(np.sort(faces, axis=1), axis=1) > 0).all()


def test_meshes_of_the_catalogue():
    parts = visual_parts("a", load_arm("panda"), "#0072B2", "a/0")
    assert sum(len(part.faces) for part in parts) <= 12_000
    assert {part.node for part in parts} >= {f"a/{k}" for k in range(8)}


def test_an_arm_of_a_table_has_none():
    assert visual_parts("a", load_arm("irb120"), "#0072B2", "a/0") == []


def test_without_a_licence_nothing_is_shown(monkeypatch):
    import re

    monkeypatch.setattr(urdf_meshes, "_FREE", re.compile("license: never"))
    assert visual_parts("a", load_arm("panda"), "#0072B2", "a/0") == []


def test_kept_meshes_are_those_that_were_made(monkeypatch, tmp_path):
    monkeypatch.setenv("DUALARM_CACHE", str(tmp_path))
    arm = load_arm("panda")
    path, joints = urdf_meshes._description(arm), frozenset(arm.model.names)
    names, made = urdf_meshes._decimated_meshes(path, joints)
    urdf_meshes._meshes.cache_clear()
    urdf_meshes._meshes(path, joints)
    urdf_meshes._meshes.cache_clear()
    monkeypatch.setattr(urdf_meshes, "_decimated_meshes", None)
    again, kept = urdf_meshes._meshes(path, joints)
    urdf_meshes._meshes.cache_clear()
    assert again == names
    for one, other in zip(made, kept, strict=True):
        assert one[0] == other[0]
        for before, now in zip(one[1:], other[1:], strict=True):
            assert before.dtype == now.dtype
            np.testing.assert_array_equal(before, now)
