"""Curves of a search mark where the path begins and where it should end."""

import matplotlib.pyplot as plt
import numpy as np
import pytest

from dualarm_repro.view.search_curves import coordinate_figure, joint_figure

PATH = np.linspace(0.0, 1.0, 5)[:, np.newaxis] * np.arange(1.0, 7.0)


def points(figure, marker):
    """Where a marker stands in each panel that is drawn."""
    lines = [line for ax in figure.axes for line in ax.lines if line.get_marker() == marker]
    return [
        tuple(float(v[0]) for v in line.get_data()) for line in lines if line.get_ls() == "None"
    ]


@pytest.mark.parametrize(
    ("draw", "width", "unit"), [(coordinate_figure, 3, 1.0), (joint_figure, 6, 180 / np.pi)]
)
def test_start_and_goals_are_marked_in_every_panel(draw, width, unit):
    path = PATH[:, :width]
    figure = draw({"run": path}, ends={"start": (0, path[0]), "goal": (4, path[-1])})
    assert points(figure, "*") == [(4.0, pytest.approx(unit * value)) for value in path[-1]]
    starts = [at for at in points(figure, "o") if at[0] == 0.0]
    assert starts == [(0.0, 0.0)] * width
    plt.close(figure)
