import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dualarm_repro.errors import InputError
from dualarm_repro.scene import densify
from examples import seeds, thorough


@given(seeds, st.floats(0.01, 2.0))
@thorough
def test_steps_are_short_and_samples_are_kept(seed, max_step):
    rng = np.random.default_rng(seed)
    path = rng.normal(size=(rng.integers(1, 6), 3))
    q, index = densify(path, max_step)
    assert np.abs(np.diff(q, axis=0)).max(initial=0) <= max_step * (1 + 1e-12)
    whole = np.isin(index, np.arange(len(path)))
    np.testing.assert_array_equal(q[whole], path)
    assert (np.diff(index) > 0).all()
    for joint in range(3):
        straight = np.interp(index, np.arange(len(path)), path[:, joint])
        np.testing.assert_allclose(q[:, joint], straight, atol=1e-12)


def test_no_more_samples_than_needed():
    q, index = densify([[0, 0], [1, 0.2], [1, 0.2], [1, 0.3]], 0.25)
    np.testing.assert_allclose(q[:, 0], [0, 0.25, 0.5, 0.75, 1, 1, 1])
    np.testing.assert_allclose(index, [0, 0.25, 0.5, 0.75, 1, 2, 3])


def test_index_is_interpolated_with_the_path():
    q, index = densify([[0], [1], [3]], 1.0, index=[0, 10, 30])
    np.testing.assert_allclose(index, [0, 10, 20, 30])
    np.testing.assert_allclose(q[:, 0], [0, 1, 2, 3])


@pytest.mark.parametrize("step", [0, -1, np.nan, np.inf, "small"])
def test_bad_step(step):
    with pytest.raises(InputError, match=r"densify: max_step = .*finite number"):
        densify([[0], [1]], step)


def test_bad_path():
    with pytest.raises(InputError, match="JointPath: configurations"):
        densify([[0], [np.nan]], 0.1)
    with pytest.raises(InputError, match="JointPath: index"):
        densify([[0], [1]], 0.1, index=[1, 0])
