"""Hulls by gift wrapping against qhull, by what a hull is, and point sets that tempt it to fail."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial import ConvexHull
from two_spheres import GOAL, START, placed_arm

from dualarm_repro.errors import InputError
from dualarm_repro.planning.field.gift_wrapping import MOST, wrap_hulls
from dualarm_repro.planning.field.hull_obstacle import (
    JointCircles,
    circles_on,
    hull_distance,
    hull_track,
    point_hull,
)

GRID = np.stack(np.meshgrid(*[np.arange(4.0)] * 3), axis=-1).reshape(-1, 3)
RADII = (0.09, 0.09, 0.075, 0.065, 0.05, 0.04)


def wrapped(points):
    planes, triangles = np.empty((1, 2 * len(points), 4)), np.empty((1, 2 * len(points), 3, 3))
    count = np.empty(1, dtype=np.int64)
    wrap_hulls(points[np.newaxis], planes, triangles, count)
    return planes[0, : count[0]], triangles[0, : count[0]]


def turned(points, rng):
    return points @ np.linalg.qr(rng.normal(size=(3, 3)))[0] + rng.normal(size=3)


def assert_is_hull(points, planes, triangles):
    """All points inside all planes, the surface closed, convex and as large as that of qhull."""
    hull, extent = ConvexHull(points), np.ptp(points, axis=0).max()
    assert (points @ planes[:, :3].T + planes[:, 3]).max() < 1e-11 * extent
    assert np.linalg.norm(planes[:, :3], axis=1) == pytest.approx(1.0, abs=1e-12)
    corners = np.einsum("fkr,fr->fk", triangles, planes[:, :3]) + planes[:, 3:]
    assert np.abs(corners).max() < 1e-11 * extent
    known = {tuple(row): k for k, row in enumerate(np.unique(triangles.reshape(-1, 3), axis=0))}
    faces = [[known[tuple(corner)] for corner in one] for one in triangles]
    edges = [(one[k], one[(k + 1) % 3]) for one in faces for k in range(3)]
    assert len(set(edges)) == len(edges)
    assert {(j, i) for i, j in edges} == set(edges)
    assert len(known) - len(edges) // 2 + len(faces) == 2
    a, b, c = (triangles[:, k] - points.mean(axis=0) for k in range(3))
    volume = np.einsum("fr,fr->", a, np.cross(b, c)) / 6.0
    assert volume == pytest.approx(hull.volume, rel=1e-9)
    normals = np.cross(b - a, c - a)
    assert (np.einsum("fr,fr->f", normals, planes[:, :3]) > 0.0).all()
    directions = np.random.default_rng(1).normal(size=(50, 3))
    support = (directions @ triangles.reshape(-1, 3).T).max(axis=1)
    assert support == pytest.approx((directions @ points.T).max(axis=1), abs=1e-11 * extent)


def sets():
    rng = np.random.default_rng(7)
    ring = np.array([[np.cos(a), np.sin(a), 0.0] for a in np.arange(12) * np.pi / 6])
    prism = np.vstack([ring, ring + np.array([0.0, 0.0, 0.4])])
    return {
        "grid": GRID,
        "every point of a grid twice": np.vstack([GRID, GRID]),
        "turned grid": turned(GRID, rng),
        "small grid far away": 1e-3 * turned(GRID, rng) + 5.0,
        "prism": prism,
        "turned prism": turned(prism, rng),
        "cone": turned(np.vstack([ring, [[0.3, 0.1, 2.0]]]), rng),
        "tetrahedron": rng.normal(size=(4, 3)),
        "points of a ball and inside": np.vstack(
            [(ball := rng.normal(size=(60, 3))) / np.linalg.norm(ball, axis=1)[:, None], 0.1 * ball]
        ),
        "needle": turned(GRID * [1.0, 1e-3, 1e-3], rng),
    }


@pytest.mark.parametrize("name", sets())
def test_point_sets_with_many_points_in_one_plane(name):
    points = sets()[name]
    assert_is_hull(points, *wrapped(points))


@given(
    seed=st.integers(0, 10**6),
    count=st.integers(6, 60),
    levels=st.integers(2, 5),
    turn=st.booleans(),
)
def test_points_drawn_from_a_grid(seed, count, levels, turn):
    rng = np.random.default_rng(seed)
    points = rng.integers(0, levels, (count, 3)).astype(float)
    flat = np.linalg.matrix_rank(points - points[0]) < 3
    if turn:
        points = turned(0.1 * points, rng)
    planes, triangles = wrapped(points)
    if flat:
        assert len(planes) == 0
    else:
        assert_is_hull(points, planes, triangles)


@given(seed=st.integers(0, 10**6), count=st.integers(4, 80))
def test_points_in_general_position(seed, count):
    points = np.random.default_rng(seed).normal(size=(count, 3))
    planes, triangles = wrapped(points)
    assert_is_hull(points, planes, triangles)
    assert len(planes) == len(ConvexHull(points).simplices)


@given(seed=st.integers(0, 10**6), containing=st.booleans())
def test_hulls_of_arms_keep_the_distances_of_qhull(seed, containing):
    rng, placed = np.random.default_rng(seed), placed_arm()
    circles = JointCircles((1, 2, 3, 4, 5, 7), RADII, 12, containing)
    drawn = placed.arm.random_configurations(2, rng)
    points = circles_on(placed, circles, np.vstack([START, GOAL, drawn]))
    track = hull_track(points)
    for row, planes, triangles in zip(points, *track, strict=True):
        hull = ConvexHull(row)
        for point in row.mean(axis=0) + rng.normal(0.0, 0.3, (10, 3)):
            ours, away = point_hull(tuple(point), planes, triangles)
            theirs, gradient = point_hull(tuple(point), hull.equations, row[hull.simplices])
            assert ours == pytest.approx(theirs, abs=1e-12)
            if ours > 0.0:  # inside, two planes can be equally near
                assert away == pytest.approx(gradient, abs=1e-9 / min(ours, 1.0))


def test_a_row_with_fewer_faces_repeats_its_last_one():
    few, many = np.zeros((20, 3)), np.random.default_rng(3).normal(size=(20, 3))
    few[:4] = np.eye(4)[:, :3]
    track = hull_track(np.stack([few, many]))
    assert len(track.planes[0]) == len(ConvexHull(many).simplices) > 4
    for part in track:
        assert part.flags.c_contiguous
        assert (part[0, 4:] == part[0, 3]).all()
    assert len(hull_track(np.empty((0, 20, 3))).planes) == 0


def test_more_points_than_are_wrapped_are_left_to_qhull():
    points = np.random.default_rng(4).normal(size=(1, MOST + 1, 3))
    track = hull_track(points)
    assert (track.planes[0] == ConvexHull(points[0]).equations).all()


@pytest.mark.parametrize(
    "points",
    [
        GRID[GRID[:, 2] == 0.0],
        turned(GRID[GRID[:, 2] == 0.0], np.random.default_rng(2)),
        np.linspace(0.0, 1.0, 9)[:, np.newaxis] * [1.0, 2.0, 3.0],
        np.ones((8, 3)),
    ],
    ids=["plane", "turned plane", "line", "one point"],
)
def test_points_without_a_volume_are_refused_in_one_line(points):
    with pytest.raises(InputError, match="do not lie in one plane"):
        hull_track(np.asarray(points)[np.newaxis])


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf, 1e160])
@pytest.mark.parametrize("axis", [0, 1, 2])
def test_no_point_that_is_no_number_is_left_out(axis, bad):
    for k in range(len(GRID)):
        points = GRID.astype(float)
        points[k, axis] = bad
        with pytest.raises(InputError, match="finite numbers of at most"):
            hull_track(points[np.newaxis])


@pytest.mark.parametrize("shape", [(8, 3), (1, 8, 2), (1, 8, 4), (1, 3, 3), (1, 0, 3)])
def test_points_of_another_shape_are_refused(shape):
    with pytest.raises(InputError, match="at least four points"):
        hull_track(np.random.default_rng(0).random(shape))


@given(st.integers(0, 2**32 - 1), st.sampled_from([1e-15, 1e-12, 1e-9]))
def test_points_on_the_surface_are_at_no_distance(seed, noise):
    """Corners, middles of edges and of faces, where round-off decides on which side of a face they
    lie; the circles are as even as round-off leaves them."""
    rng = np.random.default_rng(seed)
    turns = np.linspace(0.0, 2.0 * np.pi, 12, endpoint=False)
    circle = np.column_stack([np.cos(turns), np.sin(turns), 0.0 * turns])
    circles = [
        radius * circle + [0.0, 0.0, z] for radius, z in ((0.1, 0.0), (0.1, 0.3), (0.07, 0.5))
    ]
    points = turned(np.vstack(circles), rng) + noise * rng.normal(size=(36, 3))
    planes, triangles = (part[0] for part in hull_track(points[np.newaxis]))
    a, b, c = np.swapaxes(triangles, 0, 1)
    corners = np.unique(triangles.reshape(-1, 3), axis=0)
    for point in np.vstack([corners, 0.5 * (a + b), (a + b + c) / 3.0]):
        distance, direction = point_hull(tuple(point), planes, triangles)
        assert abs(distance) < 1e-9
        assert np.linalg.norm(direction) == pytest.approx(1.0, abs=1e-9)
        assert distance == pytest.approx(hull_distance(point, planes, triangles)[0], abs=1e-9)
