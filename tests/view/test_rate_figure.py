"""What the rate of a controller costs: a curve a gain, in micrometres and millimetres."""

import numpy as np
import pandas as pd

from dualarm_repro.view.rate_figure import rate_figure

from .drawn import curves

TABLE = pd.DataFrame(
    {
        "gamma [1/s]": [5.0, 5.0, 20.0, 20.0],
        "step [s]": [1e-3, 1e-2, 1e-3, 1e-2],
        "tip error [m]": [1e-6, 1e-4, 3e-6, 3e-4],
        "distance [m]": [0.051, 0.049, 0.050, 0.02],
    }
)


def test_each_gain_has_its_curves():
    above, below = rate_figure(TABLE, 1e-5).axes
    errors, gaps = curves(above), curves(below)
    assert list(errors) == ["gamma = 5 1/s", "gamma = 20 1/s", "called accurate"]
    np.testing.assert_allclose(errors["gamma = 5 1/s"], [(1.0, 1.0), (10.0, 100.0)])
    np.testing.assert_allclose(errors["gamma = 20 1/s"], [(1.0, 3.0), (10.0, 300.0)])
    np.testing.assert_allclose(errors["called accurate"][:, 1], 10.0)
    np.testing.assert_allclose(gaps["gamma = 20 1/s"], [(1.0, 50.0), (10.0, 20.0)])
    assert (above.get_ylabel(), below.get_ylabel(), below.get_xlabel()) == (
        "largest tip error [um]", "smallest distance [mm]", "step [ms]")  # fmt: skip
    assert (above.get_xscale(), above.get_yscale(), below.get_yscale()) == ("log", "log", "linear")
    assert len({line.get_linestyle() for line in below.lines}) == 2
