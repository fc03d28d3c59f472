"""Joint vectors: a continuous joint goes the short way round."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from dualarm_repro.arms.joint_space import JointSpace
from dualarm_repro.arms.joint_type import JointType
from dualarm_repro.errors import ConfigurationError


@pytest.fixture
def space():
    """A joint that turns for ever, one that does not, one that slides."""
    kinds = (JointType.CONTINUOUS, JointType.REVOLUTE, JointType.PRISMATIC)
    return JointSpace("a", kinds, np.array([-np.inf, -4, 0]), np.array([np.inf, 4, 1.0]))


@pytest.mark.parametrize(
    ("start", "end", "way"),
    [(3.0, -3.0, 2 * np.pi - 6), (0.1, 0.4, 0.3), (0, 20.0, 20 - 6 * np.pi)],
)
def test_the_short_way(start, end, way, space):
    assert_allclose(space.difference([start, 3, 0], [end, -3, 0.5]), (way, -6, 0.5))
    assert_allclose(space.nearest([end, -3, 0.5], [start, 3, 0]), (start + way, -3, 0.5))
    assert_allclose(space.distance([start, 0, 0], [end, 0, 0]), abs(way))
    assert_allclose(space.distance([[start, 0, 0]] * 2, [[end, 0, 0]] * 2), [abs(way)] * 2)


def test_ranges(space, rng):
    assert_allclose(space.usual_range, ((-np.pi, -4, 0), (np.pi, 4, 1)))
    assert np.isfinite(space.random_configurations(100, rng)).all()
    assert space.within_limits([1e3, 0, 0.5])
    assert not space.within_limits([0, 0, 1.5])
    with pytest.raises(ConfigurationError):
        space.difference([np.nan, 0, 0], [0, 0, 0])
