"""Curves of a search mark where the path begins and where it should end."""

import numpy as np
import pytest

from dualarm_repro.view.search_curves import coordinate_figure, joint_figure, splice_figure

from .drawn import curves

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


def test_coordinates_of_runs_end_in_dots_between_levels():
    runs = {"one": PATH[:, :3], "longer": np.vstack([PATH[:, :3], PATH[-1:, :3] + 1.0])}
    marks = {"goal": np.array([0.5, 0.6, 0.7])}
    figure = coordinate_figure(runs, marks, xlabel="step")
    for k, ax in enumerate(figure.axes):
        found = curves(ax)
        for name, path in runs.items():
            np.testing.assert_allclose(found[name][:, 1], path[:, k])
        assert found["goal"][:, 1].tolist() == [marks["goal"][k]] * 2
        dots = [np.ravel(line.get_data()) for line in ax.lines if line.get_marker() == "o"]
        np.testing.assert_allclose(dots, [(len(p) - 1, p[-1, k]) for p in runs.values()])
        assert (ax.get_xlabel(), ax.get_ylabel()) == ("step", f"{'xyz'[k]} of the flange [m]")
    names = [text.get_text() for text in figure.legends[0].get_texts()]
    assert names == ["one", "longer", "goal"]


def test_a_joint_that_hardly_moves_is_named_and_not_drawn():
    path = PATH.copy()
    path[:, 1], path[:, 4] = 0.3, 0.3 + np.radians(np.linspace(0.0, 0.05, 5))
    figure = joint_figure({"run": path}, junctions=(2.5,))
    drawn = [ax for ax in figure.axes if ax.get_visible()]
    assert [ax.get_ylabel() for ax in drawn] == [f"joint {j} [deg]" for j in (1, 3, 4, 6)]
    for ax, j in zip(drawn, (0, 2, 3, 5), strict=True):
        np.testing.assert_allclose(curves(ax)["run"][:, 1], np.degrees(path[:, j]))
        dotted = [line.get_xdata()[0] for line in ax.lines if line.get_linestyle() == ":"]
        assert dotted == [2.5]
    told = figure.get_supxlabel()
    assert told == "not drawn, since they hardly move: joint 2 (at rest) and 5 (0.05 deg)"
    names = [text.get_text() for text in figure.legends[0].get_texts()]
    assert names == ["run", "junction"]
    assert [ax.get_xlabel() for ax in drawn] == ["", "", *["sample of the path"] * 2]


def test_what_moves_in_one_run_is_drawn_for_all():
    moving, resting = PATH[:, :2], np.zeros((4, 2))
    figure = joint_figure({"moves": moving, "rests": resting})
    assert sum(ax.get_visible() for ax in figure.axes) == 2
    assert all({"moves", "rests"} == set(curves(ax)) for ax in figure.axes if ax.get_visible())
    assert figure.get_supxlabel() == ""


def test_a_kink_shows_as_a_bend_at_its_sample():
    """Two straight pieces that meet at sample 20: the second difference is zero but there."""
    path = np.concatenate([np.linspace(0.0, 1.0, 21), np.linspace(1.0, 0.6, 21)[1:]])
    path = np.column_stack([path, 2.0 * path])
    smooth = np.zeros_like(path)
    figure = splice_figure(path, smooth, 20.0, (0, 1), window=6)
    for column, j in enumerate((0, 1)):
        top, below = figure.axes[column], figure.axes[2 + column]
        joined = curves(top)["joined"]
        assert joined[:, 0].tolist() == list(range(14, 28))
        np.testing.assert_allclose(joined[:, 1], np.degrees(path[14:28, j]))
        raw, flat = (np.column_stack(line.get_data()) for line in below.lines[:2])
        assert raw[:, 0].tolist() == list(range(14, 28))
        kink = np.degrees(-0.07 * (1 + j))  # from a slope of 0.05 to one of -0.02 [rad]
        np.testing.assert_allclose(raw[:, 1], np.where(raw[:, 0] == 20, kink, 0.0), atol=1e-9)
        np.testing.assert_allclose(flat[:, 1], 0.0)
        for ax in (top, below):
            assert [x.get_xdata()[0] for x in ax.lines if x.get_linestyle() == ":"] == [20.0]
        moved = np.degrees(1.0 + j)
        assert top.get_title(loc="left") == f"joint {j + 1} moves by {moved:.2g} deg"
        assert below.get_ylabel() == "bend [deg per sample²]"


def test_a_window_beyond_the_path_ends_with_it():
    path = np.linspace(0.0, 1.0, 9)[:, np.newaxis] ** 2
    figure = splice_figure(path, path, 4.0, (0,))
    top, below = figure.axes
    assert curves(top)["joined"][:, 0].tolist() == list(range(1, 9))
    bend = np.column_stack(below.lines[0].get_data())
    assert bend[:, 0].tolist() == list(range(1, 8))
    np.testing.assert_allclose(bend[:, 1], np.degrees(2.0 / 64.0))
