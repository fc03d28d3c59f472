"""Operations of a compiled function are counted, whatever it calls."""

import numpy as np

from dualarm_repro.instrument import Instrument
from dualarm_repro.planning.field.hull_obstacle import hull_track, point_hull
from dualarm_repro.scene.points import point_capsule
from dualarm_repro.scene.vectors import dot, minus


def operations(kernel, *arguments):
    return Instrument().cost(kernel, *arguments).operations


def test_operations_are_counted_through_every_function_that_is_called():
    one, other = (1.0, 2.0, 3.0), (0.5, 0.0, 2.0)
    assert operations(dot, one, other) == 5
    assert operations(minus, one, other) == 3
    assert operations(point_capsule, one, other, (0.0, 0.0, 1.0), 0.1) > 5 + 3


def test_cost_of_a_hull_grows_with_its_faces_and_that_of_a_capsule_is_fixed():
    rng = np.random.default_rng(1)
    point = (3.0, 2.0, 1.0)
    costs = []
    for count in (8, 40):
        track = hull_track(rng.normal(size=(1, count, 3)))
        costs.append(operations(point_hull, point, track.planes[0], track.triangles[0]))
    assert costs[0] < costs[1]
    capsules = {
        operations(point_capsule, point, tuple(rng.normal(size=3)), (0.0, 0.0, 1.0), 0.1)
        for _ in range(3)
    }
    assert max(capsules) < costs[0]
