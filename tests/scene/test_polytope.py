import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given

from dualarm_repro.scene import Capsule, ConvexHull, signed_distance
from dualarm_repro.scene.boxes import segment_box
from dualarm_repro.scene.polytope import segment_polytope
from examples import judged, points, random_capsule, random_placement, seeds, thorough

CUBE = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=float)


def gap_between_planes(capsule, hull, normal):
    """Width of the slab normal to ``normal`` between both shapes: no distance is smaller."""
    return (hull.vertices @ normal).min() - (capsule.core @ normal).max() - capsule.radius


def test_the_normal_certifies_the_distance():
    """In separation and penetration, through contact of the core with faces, edges and corners."""
    rng = np.random.default_rng(1)
    hull = ConvexHull(0.3 * rng.normal(size=(40, 3)))
    for _ in range(300):
        capsule = random_capsule(rng)
        found = signed_distance(capsule, hull)
        assert gap_between_planes(capsule, hull, found.normal) == pytest.approx(
            found.distance, abs=1e-9
        )
        for core_gap in (1e-3, 1e-6, 1e-9, 0.0, -1e-9, -1e-6, -1e-3):
            advance = (found.distance + capsule.radius - core_gap) * found.normal
            moved = capsule.moved(pin.SE3(np.eye(3), advance))
            near = signed_distance(moved, hull)
            # Rounding of the witness points turns the normal of a tiny gap.
            tolerance = 1e-9 + 1e-15 / max(abs(near.distance + moved.radius), 1e-10)
            gap = gap_between_planes(moved, hull, near.normal)
            assert gap == pytest.approx(near.distance, abs=tolerance)


def test_agrees_with_coal_in_depth():
    rng = np.random.default_rng(2)
    hull = ConvexHull(0.4 * rng.normal(size=(25, 3)))
    deep = 0
    for _ in range(500):
        capsule = random_capsule(rng, 0.15)
        found = signed_distance(capsule, hull).distance
        assert found == pytest.approx(judged(capsule, hull)[0], abs=1e-9)
        deep += found < -capsule.radius - 0.01
    assert deep > 200


@given(seeds, points, points)
@thorough
def test_witnesses(seed, a, u):
    rng = np.random.default_rng(seed)
    hull = ConvexHull(rng.normal(size=(10, 3)))
    distance, p, q, normal = segment_polytope(a, u, hull.polytope)
    np.testing.assert_allclose(np.add(p, distance * np.array(normal)), q, atol=1e-9)
    heights = hull.polytope.planes[:, :3] @ q + hull.polytope.planes[:, 3]
    assert heights.max() == pytest.approx(0, abs=1e-9)  # q is on the surface
    along = np.subtract(p, a) @ u / max(np.dot(u, u), 1e-300)
    np.testing.assert_allclose(np.add(a, np.clip(along, 0, 1) * np.array(u)), p, atol=1e-12)


@pytest.mark.parametrize(
    ("start", "end", "distance", "point"),
    [
        ((-2, 0, 1.5), (2, 0, 1.5), 0.5, None),  # over the top
        ((0, 0, 0), (0, 0, 0), -1, None),  # center
        ((0.2, 0.3, 0.0), (0.2, 0.3, 5), -0.7, (0.2, 0.3, 0.5)),  # sideways out is shorter
        ((0.2, 0.3, 0.9), (-0.4, 0.1, 0.9), -0.1, (-0.1, 0.2, 0.9)),  # level: its middle
        ((-5, 0, 0.9), (5, 0, 0.9), -0.1, (0, 0, 0.9)),  # level and sticking out on both sides
        ((2, 2, 0), (3, 2, 0), np.sqrt(2), (2, 2, 0)),  # beside an edge
        ((2, 3, 3), (2, 2, 2), np.sqrt(3), (2, 2, 2)),  # off a corner
        ((1.5, 0, 1.5), (1.5, 0.2, 1.5), np.sqrt(0.5), None),  # along an edge
    ],
)
def test_cube(start, end, distance, point):
    hull = ConvexHull(CUBE)
    found = signed_distance(Capsule(start, end, 0.25), hull)
    assert found.distance == pytest.approx(distance - 0.25, abs=1e-12)
    if point is not None:
        core_point = found.point_a - 0.25 * found.normal
        np.testing.assert_allclose(core_point, point, atol=1e-9)


def test_a_segment_across_an_edge_leaves_over_the_edge():
    """The exit is normal to the edge and to the segment, not to a face."""
    hull = ConvexHull(CUBE)
    start, end = np.array([0.5, -2.0, 1.2]), np.array([1.2, 2.0, 0.5])
    found = signed_distance(Capsule(start, end, 0.01), hull)
    assert found.distance < -0.01
    assert np.abs(found.normal).max() < 0.99
    assert found.normal @ (end - start) == pytest.approx(0, abs=1e-9)
    assert found.distance == pytest.approx(judged(Capsule(start, end, 0.01), hull)[0], abs=1e-9)


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize("off", [0.0, 1e-15, 1e-9, 1e-6])
def test_a_box_and_its_hull_agree_where_everything_is_aligned(off, turned):
    """Grid coordinates, exact and nearly so: parallel edges, shared planes, ties of every kind."""
    rng = np.random.default_rng(3)
    for size in ((1, 1, 1), (1, 0.5, 1.5), (2, 1, 0.5)):
        h = tuple(0.5 * np.array(size))
        R = random_placement(rng).rotation if turned else np.eye(3)
        hull = ConvexHull(CUBE * h @ R.T).polytope
        for a, u in 0.25 * rng.integers(-6, 7, (600, 2, 3)) + off * rng.normal(size=(600, 2, 3)):
            by_box = segment_box(tuple(a), tuple(u), h)
            distance, *points = segment_polytope(tuple(R @ a), tuple(R @ u), hull)
            by_hull = distance, *(np.array(point) @ R for point in points)
            assert by_box[0] == pytest.approx(by_hull[0], abs=1e-10)
            for distance, p, q, normal in (by_box, by_hull):
                np.testing.assert_allclose(np.add(p, distance * np.array(normal)), q, atol=1e-9)
                assert (np.abs(q) - h).max() == pytest.approx(0, abs=1e-8)  # on the surface
                ends = np.array([a, a + u]) @ normal
                between_planes = -np.abs(normal) @ np.array(h) - ends.max()
                # The normal of a tiny gap is turned by the rounding of its ends.
                tolerance = 1e-7 + 1e-15 / max(abs(distance), 1e-10)
                assert between_planes == pytest.approx(distance, abs=tolerance)


@pytest.mark.parametrize("off", [0.0, 1e-16, 1e-12, 1e-8])
def test_segments_along_the_edges_and_through_the_corners_of_a_hull(off):
    """Parallel to an edge up to rounding, edge x u has no direction: no gap may come out of it."""
    rng = np.random.default_rng(4)
    for _ in range(20):
        hull = ConvexHull(rng.normal(size=(9, 3)))
        v = hull.vertices
        features = np.vstack([v, v[hull.faces].mean(axis=1), v[hull.polytope.edges].mean(axis=1)])
        for _ in range(100):
            first, second = features[rng.integers(len(features), size=2)]
            low, high = rng.choice([-1.0, -0.5, 0.0, 0.5, 1.0, 2.0], 2)
            a, b = (first + s * (second - first) for s in (low, high))
            lifted = rng.choice([0.0, 0.5]) * rng.normal(size=3)  # touching, or parallel at a gap
            a, u = a + lifted + off * rng.normal(size=3), b - a + off * rng.normal(size=3)
            distance, p, q, normal = segment_polytope(tuple(a), tuple(u), hull.polytope)
            np.testing.assert_allclose(np.add(p, distance * np.array(normal)), q, atol=1e-9)
            heights = hull.polytope.planes[:, :3] @ q + hull.polytope.planes[:, 3]
            assert heights.max() == pytest.approx(0, abs=1e-7)  # like the normal of a tiny depth
            between_planes = (v @ normal).min() - (np.array([a, a + u]) @ normal).max()
            tolerance = 1e-7 + 1e-14 / max(abs(distance), 1e-10)
            assert between_planes == pytest.approx(distance, abs=tolerance)
