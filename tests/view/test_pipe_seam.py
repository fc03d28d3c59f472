"""Two pipes and their seam: surfaces of the right radii that meet where the seam lies."""

import numpy as np
import pytest

from dualarm_repro.view.pipe_seam import pipes_figure, seam_figure
from dualarm_repro.view.style import BLACK, RED
from dualarm_repro.welding import Seam, saddle_seam

from .drawn import in_space, words

MAIN, BRANCH, LONG, HIGH = 0.10, 0.06, 0.6, 0.15


@pytest.fixture(scope="module")
def seam():
    return saddle_seam(MAIN, BRANCH, 24)


def test_surfaces_are_the_pipes(seam, surfaces):
    (ax,) = pipes_figure(seam, MAIN, BRANCH, LONG, HIGH).axes
    (x, y, z), (u, v, w) = (arrays for arrays, _ in surfaces)
    np.testing.assert_allclose(np.hypot(y, z), MAIN)
    assert (x.min(), x.max()) == pytest.approx((-0.5 * LONG, 0.5 * LONG))
    np.testing.assert_allclose(np.hypot(u, v), BRANCH)
    np.testing.assert_allclose(np.hypot(v, w)[:, 0], MAIN)  # its foot stands on the main pipe
    np.testing.assert_allclose(w[:, -1], MAIN + HIGH)
    line = next(p for one, p in zip(ax.lines, in_space(ax), strict=True)
                if one.get_color() == RED)  # fmt: skip
    np.testing.assert_allclose(line, [*seam.points, seam.points[0]])
    np.testing.assert_allclose(np.hypot(line[:, 1], line[:, 2]), MAIN)
    np.testing.assert_allclose(np.hypot(line[:, 0], line[:, 1]), BRANCH)
    assert sorted(words(ax)) == ["branch", "main pipe", "seam"]


@pytest.mark.parametrize(("height", "stretch"), [(1.0, 1.0), (0.1, 5.0), (0.01, 50.0)])
def test_a_flat_curve_is_drawn_higher_and_says_so(height, stretch):
    turn = np.linspace(0.0, 2.0 * np.pi, 40, endpoint=False)
    curve = np.column_stack([np.cos(turn), np.sin(turn), height * np.sin(2 * turn)])
    (ax,) = seam_figure({"seam": curve}).axes
    title = ax.get_title()
    if stretch == 1.0:
        assert title == ""
    else:
        assert title == f"z drawn {stretch:.0f} times larger"
    np.testing.assert_allclose(in_space(ax)[0], [*curve, curve[0]])
    sides = [abs(np.diff(lim())[0]) for lim in (ax.get_xlim, ax.get_ylim, ax.get_zlim)]
    box = ax._box_aspect
    assert box[2] / box[0] == pytest.approx(stretch * sides[2] / sides[0])


def test_marked_points_get_a_cross_and_every_curve_a_dot_where_it_begins(seam):
    other = 1.2 * seam.points
    point = np.array([0.05, 0.0, 0.1])
    (ax,) = seam_figure({"ours": seam.points, "printed": other}, {"torch": point}).axes
    assert sorted(words(ax)) == ["ours", "printed", "torch"]
    places = [np.ravel(c._offsets3d) for c in ax.collections]
    np.testing.assert_allclose(places, [seam.points[0], other[0], point])
    assert [line.get_label() for line in ax.lines] == ["ours", "printed"]
    assert len({line.get_color() for line in ax.lines}) == 2
    assert BLACK not in {line.get_color() for line in ax.lines[:2]}


def test_a_seam_is_closed_by_its_first_point(seam):
    assert isinstance(seam, Seam)
    (ax,) = seam_figure({"seam": seam.points}).axes
    (line,) = in_space(ax)
    assert len(line) == len(seam.points) + 1
    np.testing.assert_array_equal(line[0], line[-1])
