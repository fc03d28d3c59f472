"""Arms as bodies: tubes and outlines have the radii that collision checks use."""

import matplotlib.pyplot as plt
import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from dualarm_repro.arms import load_arm
from dualarm_repro.scene import PlacedArm
from dualarm_repro.view.link_bodies import Body, _tube, capsules_at, draw_flat, draw_in_space
from dualarm_repro.view.style import MASTER, axes_3d

Q = np.array([0.3, -0.4, 0.5, 0.2, -0.4, 0.1])
BASE = pin.SE3(pin.rpy.rpyToMatrix(0.0, 0.0, 1.1), np.array([0.4, -0.7, 0.3]))


@pytest.fixture(scope="module")
def body():
    return Body(PlacedArm("arm", load_arm("irb120"), BASE), Q, MASTER, 7)


def test_capsules_are_those_of_the_geometry(body):
    """Ends by Pinocchio's own placement of the collision geometry."""
    arm = body.placed.arm
    data, geometry = arm.model.createData(), arm.geometry.createData()
    pin.updateGeometryPlacements(arm.model, data, arm.geometry, geometry, Q)
    ends, radii = capsules_at(body)
    expected = set()
    for shape, pose in zip(arm.geometry.geometryObjects, geometry.oMg, strict=True):
        half = shape.geometry.halfLength
        tips = [(BASE * pose).act(np.array([0.0, 0.0, s * half])).round(9) + 0.0 for s in (-1, 1)]
        expected.add((frozenset(map(tuple, tips)), round(shape.geometry.radius, 9)))
    found = {
        (frozenset(tuple(tip.round(9) + 0.0) for tip in pair), round(float(radius), 9))
        for pair, radius in zip(ends, radii, strict=True)
    }
    assert found == expected


POINTS = st.tuples(*[st.floats(-1.0, 1.0, allow_nan=False)] * 3).map(np.array)


@settings(max_examples=30)
@given(POINTS, POINTS, st.floats(0.01, 0.3))
def test_corners_of_a_tube_lie_at_its_radius(start, end, radius):
    way = end - start
    length = np.linalg.norm(way)
    if length < 1e-6:
        end, way, length = start, np.array([0.0, 0.0, 1.0]), 1.0
    faces = _tube(start, end, radius)
    corners = np.vstack(faces)
    away = corners - start
    across = away - np.outer(away @ way, way) / length**2
    np.testing.assert_allclose(np.linalg.norm(across, axis=1), radius, atol=1e-9)
    for one, following in zip(faces, [*faces[1:], faces[0]], strict=True):
        np.testing.assert_allclose(one[[1, 2]], following[[0, 3]], atol=1e-9)
    along = np.sort(away @ way / length)
    assert along[0] == pytest.approx(-0.5 * radius if end is start else 0.0, abs=1e-9)
    assert along[-1] == pytest.approx(0.5 * radius if end is start else length)


def test_an_arm_in_space_is_one_faint_collection(body):
    _, ax = axes_3d()
    draw_in_space(ax, body, alpha=0.4)
    (drawn,) = ax.collections
    assert isinstance(drawn, Poly3DCollection)
    assert drawn.get_alpha() == 0.4


@pytest.mark.parametrize("pair", [[0, 1], [1, 2], [0, 2]])
def test_outlines_enclose_their_links_and_no_more(body, pair):
    _, ax = plt.subplots()
    draw_flat(ax, body, pair)
    ends, radii = capsules_at(body)
    paths = ax.collections[0].get_paths()
    assert len(paths) == len(radii)
    for path, link, radius in zip(paths, ends[:, :, pair], radii, strict=True):
        gaps = np.linalg.norm(path.vertices[:, np.newaxis] - link, axis=2)
        np.testing.assert_allclose(abs(gaps - radius).min(axis=1), 0.0, atol=1e-9)
        # corners 22.5 degrees apart leave at most 2 % of the radius between them
        assert gaps.min() > 0.98 * radius
        assert path.contains_points(link, radius=1e-9).all()
