"""Several capsules around one shape: they contain it, and are not much larger."""

import coal
import numpy as np
import pytest

from dualarm_repro.arms.capsules import to_segment
from dualarm_repro.arms.fit.capsule_kernels import covered, cut
from dualarm_repro.arms.fit.decomposition import around, decompose
from dualarm_repro.arms.fit.triangles import triangles_of


def box(*size):
    """Triangles of a box about the origin."""
    return triangles_of(coal.Box(*size))


def elbow():
    """Two bars at a right angle."""
    across, up = np.array([0.4, 0, 0]), np.array([0, 0, 0.3])
    return np.vstack([box(0.8, 0.1, 0.1) + across, box(0.1, 0.1, 0.6) + up])


def share_inside(capsules, probes):
    """Share of points that lie in some capsule."""
    inside = np.zeros(len(probes), dtype=bool)
    for start, end, radius, _ in capsules:
        covered(probes, np.array([*start, *end, radius]), inside)
    return inside.mean()


def dense(triangles, rng, count=4000):
    """Points of the surface."""
    s, t = np.sort(rng.random((2, count)), axis=0)
    a, b, c = triangles[rng.integers(len(triangles), size=count)].transpose(1, 0, 2)
    return a * s[:, None] + b * (t - s)[:, None] + c * (1 - t)[:, None]


@pytest.mark.parametrize(
    "triangles",
    [box(0.1, 0.2, 0.9), box(0.4, 0.4, 0.05), elbow(), triangles_of(coal.Cylinder(0.2, 0.1))],
    ids=["bar", "plate", "elbow", "disc"],
)
def test_surface_and_vertices_are_inside(triangles, rng):
    capsules = decompose(triangles)
    assert len(capsules) <= 10
    points = np.vstack([dense(triangles, rng), triangles.reshape(-1, 3)])
    gap = np.min([to_segment(points, a, b) - radius for a, b, radius, _ in capsules], axis=0)
    assert gap.max() <= 1e-12


def test_more_capsules_leave_less_room(rng):
    triangles = elbow()
    probes = rng.uniform((-0.4, -0.4, -0.4), (1.2, 0.4, 1.0), (200_000, 3))
    solid = 0.8 * 0.1 * 0.1 + 0.5 * 0.1 * 0.1
    volumes = [
        1.6 * 0.8 * 1.4 * share_inside(capsules, probes)
        for capsules in (
            decompose(triangles, 1, 0.1),
            decompose(triangles),
            decompose(triangles, 16, 0.006),
        )
    ]
    assert volumes[0] > 3 * volumes[1]
    assert volumes[2] <= volumes[1] * 1.02
    assert volumes[1] < 2.2 * solid


def test_inside_of_a_solid_is_covered(rng):
    capsules = decompose(box(0.4, 0.4, 0.05))
    assert share_inside(capsules, rng.uniform(-1, 1, (5000, 3)) * (0.2, 0.2, 0.025)) == 1.0


def test_a_ball_of_points_is_a_small_capsule(rng):
    points = rng.normal(size=(500, 3))
    points /= np.linalg.norm(points, axis=1)[:, None]
    start, end, radius = around(points)
    assert radius < 1.1
    assert np.linalg.norm(end - start) < 0.2
    assert to_segment(points, start, end).max() <= radius


def test_a_cut_keeps_the_surface(rng):
    triangles = elbow()
    normal = np.array([0.6, 0.0, 0.8])

    below, above = cut(triangles, normal, 0.21)
    assert (below @ normal).max() <= 0.21 + 1e-12
    assert (above @ normal).min() >= 0.21 - 1e-12
    assert _area(below) + _area(above) == pytest.approx(_area(triangles), rel=1e-12)


def test_each_capsule_contains_its_part_and_the_parts_are_the_surface():
    triangles = elbow()
    pieces = decompose(triangles)
    for start, end, radius, own in pieces:
        assert to_segment(own.reshape(-1, 3), start, end).max() <= radius + 1e-12
    area = sum(_area(piece.triangles) for piece in pieces)
    assert area == pytest.approx(_area(triangles), rel=1e-9)


def _area(part):
    edges = part[:, 1:] - part[:, :1]
    return 0.5 * np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1).sum()


@pytest.mark.parametrize(
    "points", [np.zeros((1, 3, 3)), np.array([[[0, 0, 0], [1, 0, 0], [2, 0, 0]]])]
)
def test_what_has_no_area(points):
    (start, end, radius, _), *_ = decompose(points.astype(float))
    assert np.isfinite([*start, *end, radius]).all()
    assert to_segment(points.reshape(-1, 3), start, end).max() <= radius + 1e-12
