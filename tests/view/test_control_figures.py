"""Figures of velocity control: curves in their units, times and steps as they are told."""

import numpy as np
import pinocchio as pin
import pytest

from dualarm_repro.arms import load_arm
from dualarm_repro.scene import PlacedArm
from dualarm_repro.view import control_figures as figures
from dualarm_repro.view.crossing import Crossing
from dualarm_repro.view.link_bodies import Body
from dualarm_repro.view.style import GREEN, MASTER, PURPLE, SLAVE

from .drawn import curves, outside, words

TIMES = np.linspace(0.0, 2.0, 5)
RANGES = (0.05, 0.2)


@pytest.fixture(scope="module")
def crossing():
    bodies = [
        Body(PlacedArm(name, load_arm("irb120"), pin.SE3(np.eye(3), np.array([0.0, y, 0.0]))),
             np.full(6, 0.2), color, 0)
        for name, y, color in (("left", 0.0, MASTER), ("right", 0.7, SLAVE))
    ]  # fmt: skip
    nearest = np.array([[0.1, 0.2, 0.4], [0.1, 0.5, 0.4]])
    return Crossing(tuple(bodies), (np.eye(3), np.eye(3) + 0.5), nearest)


def test_distances_are_compared_in_millimetres(crossing):
    found = {
        "without": (TIMES, np.array([0.3, 0.1, -0.04, 0.1, 0.2])),
        "with": (TIMES, np.array([0.3, 0.2, 0.061, 0.2, 0.2])),
    }
    figure = figures.comparison_figure(found, {"without": crossing, "other": crossing}, RANGES)
    *spaces, ax = figure.axes
    assert [one.get_title() for one in spaces] == ["without: -40 mm", "other"]
    drawn = curves(ax)
    np.testing.assert_allclose(
        drawn["without"], np.column_stack([TIMES, 1e3 * found["without"][1]])
    )
    np.testing.assert_allclose(drawn["with"][:, 1], 1e3 * found["with"][1])
    assert drawn["inner range"][:, 1].tolist() == [50.0, 50.0]
    assert drawn["outer range"][:, 1].tolist() == [200.0, 200.0]
    dots = {tuple(map(float, np.ravel(line.get_data()))): line.get_color()
            for line in ax.lines if line.get_marker() == "o"}  # fmt: skip
    assert dots == {(1.0, -40.0): PURPLE, (1.0, 61.0): GREEN}
    assert {"-40 mm", "61 mm"} <= set(words(ax))
    assert outside(ax) == []
    assert ax.get_ylabel() == "smallest distance [mm]"
    (overlap,) = ax.patches
    low, high = np.sort(overlap.get_extents().transformed(ax.transData.inverted()).intervaly)
    assert low == pytest.approx(ax.get_ylim()[0])
    assert high == pytest.approx(0.0, abs=1e-9)


def test_a_damper_is_drawn_with_its_bound_and_its_rows():
    distance, rows = np.linspace(0.3, 0.06, 5), np.array([0, 0, 1, 2, 1])
    approach, bound = np.linspace(0.0, 0.1, 5), np.linspace(0.5, 0.1, 5)
    figure = figures.damper_figure(TIMES, distance, rows, approach, bound, RANGES)
    top, middle, below = figure.axes
    np.testing.assert_allclose(curves(top)["distance"][:, 1], 1e3 * distance)
    assert {"inner range", "outer range"} <= set(words(top))
    drawn = curves(middle)
    np.testing.assert_allclose(drawn["its bound"][:, 1], bound)
    (named,) = [name for name in drawn if name.startswith("approach")]
    np.testing.assert_allclose(drawn[named][:, 1], approach)
    (steps,) = below.lines
    assert steps.get_drawstyle() == "steps-post"
    np.testing.assert_array_equal(steps.get_ydata(), rows)
    assert [ax.get_ylabel() for ax in figure.axes] == [
        "distance [mm]",
        "speed [m/s]",
        "active rows",
    ]
    assert below.get_xlabel() == "time [s]"
    assert outside(middle) == []


def test_penalties_of_one_form_are_told_apart():
    g = np.linspace(-1.0, 1.0, 9)
    forms = {
        "squared_hinge": 0.5 * np.maximum(g, 0.0) ** 2,
        "the same": 0.5 * np.maximum(g, 0) ** 2,
    }
    (ax,) = figures.penalty_figure(g, forms).axes
    drawn = curves(ax)
    assert list(drawn) == ["squared hinge", "the same"]
    np.testing.assert_allclose(drawn["the same"], np.column_stack([g, forms["the same"]]))
    first, second = (line for line in ax.lines if not line.get_label().startswith("_"))
    assert first.get_linewidth() > second.get_linewidth()
    assert {"violated", "met"} <= {word.strip() for word in words(ax)}
    met, violated = (next(t for t in ax.texts if t.get_text().strip() == word)
                     for word in ("met", "violated"))  # fmt: skip
    assert (met.get_ha(), violated.get_ha()) == ("right", "left")
    assert ax.get_ylim()[0] < 0.0 < forms["the same"].max() <= ax.get_ylim()[1]


def test_a_decay_is_told_by_when_it_is_below_for_good():
    """It dips under the threshold at 0.5 s and comes back; after 1.5 s it stays below."""
    dips = np.array([1.0, 0.05, 0.5, 0.01, 0.001])
    never = np.array([1.0, 0.9, 0.8, 0.7, 0.6])
    at_once = np.full(5, 1e-20)
    series = {"dips": (TIMES, dips), "never": (TIMES, never), "at once": (TIMES, at_once)}
    figure = figures.decay_figure(series, 0.1)
    (ax,) = figure.axes
    drawn = curves(ax)
    assert list(drawn) == ["dips: 1.5 s", "never: not in time", "at once: 0 s"]
    np.testing.assert_allclose(drawn["dips: 1.5 s"], np.column_stack([TIMES, dips])[1:])
    assert drawn["at once: 0 s"][:, 1].min() == pytest.approx(1e-12)
    dots = [np.ravel(line.get_data()).tolist() for line in ax.lines if line.get_marker() == "o"]
    assert dots == [[1.5, 0.1]]
    first, second, third = (line for line in ax.lines if line.get_label() in drawn)
    assert first.get_color() == second.get_color() != third.get_color()
    assert (first.get_linestyle(), second.get_linestyle()) == ("-", "--")
    assert (ax.get_xscale(), ax.get_yscale()) == ("log", "log")
    (legend,) = figure.legends
    assert legend.get_title().get_text() == "below the threshold for good after"


def test_a_contest_shows_errors_down_to_its_floor():
    times = np.array([1.0, 10.0, 100.0])
    quartiles = np.array([0.8 * times, 1.5 * times])
    series = {
        "exact": (times, quartiles, np.array([1e-3, 1e-9, 1e-12])),
        "coarse": (2 * times, 2 * quartiles, np.array([1e-1, 1e-2, 1e-3])),
    }
    (ax,) = figures.contest_figure(series, 1e-8).axes
    exact, coarse = (container.lines[0] for container in ax.containers)
    np.testing.assert_allclose(exact.get_ydata(), [1e-3, 1e-8, 1e-8])
    np.testing.assert_allclose(coarse.get_xdata(), 2 * times)
    (bars,) = ax.containers[0].lines[2]
    ends = np.array([segment[:, 0] for segment in bars.get_segments()])
    np.testing.assert_allclose(ends, quartiles.T)
    assert set(words(ax)) == {"1e-08 or less", "exact", "coarse: 1.0e-03"}
    assert ax.get_xlabel() == "time per problem [us]"
    assert outside(ax) == []


def test_convergence_is_told_in_steps():
    count = np.array([1.0, 10.0, 100.0, 1000.0])
    series = {
        "fast": (count, np.array([1.0, 1e-4, 1e-6, 0.0])),
        "slow": (count, np.array([1.0, 0.9, 0.8, 0.7])),
    }
    (ax,) = figures.convergence_figure(series, 1e-5).axes
    assert {"fast: 100 steps", "slow: not reached", "threshold 1e-05"} == set(words(ax))
    lines = [line for line in ax.lines if len(line.get_xdata()) == len(count)]
    np.testing.assert_allclose(lines[0].get_ydata(), [1.0, 1e-4, 1e-6, 1e-14])
    dots = [np.ravel(line.get_data()).tolist() for line in ax.lines if line.get_marker() == "o"]
    assert dots == [[100.0, 1e-6], [1000.0, 0.7]]
    assert ax.get_ylim()[0] == pytest.approx(1e-11)
