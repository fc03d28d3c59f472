"""Energy over speed, each measure with its unit."""

import numpy as np
import pytest

from dualarm_repro.view.effort_figure import effort_figure

SPEED, ENERGY = np.array([0.1, 0.4, 0.9]), np.array([3.0, 1.0, 7.5])


@pytest.mark.parametrize(
    ("measure", "label"),
    [("work", "work of the drives [J]"), ("driven", "driving work [J]"),
     ("heat", "integral of squared torque [N$^2$m$^2$s]")],
)  # fmt: skip
def test_a_point_for_each_motion(measure, label):
    (ax,) = effort_figure(SPEED, ENERGY, measure).axes
    (dots,) = ax.lines
    np.testing.assert_array_equal(
        np.column_stack(dots.get_data()), np.column_stack([SPEED, ENERGY])
    )
    assert dots.get_linestyle() == "None"
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("mean joint speed [rad/s]", label)
    assert ax.get_ylim()[0] == 0.0
    assert ax.get_ylim()[1] > ENERGY.max()


def test_a_measure_without_a_unit_is_refused():
    with pytest.raises(KeyError, match="charm"):
        effort_figure(SPEED, ENERGY, "charm")
