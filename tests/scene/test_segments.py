import numpy as np
import pytest
from hypothesis import given

from dualarm_repro.scene.segments import closest_parameters, segment_segment
from examples import points, thorough


def call(function, a, b):
    """Kernels take start and direction of each segment as tuples."""
    a, b = np.array(a, dtype=float), np.array(b, dtype=float)
    return function(*map(tuple, (a[0], a[1] - a[0], b[0], b[1] - b[0])))


def segment_segment_reference(a: np.ndarray, b: np.ndarray) -> float:
    """Distance of two segments (2, 3), in the fewest ideas: an end is nearest, or the lines are.

    Readable yardstick for :func:`closest_parameters`; it is not meant for nearly parallel segments
    that cross.
    """

    def to_segment(p: np.ndarray, start: np.ndarray, end: np.ndarray) -> float:
        u = end - start
        s = np.clip((p - start) @ u / (u @ u), 0, 1) if u.any() else 0.0
        return float(np.linalg.norm(start + s * u - p))

    ends = [to_segment(p, *b) for p in a] + [to_segment(p, *a) for p in b]
    A = np.column_stack([a[1] - a[0], b[0] - b[1]])
    (s, t), _, rank, _ = np.linalg.lstsq(A, b[0] - a[0])
    if rank == 2 and 0 <= s <= 1 and 0 <= t <= 1:
        ends.append(float(np.linalg.norm(a[0] - b[0] + A @ [s, t])))
    return min(ends)


def test_agrees_with_the_reference_on_random_segments():
    rng = np.random.default_rng(0)
    for a, b in rng.normal(size=(3000, 2, 2, 3)):
        found = call(segment_segment, a, b)[0]
        assert found == pytest.approx(segment_segment_reference(a, b), abs=1e-13)


def test_agrees_with_the_reference_where_everything_is_aligned():
    """Shared ends, one line, parallel, crossing, of length zero."""
    rng = np.random.default_rng(2)
    for a, b in rng.integers(-2, 3, (4000, 2, 2, 3)):
        found = call(segment_segment, a, b)[0]
        assert found == pytest.approx(segment_segment_reference(a, b), abs=1e-12)


def test_no_sampled_pair_of_points_is_nearer():
    rng = np.random.default_rng(1)
    s = np.linspace(0, 1, 60)
    for a, b in rng.normal(size=(200, 2, 2, 3)):
        on_a, on_b = (x[0] + s[:, None] * (x[1] - x[0]) for x in (a, b))
        sampled = np.linalg.norm(on_a[:, None] - on_b[None], axis=2).min()
        found = call(segment_segment, a, b)[0]
        assert found <= sampled + 1e-14
        assert found >= sampled - 0.1


@given(points, points, points, points)
@thorough
def test_witnesses_lie_on_the_segments_and_carry_the_normal(a0, a1, b0, b1):
    distance, p, q, normal = call(segment_segment, (a0, a1), (b0, b1))
    s, t = call(closest_parameters, (a0, a1), (b0, b1))
    assert 0 <= s <= 1
    assert 0 <= t <= 1
    np.testing.assert_allclose(p, (1 - s) * np.array(a0) + s * np.array(a1), atol=1e-14)
    np.testing.assert_allclose(q, (1 - t) * np.array(b0) + t * np.array(b1), atol=1e-14)
    np.testing.assert_allclose(np.add(p, distance * np.array(normal)), q, atol=1e-9)
    assert np.linalg.norm(normal) == pytest.approx(1, abs=1e-12)


@given(points, points, points)
@thorough
def test_a_point_is_a_segment_of_length_zero(p, b0, b1):
    distance = call(segment_segment, (p, p), (b0, b1))[0]
    assert distance == pytest.approx(
        segment_segment_reference(np.array([p, p]), np.array([b0, b1])), abs=1e-13
    )
    assert distance == pytest.approx(call(segment_segment, (b0, b1), (p, p))[0], abs=1e-13)


def test_two_points():
    distance, _, _, normal = call(segment_segment, [[1, 2, 3]] * 2, [[1, 2, 5]] * 2)
    assert distance == 2
    assert normal == (0, 0, 1)


@pytest.mark.parametrize(
    ("b", "s", "t", "distance"),
    [
        ([[0.25, 1, 0], [1.25, 1, 0]], 0.625, 0.375, 1),  # overlap 0.25 ... 1
        ([[1.25, 1, 0], [0.25, 1, 0]], 0.625, 0.625, 1),  # the same, reversed
        ([[3, 0, 0], [2, 0, 0]], 1, 1, 1),  # one behind the other
        ([[0.4, 0, 2], [0.6, 0, 2]], 0.5, 0.5, 2),  # one within the other
    ],
)
def test_parallel_segments_touch_in_the_middle_of_the_common_stretch(b, s, t, distance):
    a = [[0, 0, 0], [1, 0, 0]]
    assert call(closest_parameters, a, b) == pytest.approx((s, t))
    assert call(closest_parameters, b, a) == pytest.approx((t, s))
    assert call(segment_segment, a, b)[0] == pytest.approx(distance)


@pytest.mark.parametrize("angle", [1e-3, 1e-6, 1e-8, 1e-9, 1e-11, 1e-13])
def test_nearly_parallel_segments_that_cross(angle):
    """They meet away from their middles, where the parallel rule would not look."""
    rng = np.random.default_rng(3)
    for _ in range(100):
        middle, u = rng.normal(size=(2, 3))
        v = u + angle * np.cross(u, rng.normal(size=3))
        a, b = [middle - 0.2 * u, middle + 1.8 * u], [middle - 0.9 * v, middle + 1.1 * v]
        assert call(segment_segment, a, b)[0] < 1e-9


def test_normal_of_crossing_cores_is_normal_to_both():
    rng = np.random.default_rng(4)
    for _ in range(200):
        middle, u, v = rng.normal(size=(3, 3))
        a, b = [middle - u, middle + u], [middle - v, middle + v]
        distance, _, _, normal = call(segment_segment, a, b)
        assert distance < 1e-12
        assert abs(np.dot(normal, u)) < 1e-9
        assert abs(np.dot(normal, v)) < 1e-9
        assert np.linalg.norm(normal) == pytest.approx(1, abs=1e-12)


def test_normal_of_coinciding_cores():
    a = [[0, 0, 0], [2, 0, 0]]
    _, p, q, normal = call(segment_segment, a, a)
    assert p == q == (1, 0, 0)
    assert np.dot(normal, [1, 0, 0]) == 0
    assert np.linalg.norm(normal) == 1
    assert call(segment_segment, [[1, 1, 1]] * 2, [[1, 1, 1]] * 2)[3] == (0, 0, 1)
