import numpy as np
import pytest

from dualarm_repro.errors import InputError
from dualarm_repro.scene.quantities import array_of, positive, rotation3, unit3, vector3


def test_good_values_come_back_as_read_only_floats():
    v = vector3("here", "v", [1, 2, 3])
    assert v.dtype == float
    assert not v.flags.writeable
    assert positive("here", "r", np.float32(0.5)) == 0.5
    np.testing.assert_allclose(unit3("here", "n", (0, 3, 4)), (0, 0.6, 0.8))
    np.testing.assert_array_equal(rotation3("here", "R", np.eye(3)), np.eye(3))


def test_any_length_where_none_is_given():
    assert array_of("here", "path", [[1, 2], [3, 4], [5, 6]], (None, 2), "rows").shape == (3, 2)
    with pytest.raises(InputError, match=r"here: path = .*: expected rows"):
        array_of("here", "path", [[1, 2, 3]], (None, 2), "rows")


@pytest.mark.parametrize("value", [0, -1, np.nan, np.inf, [1], "x", None])
def test_not_positive(value):
    with pytest.raises(InputError, match=r"here: r = .*expected a positive finite number \[rad\]"):
        positive("here", "r", value, "rad")


@pytest.mark.parametrize("value", [[[1, 2], [3]], object(), [1, 2, "x"], ["1", "2", "3"]])
def test_not_numbers(value):
    with pytest.raises(InputError, match="here: v"):
        vector3("here", "v", value)
