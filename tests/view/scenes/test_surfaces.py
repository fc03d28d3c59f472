"""Surfaces of parts: sizes, and normals that point outwards."""

import numpy as np
import pytest

from dualarm_repro.view.scenes.contents import Part
from dualarm_repro.view.scenes.surfaces import surface

SIZES = {
    "tapered": [(0.2, 0.1, 0.5), (0.1, 0.1, 0.0), (0.3, 0.1, 0.1), (0.1, 0.3, 0.1)],
    "rod": [(0.2, 0.5)],
    "box": [(0.1, 0.2, 0.3)],
}


@pytest.mark.parametrize(("kind", "size"), [(k, s) for k, sizes in SIZES.items() for s in sizes])
def test_faces_and_normals_point_outwards(kind, size):
    made = surface(Part("world", kind, size, "#000000"))
    assert np.allclose(np.linalg.norm(made.normals, axis=1), 1.0)
    corners = made.vertices[made.faces]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    proper = np.linalg.norm(across, axis=1) > 1e-12
    centre = made.vertices.mean(axis=0)
    outward = np.einsum("fi,fi->f", across, corners.mean(axis=1) - centre)
    assert (outward[proper] > 0.0).all()
    assert (np.einsum("fi,fi->f", across, made.normals[made.faces[:, 0]])[proper] > 0.0).all()


def test_sizes():
    made = surface(Part("world", "tapered", (0.2, 0.1, 0.5), "#000000")).vertices
    assert np.allclose([made[:, 2].min(), made[:, 2].max()], [-0.45, 0.35])
    ball = surface(Part("world", "tapered", (0.3, 0.1, 0.1), "#000000")).vertices
    assert np.allclose(np.linalg.norm(ball - [0.0, 0.0, -0.05], axis=1), 0.3)


def test_a_cloud_has_no_surface():
    with pytest.raises(ValueError, match="points"):
        surface(Part("world", "points", (0.1,), "#000000"))
