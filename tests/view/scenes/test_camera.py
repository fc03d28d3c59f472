"""The camera sees all of the action and wastes little of the picture."""

import numpy as np
import pytest

from dualarm_repro.view.scenes.camera import framed


@pytest.mark.parametrize("direction", [(3.0, -3.0, 2.0), (0.7, -3.2, 2.0), (0.0, 0.0, 1.0)])
@pytest.mark.parametrize("size", [(1.0, 1.0, 1.0), (3.0, 0.2, 0.4), (0.1, 0.1, 2.0)])
def test_points_fill_the_picture(direction, size):
    points = np.random.default_rng(3).random((400, 3)) * size + [5.0, -2.0, 1.0]
    seen = framed(np.array(direction), points).project(points)
    assert (seen[:, 2] > 0).all()
    assert abs(seen[:, :2]).max() < 1.0
    assert max(np.ptp(seen[:, 0]), np.ptp(seen[:, 1])) > 1.6  # of 2


def test_up_stays_up():
    camera = framed(np.array([1.0, 1.0, 1.0]), np.eye(3))
    low, high = camera.project(np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 1.0]]))
    assert high[1] > low[1]
