"""Maps: layers of one shape on one scale, colours that follow it, marks in pixels."""

import base64
import json
from io import BytesIO

import numpy as np
import pytest
from bs4 import BeautifulSoup
from matplotlib import colormaps
from PIL import Image

from dualarm_repro.errors import InputError
from dualarm_repro.view.slices import Layer, map_slice, placement_slice
from dualarm_repro.view.slices.maps import _range, _whole

X, Y = np.linspace(-1.0, 1.0, 5), np.linspace(0.0, 0.5, 3)
#: Places of a drawing are written to a tenth of a pixel.
TENTH = 0.06
VALUES = np.arange(15.0).reshape(3, 5)


def made(layers, **more):
    page = map_slice("A map.", ("x [m]", X), ("y [m]", Y), layers, quantity="w [m³]", **more)
    return BeautifulSoup(page.html, "html.parser")


def data_of(soup):
    return json.loads(soup.select_one(".slice-data").string)


def picture(soup):
    raw = base64.b64decode(soup.image["href"].partition("base64,")[2])
    return np.asarray(Image.open(BytesIO(raw)).convert("RGBA"))


def test_the_picture_has_the_colours_of_its_values_from_the_top():
    holes = VALUES.copy()
    holes[0, 1] = np.nan
    pixels = picture(made([Layer("one", holes, {})]))
    assert pixels.shape == (3, 5, 4)
    for row in range(3):
        for column in range(5):
            value = holes[2 - row, column]
            if np.isnan(value):
                assert pixels[row, column, 3] == 0
                continue
            expected = 255 * np.array(colormaps["viridis"](value / 14.0)[:3])
            # a scale of 255 colours
            np.testing.assert_allclose(pixels[row, column, :3], expected, atol=2.0)
            assert pixels[row, column, 3] == 255


def test_layers_share_one_scale():
    data = data_of(made([Layer("one", VALUES, {}), Layer("two", VALUES - 10.0, {})]))
    assert data["range"] == [-10.0, 14.0]
    first, second = (np.frombuffer(base64.b64decode(layer["v"]), np.uint8).reshape(3, 5)
                     for layer in data["layers"])  # fmt: skip
    assert first.max() == 254
    assert second.min() == 0
    # ten units of 24 are 10 / 24 of 254 steps
    np.testing.assert_allclose(first.astype(float) - second, 254 * 10 / 24, atol=1.0)


def test_marks_lie_within_their_cells():
    soup = made([Layer("one", VALUES, {"corner": (-1.0, 0.0), "middle": (0.0, 0.25)})])
    (left, right, start, end), (low, high, bottom, top) = data_of(soup)["axes"]
    assert (left, right) == (-1.25, 1.25)
    assert (low, high) == (-0.125, 0.625)
    places = {text: (x, y) for text, x, y in data_of(soup)["layers"][0]["marks"]}
    assert places["middle"] == pytest.approx((0.5 * (start + end), 0.5 * (bottom + top)), abs=TENTH)
    across, up = (end - start) / 5, (top - bottom) / 3
    assert places["corner"] == pytest.approx((start + across / 2, bottom + up / 2), abs=TENTH)
    circles = [(float(c["cx"]), float(c["cy"])) for c in soup.select(".slice-marks circle")]
    assert circles == [tuple(place) for place in places.values()]


def test_one_length_is_as_long_up_as_across():
    (left, right, start, end), (low, high, bottom, top) = data_of(made([Layer("a", VALUES, {})]))[
        "axes"
    ]
    assert (end - start) / (X[-1] - X[0]) == pytest.approx((bottom - top) / (Y[-1] - Y[0]))
    assert right - left == 2.5
    assert high - low == 0.75
    tall = map_slice("t", ("x", Y), ("y", 3 * X), [Layer("a", np.zeros((5, 3)), {})], quantity="q")
    (_, _, start, end), (_, _, bottom, top) = data_of(BeautifulSoup(tall.html, "html.parser"))[
        "axes"
    ]
    assert bottom - top == pytest.approx(460.0)
    assert (end - start) / 0.5 == pytest.approx(460.0 / 6.0)


def test_grey_is_explained_only_where_it_is():
    whole, holes = Layer("one", VALUES, {}), Layer("two", np.where(VALUES > 3, VALUES, np.nan), {})
    assert "Grey" not in made([whole], nothing="wall").get_text()
    assert "Grey: wall." in made([whole, holes], nothing="wall").get_text()


def test_the_layer_that_is_shown_is_the_one_asked_for():
    layers = [Layer("low", VALUES, {}), Layer("high", VALUES[::-1], {"top": (0.0, 0.0)})]
    soup = made(layers, shown=1)
    assert "Shown: high." in soup.figcaption.get_text()
    np.testing.assert_array_equal(picture(soup), picture(made(layers))[::-1])
    assert [t.get_text() for t in soup.select(".slice-marks text")] == ["top"]
    assert soup.select_one(".slice-data")["data-ordered"] == "no"


@pytest.mark.parametrize(
    ("values", "ends"),
    [(VALUES, (0.0, 14.0)), (0.0 * VALUES + 2.0, (2.0, 3.0)), (np.nan * VALUES, (0.0, 1.0))],
)
def test_a_range_is_never_empty(values, ends):
    assert _range([Layer("one", values, {})]) == ends


def test_what_is_beyond_the_range_has_its_end():
    cells = _whole(np.array([[-5.0, 0.5, 9.0, np.inf]]), 0.0, 1.0)
    assert cells.tolist() == [[0, 127, 254, 255]]


def test_a_layer_of_another_shape_is_refused():
    with pytest.raises(InputError, match=r"layer odd: shape = \(5, 3\): expected \(3, 5\)"):
        made([Layer("odd", VALUES.T, {})])


def test_heights_of_a_placement_follow_one_another_with_that_of_the_optimum():
    soup = BeautifulSoup(
        placement_slice(
            "t", lambda p: p[:, 0] + 10.0 * p[:, 1] + 100.0 * p[:, 2],
            [[0.0, 1.0], [0.0, 2.0], [0.0, 1.0]], (0.3, 0.4, 0.6), (0.3, 0.4, 0.1),
            steps=3, heights=3,
        ).html,
        "html.parser",
    )  # fmt: skip
    data = data_of(soup)
    assert [layer["name"] for layer in data["layers"]] == [
        f"z = {z:.3f} m" for z in (0.0, 0.5, 0.6, 1.0)]  # fmt: skip
    assert data["shown"] == 2
    assert [m[0] for m in data["layers"][2]["marks"]] == ["optimum"]
    assert [m[0] for m in data["layers"][0]["marks"]] == ["printed"]
    assert data["range"] == [0.0, 121.0]
    cells = np.frombuffer(base64.b64decode(data["layers"][1]["v"]), np.uint8).reshape(3, 3)
    expected = [[50 + 10 * y + x for x in (0.0, 0.5, 1.0)] for y in (2.0, 1.0, 0.0)]
    np.testing.assert_allclose(cells, np.round(254 * np.array(expected) / 121.0))


def test_where_nothing_is_feasible_the_map_is_grey():
    soup = BeautifulSoup(
        placement_slice("t", lambda p: -np.ones(len(p)), [[0, 1]] * 3, (0.5,) * 3, (0.5,) * 3,
                        steps=2, heights=2).html, "html.parser")  # fmt: skip
    assert "Grey: not feasible." in soup.get_text()
    assert data_of(soup)["range"] == [0.0, 1.0]
