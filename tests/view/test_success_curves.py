"""Success rates in per cent, each curve within its interval, coinciding ones told apart."""

import numpy as np
import pytest

from dualarm_repro.ledger.shares import Share
from dualarm_repro.view.success_curves import rate_figure

from .drawn import curves, outside, words

X = (0.1, 1.0, 10.0)
RATES = {
    "with": {
        "a": [Share.of(k, 20) for k in (0, 10, 20)],
        "b": [Share.of(k, 20) for k in (1, 1, 1)],
    },
    "without": {"a": [Share.of(5, 20)] * 3, "b": [Share.of(5, 20)] * 3},
}


def test_rates_are_drawn_in_per_cent_with_their_bands():
    figure = rate_figure(X, RATES, "gain [1]", (1.0, "printed"))
    assert [ax.get_title(loc="left") for ax in figure.axes] == list(RATES)
    for ax, group in zip(figure.axes, RATES.values(), strict=True):
        found = curves(ax)
        for band, (name, shares) in zip(ax.collections, group.items(), strict=True):
            np.testing.assert_allclose(
                found[name], [(x, 100 * s.value) for x, s in zip(X, shares, strict=True)]
            )
            vertices = band.get_paths()[0].vertices
            for x, share in zip(X, shares, strict=True):
                at = vertices[np.isclose(vertices[:, 0], x), 1]
                assert (at.min(), at.max()) == pytest.approx((100 * share.low, 100 * share.high))
        assert [line.get_xdata()[0] for line in ax.lines if line.get_linestyle() == ":"] == [1.0]
        assert [word.strip() for word in words(ax)] == ["printed"]
        assert ax.get_xscale() == "log"
        assert ax.get_ylim()[0] < 0.0
        assert ax.get_ylim()[1] > 100.0
        assert outside(ax) == []
    assert figure.axes[0].get_ylabel() == "success [%]"
    assert [text.get_text() for text in figure.legends[0].get_texts()] == ["a", "b"]


def test_curves_that_coincide_look_different():
    ax = rate_figure(X, RATES, "gain [1]").axes[1]
    one, other = ax.lines
    assert one.get_linewidth() > other.get_linewidth()
    assert one.get_color() != other.get_color()
    assert one.get_marker() != other.get_marker()
    assert words(ax) == []
