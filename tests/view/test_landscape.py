"""Slices of a landscape: the right plane, masked where nothing is feasible, marks in place."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
from matplotlib.colors import to_hex

from dualarm_repro.view import landscape as figures
from dualarm_repro.view.style import BLACK, BLUE, ORANGE, RED
from dualarm_repro.welding import Status

from .drawn import outside

BOX = np.array([[-0.6, 0.6], [-0.9, 0.9], [0.1, 1.5]])
OPTIMUM, PRINTED = np.array([0.1, -0.2, 0.8]), np.array([-0.3, 0.4, 0.5])


def hill(points):
    """One at the optimum, and nothing beyond x = 0.4."""
    values = np.exp(-np.sum(((points - OPTIMUM) / [0.5, 0.7, 0.6]) ** 2, axis=1))
    return np.where(points[:, 0] > 0.4, 0.0, values)


def centres(mesh):
    """Places (M, N, 2) of the corners of a mesh, between which its values lie."""
    corners = mesh.get_coordinates()
    return 0.25 * (corners[1:, 1:] + corners[:-1, 1:] + corners[1:, :-1] + corners[:-1, :-1])


@pytest.mark.parametrize(("k", "pair"), [(0, (0, 1)), (1, (0, 2)), (2, (1, 2))])
def test_a_slice_shows_the_values_of_its_plane(k, pair):
    figure = figures.slices_figure(hill, BOX, OPTIMUM, 1.0, PRINTED)
    ax = figure.axes[k]
    mesh = next(c for c in ax.collections if hasattr(c, "get_coordinates"))
    places = centres(mesh).reshape(-1, 2)
    points = np.tile(OPTIMUM, (len(places), 1))
    points[:, pair] = places
    expected, shown = hill(points), mesh.get_array().ravel()
    np.testing.assert_allclose(np.ma.filled(shown, 0.0), expected, atol=1e-9)
    np.testing.assert_array_equal(np.ma.getmaskarray(shown), expected <= 0.0)
    stars = {line.get_marker(): np.ravel(line.get_data()) for line in ax.lines
             if line.get_marker() in ("*", "X")}  # fmt: skip
    np.testing.assert_allclose(stars["*"], OPTIMUM[list(pair)])
    np.testing.assert_allclose(stars["X"], PRINTED[list(pair)])
    assert (ax.get_xlabel(), ax.get_ylabel()) == tuple(f"{'xyz'[axis]} [m]" for axis in pair)
    assert (mesh.norm.vmin, mesh.norm.vmax) == (0.0, 1.0)


def test_the_line_encloses_what_is_within_a_hundredth_of_the_best():
    figure = figures.slices_figure(hill, BOX, OPTIMUM, 1.0, PRINTED)
    line = next(c for c in figure.axes[0].collections if hasattr(c, "levels"))
    assert line.levels.tolist() == [0.99]
    vertices = np.vstack([path.vertices for path in line.get_paths() if len(path.vertices)])
    points = np.column_stack([vertices, np.full(len(vertices), OPTIMUM[2])])
    # linear between the 49 points of the grid along each side
    np.testing.assert_allclose(hill(points), 0.99, atol=6e-3)
    labels = [text.get_text() for text in figure.legends[0].get_texts()]
    assert labels == ["optimum", "printed", "99 % of the best"]
    assert to_hex(line.get_edgecolor()[0]).upper() == RED


class Halves:
    """Positions by the sign of their coordinates, as a placement judges them."""

    def __call__(self, points):
        return hill(points)

    def jobs(self, points):
        status = np.where(points[:, 1] > 0.3, Status.COLLISION, Status.FEASIBLE)
        status = np.where(points[:, 0] > 0.4, Status.OUT_OF_REACH, status)
        return SimpleNamespace(status=np.where(points[:, 2] < 0.4, Status.SINGULAR, status))


def test_what_excludes_a_position_is_shown_in_its_place():
    made = Halves()
    figure = figures.statuses_figure(made, BOX)
    first, second = figure.axes
    for ax, (i, j) in ((first, (0, 1)), (second, (1, 2))):
        other, told = ax.get_title(loc="left").removesuffix(" m").split(" = ")
        assert other == "xyz"[3 - i - j]
        assert float(told) == pytest.approx(OPTIMUM[3 - i - j], abs=0.1)  # the grid is 0.15 m wide
        mesh = ax.collections[0]
        places = centres(mesh).reshape(-1, 2)
        points = np.empty((len(places), 3))
        points[:, [i, j]], points[:, 3 - i - j] = places, float(told)
        np.testing.assert_array_equal(mesh.get_array().ravel(), made.jobs(points).status)
        # each status has its own colour, in the middle of its step of the scale
        assert len({tuple(mesh.cmap(mesh.norm(s))) for s in Status}) == len(Status)
    labels = [text.get_text() for text in figure.legends[0].get_texts()]
    assert labels == ["feasible", "out of reach", "joint limits", "singular", "collision"]
    patches = figure.legends[0].get_patches()
    assert [to_hex(p.get_facecolor()) for p in patches] == [
        to_hex(first.collections[0].cmap(first.collections[0].norm(s))) for s in Status
    ]


def test_sensitivities_span_from_the_nominal_to_the_farthest():
    table = pd.DataFrame(
        {"assumption": ["wide_gap", "wide_gap", "torch"], "x": [-0.2, 0.5, np.nan],
         "y": [0.3, 0.1, np.nan], "z": [0.7, 0.9, np.nan]}
    )  # fmt: skip
    nominal, printed = np.array([-0.1, 0.2, 0.8]), np.array([-0.4, 0.6, 0.5])
    figure = figures.sensitivity_figure(table, nominal, printed)
    assert [ax.get_xlabel() for ax in figure.axes] == ["|x| [m]", "y [m]", "z [m]"]
    for k, ax in enumerate(figure.axes):
        bars = [line.get_xdata() for line in ax.lines if line.get_linewidth() == 5]
        dots = [line.get_xdata() for line in ax.lines if line.get_marker() == "o"]
        values = table.loc[:1, "xyz"[k]].to_numpy()
        values, centre = (abs(values), 0.1) if k == 0 else (values, nominal[k])
        assert list(bars[0]) == [min(*values, centre), max(*values, centre)]
        assert (len(bars[1]), len(dots[1])) == (0, 0), "nothing feasible, nothing drawn"
        np.testing.assert_allclose(dots[0], values)
        upright = {line.get_color(): line.get_xdata()[0] for line in ax.lines
                   if line.get_color() in (BLACK, RED) and len(line.get_xdata())}  # fmt: skip
        assert upright == {BLACK: centre, RED: 0.4 if k == 0 else printed[k]}
    first = figure.axes[0]
    assert [t.get_text() for t in first.get_yticklabels()] == ["wide gap", "torch"]
    assert first.get_ylim()[0] > first.get_ylim()[1], "the first stands at the top"


def test_readings_are_counted_within_a_radius():
    optima = [("one", OPTIMUM + np.zeros((4, 3))), ("two", PRINTED + np.zeros((3, 3)))]
    shares = pd.DataFrame({"one": [0.25, 0.5], "two": [1.0, 0.0]}, index=["mean", "least"])
    figure = figures.readings_figure(optima, PRINTED, shares, (0.1, 0.2))
    for ax, pair in zip(figure.axes[:2], ((0, 1), (1, 2)), strict=True):
        circles = {line.get_label(): np.column_stack(line.get_data()) for line in ax.lines
                   if line.get_label().startswith("within")}  # fmt: skip
        assert list(circles) == ["within 0.1 m", "within 0.2 m"]
        for name, radius in zip(circles, (0.1, 0.2), strict=True):
            away = circles[name] - PRINTED[list(pair)]
            np.testing.assert_allclose(np.linalg.norm(away, axis=1), radius)
        points = {line.get_label(): np.column_stack(line.get_data()) for line in ax.lines}
        np.testing.assert_allclose(points["one"], optima[0][1][:, pair])
        np.testing.assert_allclose(points["printed point"], [PRINTED[list(pair)]])
        assert outside(ax) == []
    below = figure.axes[2]
    widths = {color: [bar.get_width() for bar in group]
              for color, group in zip((BLUE, ORANGE), below.containers, strict=True)}  # fmt: skip
    assert widths == {BLUE: [25.0, 50.0], ORANGE: [100.0, 0.0]}
    assert below.get_xlabel() == "optima within 0.2 m of the printed point [%]"
    assert [t.get_text() for t in below.get_yticklabels()] == ["mean", "least"]
