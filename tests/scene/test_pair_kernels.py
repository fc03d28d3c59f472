import numpy as np
import pytest

from dualarm_repro.scene import Capsule, HalfSpace, signed_distance
from dualarm_repro.scene.pair_kernels import capsules_boxes, capsules_capsules, capsules_planes
from examples import random_box

RNG_SEED = 0
N, C = 20, 5


def cores(rng):
    """Capsules of cores from a point to a metre: what is short must not count as a point."""
    middles, lengths = 0.5 * rng.normal(size=(N, C, 1, 3)), np.array([0.0, 0.01, 0.1, 0.5, 1.0])
    along = rng.normal(size=(N, C, 1, 3)) * lengths[:, np.newaxis, np.newaxis]
    return middles + along * np.array([[-0.5], [0.5]]), rng.uniform(0.02, 0.2, C)


def capsule_case(rng):
    ends, radius = cores(rng)
    return (ends, radius), lambda n, j: Capsule(*ends[n, j], radius[j]), capsules_capsules


def box_case(rng):
    ends, radius = cores(rng)
    boxes = [[random_box(rng) for _ in range(C)] for _ in range(N)]
    half = np.array([box.half for box in boxes[0]])
    poses = np.array([[box.pose for box in row] for row in boxes])

    def box(n, j):
        return type(boxes[n][j])(boxes[n][j].center, 2 * half[j], boxes[n][j].rotation)

    return (ends, radius, poses, half), box, capsules_boxes


def plane_case(rng):
    ends, radius = cores(rng)
    planes = [HalfSpace(rng.normal(size=3), rng.normal()) for _ in range(C)]
    rows = np.array([plane.plane for plane in planes])
    return (ends, radius, rows), lambda n, j: planes[j], capsules_planes


@pytest.mark.parametrize("case", [capsule_case, box_case, plane_case])
def test_batch_equals_single_pairs(case):
    arrays, second, kernel = case(np.random.default_rng(RNG_SEED))
    pairs = np.array([(i, j) for i in range(C) for j in range(C) if i != j])
    distance, witness = np.empty((N, len(pairs))), np.empty((N, len(pairs), 3, 3))
    kernel(*arrays, pairs, distance, witness, 0)
    for n in range(N):
        for k, (i, j) in enumerate(pairs):
            first = Capsule(*arrays[0][n, i], arrays[1][i])
            single = signed_distance(first, second(n, j))
            assert distance[n, k] == pytest.approx(single.distance, abs=1e-14)
            np.testing.assert_allclose(witness[n, k], np.stack(single[1:]), atol=1e-12)


@pytest.mark.parametrize("case", [capsule_case, box_case, plane_case])
def test_distances_are_the_same_without_witnesses(case):
    arrays, _, kernel = case(np.random.default_rng(RNG_SEED))
    pairs = np.array([(i, j) for i in range(C) for j in range(C)])
    full, bare = np.empty((2, N, len(pairs)))
    kernel(*arrays, pairs, full, np.empty((N, len(pairs), 3, 3)), 0)
    kernel(*arrays, pairs, bare, np.empty((0, 0, 3, 3)), 0)
    np.testing.assert_allclose(bare, full, atol=1e-14)
    assert full.min() < 0 < full.max()


@pytest.mark.parametrize("case", [capsule_case, box_case, plane_case])
def test_only_the_columns_of_the_pairs_are_filled(case):
    arrays, _, kernel = case(np.random.default_rng(RNG_SEED))
    pairs = np.array([(0, 1), (2, 0)])
    for size in (0, 5):
        distance, witness = np.full((N, 5), 7.0), np.full((N if size else 0, size, 3, 3), 7.0)
        kernel(*arrays, pairs, distance, witness, 2)
        alone, points = np.empty((N, 2)), np.empty((N if size else 0, min(size, 2), 3, 3))
        kernel(*arrays, pairs, alone, points, 0)
        assert (distance[:, [0, 1, 4]] == 7.0).all()
        np.testing.assert_array_equal(distance[:, 2:4], alone)
        np.testing.assert_array_equal(witness[:, 2:4], points)
        assert not size or (witness[:, [0, 1, 4]] == 7.0).all()
