"""Curves along a seam: a robot a curve, angles in degrees between their limits, rates at a pace."""

from types import SimpleNamespace

import numpy as np
import pytest

from dualarm_repro.view.seam_curves import joints_figure, measures_figure, rates_figure
from dualarm_repro.welding import ROBOTS, Measures

from .drawn import curves, words

COUNT = 6


def measures(scale):
    rows = scale * np.linspace(1.0, 2.0, COUNT)
    return Measures(rows, 2 * rows, 3 * rows, 0 * rows, 0 * rows)


def test_panels_share_the_scale_of_all_measures():
    w = np.outer((0.1, 0.2, 0.3), np.linspace(1.0, 2.0, COUNT))
    figure = measures_figure({"ours": (w, measures(1.0)), "printed": (2 * w, measures(4.0))})
    first, second = figure.axes
    assert [ax.get_title(loc="left") for ax in figure.axes] == ["ours", "printed"]
    for ax, factor, scale in ((first, 1, 1.0), (second, 2, 4.0)):
        found = curves(ax)
        for k, name in enumerate(ROBOTS):
            np.testing.assert_allclose(found[f"{name} [m³]"][:, 1], factor * w[k])
        np.testing.assert_allclose(found["both carriers [m⁶]"][:, 1], measures(scale).tight)
        np.testing.assert_allclose(found["system, (16)"][:, 1], measures(scale).system)
        assert ax.get_xlabel() == "seam point"
    assert first.get_ylim() == second.get_ylim()
    assert first.get_ylim()[0] == 0.0
    assert first.get_ylim()[1] >= measures(4.0).system.max()
    assert words(first) == []
    assert len(words(second)) == 5


class Limits:
    """Limits of joints as a cell gives them: those of robot k are 10 k degrees wider."""

    def limits(self, k):
        wide = np.radians(90.0 + 10.0 * k + np.arange(6.0))
        return -wide, 0.5 * wide


def test_angles_are_in_degrees_and_the_legend_has_their_limits():
    q = np.random.default_rng(4).uniform(-1.0, 1.0, (3, COUNT, 6))
    figure = joints_figure(Limits(), q)
    for k, (ax, name) in enumerate(zip(figure.axes, ROBOTS, strict=True)):
        assert ax.get_title(loc="left") == name
        found = curves(ax)
        lower, upper = np.degrees(Limits().limits(k))
        for j in range(6):
            curve = found[f"q{j + 1} in [{lower[j]:.0f}, {upper[j]:.0f}]"]
            np.testing.assert_allclose(curve[:, 1], np.degrees(q[k, :, j]))
        bars = [line.get_ydata()[0] for line in ax.lines if line.get_linewidth() == 3]
        assert sorted(bars) == pytest.approx(sorted([*lower, *upper]))
    assert figure.axes[0].get_ylabel() == "joint angle [deg]"
    high = figure.axes[0].get_ylim()[1]
    assert high < 80.0, "limits far beyond the angles do not stretch the panel"
    names = [text.get_text() for text in figure.legends[0].get_texts()]
    assert names[0] == "q1 in [-90, 45]"


def test_the_fastest_pace_uses_a_limit_whole():
    used = np.random.default_rng(6).uniform(-1.0, 1.0, (3, COUNT, 6))
    fastest = 1.0 / abs(used).max()
    (ax,) = rates_figure(used, fastest).axes
    found = curves(ax)
    whole = np.array([found[name][:, 1] for name in ROBOTS])
    assert whole.max() == pytest.approx(1.0)
    for k in range(3):
        at = [max(abs(used[k, n, j]) for j in range(6)) * fastest for n in range(COUNT)]
        np.testing.assert_allclose(whole[k], at)
    assert found["limit"][:, 1].tolist() == [1.0, 1.0]
    assert f"at {1e3 * fastest:.0f} mm/s along the seam" in ax.get_ylabel()
    assert ax.get_ylim() == (0.0, 1.08)


def test_a_cell_is_asked_for_the_limits_of_each_robot():
    asked = []
    cell = SimpleNamespace(limits=lambda k: asked.append(k) or (-np.ones(6), np.ones(6)))
    joints_figure(cell, np.zeros((3, COUNT, 6)))
    assert asked == [0, 1, 2]
