"""Shares as bars, grids and curves: lengths, whiskers and numbers are those of the shares."""

import numpy as np
import pytest
from matplotlib.colors import to_rgb

from dualarm_repro.ledger.shares import Share
from dualarm_repro.view.legibility import faults
from dualarm_repro.view.shares import count_grid_figure, curve_figure, shares_figure
from dualarm_repro.view.style import FIXED_BLACK, FIXED_WHITE, PALETTE

from .drawn import curves, words

ROWS = {
    "the improved method": {"met": Share.of(9, 10), "possible": Share.of(1, 64)},
    "the other": {"met": Share.of(0, 10)},
}


def test_bars_have_the_length_and_the_whiskers_of_their_shares():
    figure = shares_figure(ROWS, "trials that arrive", (0.8, "printed"))
    (ax,) = figure.axes
    bars = [c for c in ax.containers if hasattr(c, "patches")]
    met, possible = ([bar.get_width() for bar in group] for group in bars)
    assert met == pytest.approx([90.0, 0.0])
    assert possible == pytest.approx([100 / 64])
    segments = bars[0].errorbar.lines[2][0].get_segments()
    for segment, row in zip(segments, ROWS.values(), strict=True):
        share = row["met"]
        assert segment[:, 0] == pytest.approx([100 * share.low, 100 * share.high])
    assert words(ax) == ["90 %", "0 %", "1.6 %"]
    order = (("the improved method", "met"), ("the other", "met"))
    drawn = [ROWS[name][group] for name, group in (*order, ("the improved method", "possible"))]
    for text, share in zip(ax.texts, drawn, strict=True):
        assert text.get_position()[0] > 100 * share.high, "a number stands beyond its whisker"
    mark = next(line for line in ax.lines if line.get_label() == "printed")
    assert mark.get_xdata()[0] == 80.0
    assert [t.get_text() for t in ax.get_yticklabels()] == list(ROWS)
    assert ax.get_xlabel() == "trials that arrive [%]"
    names = [text.get_text() for text in figure.legends[0].get_texts()]
    assert sorted(names) == ["met", "possible", "printed"]
    assert faults(figure) == []


def test_bars_of_a_row_stand_side_by_side_around_its_name():
    (ax,) = shares_figure(ROWS, "trials").axes
    spans = [(bar.get_y(), bar.get_y() + bar.get_height()) for bar in ax.patches]
    (low, high), _, (below, above) = spans
    assert low < high <= below < above or below < above <= low < high
    assert 0.5 * (min(low, below) + max(high, above)) == pytest.approx(0.0)
    assert len({to_rgb(bar.get_facecolor()[:3]) for bar in ax.patches}) == 2


def test_one_group_needs_no_legend():
    rows = {"one": {"met": Share.of(1, 2)}}
    assert shares_figure(rows, "cases").legends == []


def test_a_grid_names_every_count_that_occurred():
    counts = np.array([[0, 3, 40], [7, 0, 1]])
    (ax,) = count_grid_figure(counts, "wins", "losses", (1, 0)).axes
    found = {tuple(text.get_position()): text for text in ax.texts}
    assert {place: int(text.get_text()) for place, text in found.items()} == {
        (1, 0): 3, (2, 0): 40, (0, 1): 7, (2, 1): 1}  # fmt: skip
    assert ax.get_title(loc="left") == "framed: 1 and 0, in 7 of 51"
    (frame,) = ax.patches
    assert frame.get_bbox().bounds == (-0.5, 0.5, 1.0, 1.0)
    np.testing.assert_allclose(ax.images[0].get_array(), np.log1p(counts))
    assert ax.images[0].origin == "lower"
    assert found[2, 0].get_color() == FIXED_BLACK
    assert found[2, 1].get_color() == FIXED_WHITE
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("wins", "losses")


@pytest.mark.parametrize("log", [True, False])
def test_shares_over_a_quantity_lie_in_their_bands(log):
    shares = [Share.of(k, 10) for k in (2, 5, 9)]
    (ax,) = curve_figure((1.0, 10.0, 100.0), {"a": shares, "b": shares[::-1]}, "gain [1]",
                         "share", log=log).axes  # fmt: skip
    found = curves(ax)
    np.testing.assert_allclose(found["a"], [(x, s.value) for x, s in zip((1, 10, 100), shares,
                                                                         strict=True)])  # fmt: skip
    band = ax.collections[0].get_paths()[0].vertices
    for x, share in zip((1.0, 10.0, 100.0), shares, strict=True):
        at = band[np.isclose(band[:, 0], x), 1]
        assert (at.min(), at.max()) == pytest.approx((share.low, share.high))
    assert ax.get_xscale() == ("log" if log else "linear")
    assert words(ax) == ["a", "b"]
    assert ax.get_ylim()[0] == 0.0
    assert [line.get_color() for line in ax.lines] == list(PALETTE[:2])
