"""Curves of a slice as the page has them: points, circles, names apart, data of a script."""

import json
import re

import numpy as np
import pytest
from bs4 import BeautifulSoup
from hypothesis import given, settings
from hypothesis import strategies as st

from dualarm_repro.errors import InputError
from dualarm_repro.view.slices import Curve, curve_slice
from dualarm_repro.view.slices.curves import _apart, _minima
from dualarm_repro.view.slices.data import compact, rounded

X = np.linspace(0.0, 2.0, 41)
#: Places of a drawing are written to a tenth of a pixel.
TENTH = 0.06
CURVES = [
    Curve("both", {"a": X, "b": (X - 1.0) ** 2}),
    Curve("plain", {"a": X}, dashed=True),
]


def made(curves=CURVES, **more):
    page = curve_slice("Two curves.", X, curves, x_label="s [m]", y_label="U", **more)
    return BeautifulSoup(page.html, "html.parser")


def points(soup):
    return [np.array([tuple(map(float, pair.split(","))) for pair in line["points"].split()])
            for line in soup.select(".slice-curve")]  # fmt: skip


def data_of(soup):
    return json.loads(soup.select_one(".slice-data").string)


def test_what_is_drawn_is_the_sum_of_the_terms_with_their_gains():
    soup = made(gains={"b": 2.0}, y_range=(0.0, 4.0))
    (left, right, start, end), (low, high, bottom, top) = data_of(soup)["axes"]
    assert (left, right, low, high) == (0.0, 2.0, 0.0, 4.0)
    both, plain = points(soup)
    for drawn, heights in ((both, X + 2.0 * (X - 1.0) ** 2), (plain, X)):
        across = start + X / 2.0 * (end - start)
        up = bottom + heights / 4.0 * (top - bottom)
        np.testing.assert_allclose(drawn, np.column_stack([across, up]), atol=TENTH)
    first, second = soup.select(".slice-curve")
    assert not first.has_attr("stroke-dasharray")
    assert second.has_attr("stroke-dasharray")
    assert first["stroke"] != second["stroke"]


def test_the_script_gets_terms_gains_and_names():
    names = [f"pair {k}" for k in range(len(X))]
    data = data_of(made(gains={"b": 2.0}, names=names, minima=True))
    assert data["gains"] == {"b": 2.0}
    assert data["names"] == names
    assert data["minima"] is True
    assert data["labels"] == ["s [m]", "U"]
    np.testing.assert_allclose(data["x"], X, rtol=1e-4)
    np.testing.assert_allclose(data["curves"][0]["terms"]["b"], (X - 1.0) ** 2, rtol=1e-4)
    assert data_of(made())["names"] is None


def test_heights_hold_every_curve_and_level_unless_a_range_is_given():
    low, high = data_of(made(levels={"deep": -3.0}))["axes"][1][:2]
    assert low < -3.0
    assert high > 3.0
    low, high = data_of(made())["axes"][1][:2]
    assert low < 0.0 < 3.0 < high
    assert data_of(made(y_range=(-1.0, 1.0)))["axes"][1][:2] == [-1.0, 1.0]


def test_marks_and_levels_stand_at_their_places():
    soup = made(marks={"trap": 0.5}, levels={"zero": 1.5}, y_range=(0.0, 3.0))
    (_, _, start, end), (_, _, bottom, top) = data_of(soup)["axes"]
    texts = {t.get_text().strip(): t for t in soup.select("text")}
    mark, level = (texts[name].find_previous_sibling("line") for name in ("trap", "zero"))
    assert (
        float(mark["x1"])
        == float(mark["x2"])
        == pytest.approx(start + 0.25 * (end - start), abs=TENTH)
    )
    assert (
        float(level["y1"]) == float(level["y2"]) == pytest.approx(0.5 * (bottom + top), abs=TENTH)
    )


def test_inner_minima_are_circled():
    soup = made(minima=True, y_range=(0.0, 3.0))
    circles = soup.select(".slice-minima circle")
    assert len(circles) == 1  # of x + (x - 1)^2, at 0.5; x itself has none inside
    (_, _, start, end), (_, _, bottom, top) = data_of(soup)["axes"]
    place = float(circles[0]["cx"]), float(circles[0]["cy"])
    at = start + 0.25 * (end - start), bottom + 0.25 * (top - bottom)
    assert place == pytest.approx(at, abs=TENTH)
    assert made().select(".slice-minima circle") == []


HEIGHTS = st.lists(st.floats(-5.0, 5.0), min_size=3, max_size=20).map(np.array)


@settings(max_examples=50)
@given(HEIGHTS)
def test_minima_are_lower_than_before_and_not_higher_than_after(heights):
    found = _minima(heights)
    assert found == [k for k in range(1, len(heights) - 1)
                     if heights[k - 1] > heights[k] <= heights[k + 1]]  # fmt: skip


@settings(max_examples=50)
@given(st.lists(st.floats(0.0, 300.0), min_size=1, max_size=8))
def test_names_are_apart_and_in_order(heights):
    placed = _apart(heights)
    assert all(low >= high for low, high in zip(placed, heights, strict=True)), "only moved down"
    assert all(gap >= 16.0 - 1e-9 for gap in np.diff(sorted(placed)))
    order = np.argsort(heights)
    assert [placed[k] for k in order] == sorted(placed)


def test_a_long_name_gets_room_but_leaves_some_to_the_curves():
    wide = [
        data_of(made([Curve(name, {"a": X})]))["axes"][0][3] for name in ("a", "a" * 30, "a" * 90)
    ]
    assert wide[0] > wide[1] > wide[2]
    assert wide[2] > 450.0


@pytest.mark.parametrize(
    ("x", "terms", "names", "says"),
    [
        (X[::-1], {"a": X}, None, r"curve_slice: x = \(41,\): expected two or more increasing"),
        (X[:1], {"a": X[:1]}, None, "two or more increasing numbers"),
        (np.zeros((2, 2)), {"a": X}, None, "two or more increasing numbers"),
        (X, {"a": X[1:]}, None, r"curve y: shape of a = \(40,\): expected \(41,\)"),
        (X, {"a": X}, ["one"], "curve_slice: names = 1: expected 41 texts"),
    ],
)
def test_what_does_not_fit_is_said(x, terms, names, says):
    with pytest.raises(InputError, match=says):
        curve_slice("t", x, [Curve("y", terms)], x_label="x", y_label="y", names=names)


def test_numbers_are_short_and_cannot_close_a_script():
    assert rounded(np.array([[1 / 3, 123456.7], [0.0, -1e-9]])) == [0.33333, 123460.0, 0.0, -1e-9]
    text = compact({"a": "</script>", "b": [1.0, 2]})
    assert "</" not in text
    assert json.loads(text) == {"a": "</script>", "b": [1.0, 2]}
    with pytest.raises(ValueError, match="JSON"):
        compact({"a": float("nan")})


def test_a_title_is_read_out():
    soup = made()
    assert soup.svg["aria-label"] == "Two curves."
    assert soup.figcaption.get_text() == "Two curves."
    assert not re.search(r"https?:", str(soup))
