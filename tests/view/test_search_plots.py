"""Plots of searches: medians that are named, bars of the printed, gaps to the truth."""

import numpy as np
import pandas as pd
import pytest

from dualarm_repro.view.search_plots import (
    best_individual_figure,
    history_figure,
    optimisers_figure,
)
from dualarm_repro.view.style import BLUE, ORANGE

from .drawn import outside, words


def test_a_history_is_named_with_the_median_of_its_last_values():
    runs = np.array([[0.0, 2.0, 4.0], [0.0, 1.0, 3.0], [0.0, 5.0, 9.0]])
    (ax,) = history_figure({"best": runs, "mean": 0 * runs}, "fitness").axes
    named = [line for line in ax.lines if not line.get_label().startswith("_")]
    assert [line.get_label() for line in named] == ["best\n4", "mean\n0"]
    assert named[0].get_ydata().tolist() == [0.0, 2.0, 4.0]
    single = [line.get_ydata().tolist() for line in ax.lines if line.get_linewidth() == 0.5]
    assert single[:3] == runs.tolist()
    band = ax.collections[0].get_paths()[0].vertices
    at = band[np.isclose(band[:, 0], 2.0), 1]
    assert (at.min(), at.max()) == (3.0, 9.0)
    low, high = ax.get_ylim()
    assert low < 0.0, "a curve that ends at zero keeps its name inside"
    assert high >= 9.0
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("generation", "fitness")
    assert outside(ax) == []


def test_the_first_run_stands_beside_the_printed_coordinates():
    best = np.array([[0.1, -0.25, 0.8], [0.12, -0.2, 0.7]])
    printed = np.array([-0.3, 0.5, 0.81])
    figure = best_individual_figure(best, printed)
    (ax,) = figure.axes
    first, said = ax.containers
    assert [bar.get_height() for bar in first] == best[0].tolist()
    assert [bar.get_height() for bar in said] == printed.tolist()
    assert first[0].get_facecolor()[:3] != said[0].get_facecolor()[:3]
    assert words(ax) == ["0.100", "-0.250", "0.800", "-0.300", "0.500", "0.810"]
    for text in ax.texts:
        above = float(text.get_text()) >= 0
        assert text.get_va() == ("bottom" if above else "top")
        assert (text.xyann[1] > 0) is above
    dots = [line for line in ax.lines if line.get_marker() == "o"]
    np.testing.assert_allclose([line.get_ydata() for line in dots], best.T)
    for k, line in enumerate(dots):
        assert (abs(line.get_xdata() - k) < 0.4).all(), "at the bars of its coordinate"
    names = [text.get_text() for text in figure.legends[0].get_texts()]
    assert sorted(names) == ["all runs", "first run", "printed"]
    assert [t.get_text() for t in ax.get_xticklabels()] == ["x", "y", "z"]


def test_optimisers_are_ranked_by_their_gap():
    table = pd.DataFrame(
        {"optimiser": ["a", "a", "a", "b"], "fitness": [1.8, 1.0, 1.9, 2.0],
         "seconds": [1.0, 2.0, 3.0, 0.5]}
    )  # fmt: skip
    figure = optimisers_figure(table, 2.0, 500)
    ax, right = figure.axes
    dots = [line for line in ax.lines if line.get_marker() == "o"]
    assert [line.get_color() for line in dots] == [BLUE, BLUE]
    np.testing.assert_allclose(dots[0].get_xdata(), [0.1, 0.5, 0.05])
    np.testing.assert_allclose(dots[1].get_xdata(), [1e-9])  # none, on a logarithmic scale
    assert (abs(dots[0].get_ydata() - 0) < 0.32).all()
    assert (abs(dots[1].get_ydata() - 1) < 0.32).all()
    medians = [line.get_xdata()[0] for line in ax.lines if line.get_linewidth() == 2]
    assert medians == pytest.approx([0.1, 1e-9])
    times = [line for line in right.lines if line.get_color() == ORANGE]
    np.testing.assert_allclose(times[0].get_xdata(), [1.0, 2.0, 3.0])
    np.testing.assert_array_equal(times[0].get_ydata(), dots[0].get_ydata())
    assert ax.get_xlabel() == "gap to the ground truth, 500 evaluations"
    assert [t.get_text() for t in ax.get_yticklabels()] == ["a", "b"]
    assert ax.get_ylim()[0] > ax.get_ylim()[1], "the first stands at the top"
    assert "0.1 %" in words(ax)
    assert right.get_xlim()[0] == 0.0
