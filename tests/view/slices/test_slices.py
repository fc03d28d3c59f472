"""Slices: what is drawn, what a script reads, and what is refused."""

import base64
import json
import re

import numpy as np
import pytest

from dualarm_repro.errors import InputError
from dualarm_repro.view.slices import (
    Curve,
    Layer,
    curve_slice,
    distance_slice,
    map_slice,
    placement_slice,
    potential_slice,
)

X = np.linspace(-1.0, 1.0, 81)


def data_of(page):
    return json.loads(re.search(r'class="slice-data"[^>]*>(.*?)</script>', page.html, re.S)[1])


def circles(page):
    groups = re.findall(r'<g class="slice-minima".*?</g>', page.html, re.S)
    return [group.count("<circle") for group in groups]


def double_well(q):
    return (q[:, 0] ** 2 - 0.25) ** 2


def test_a_potential_with_and_without_the_virtual_point():
    line = X[:, np.newaxis] * [1.0, 0.0]
    made = potential_slice(
        "Two wells, and one that is gone.",
        line,
        {"U": double_well},
        {"the virtual point": lambda q: 0.3 * (q[:, 0] - 0.6) ** 2},
        x_label="s [rad]",
        x=X,
        marks={"trap": -0.5},
    )
    assert circles(made) == [1, 2]  # with it the trap is gone
    data = data_of(made)
    assert data["gains"] == {"the virtual point": 1.0}
    assert np.allclose(data["curves"][1]["terms"]["U"], double_well(line), rtol=1e-4)
    assert ">trap</text>" in made.html


def test_a_gain_scales_its_term():
    term = {"a": X**2}
    once, twice = (
        curve_slice("t", X, [Curve("y", term)], x_label="x", y_label="y", gains={"a": gain})
        for gain in (1.0, 2.0)
    )
    heights = [data_of(page)["axes"][1][1] for page in (once, twice)]
    assert heights[1] == pytest.approx(2.0 * heights[0])


def test_the_length_of_a_line_is_its_coordinate():
    line = np.linspace([0.0, 0.0], [3.0, 4.0], 11)
    made = potential_slice("t", line, {"U": double_well}, {}, x_label="s")
    assert data_of(made)["x"][-1] == pytest.approx(5.0)


def test_distances_in_millimetres_with_their_pairs():
    made = distance_slice(
        "Closest <pair>.",
        {"with": [0.2, 0.1, 0.05], "without": [0.2, -0.01]},
        levels={"range": 0.1},
        pairs=[("a", "b"), ("a", "c"), ("a", "c")],
    )
    data = data_of(made)
    assert data["curves"][1]["terms"]["without"] == [200.0, -10.0, -10.0]
    assert data["names"][1] == "a – c"
    assert ">contact</text>" in made.html
    assert ">range</text>" in made.html
    assert "Closest &lt;pair&gt;." in made.html


@pytest.mark.parametrize(
    ("x", "terms", "names"),
    [
        (X[::-1], {"a": X}, None),
        (X, {"a": X[1:]}, None),
        (X, {"a": X}, ["one"]),
    ],
)
def test_what_does_not_fit_is_refused(x, terms, names):
    with pytest.raises(InputError):
        curve_slice("t", x, [Curve("y", terms)], x_label="x", y_label="y", names=names)


def test_one_distance_at_a_time():
    with pytest.raises(InputError, match="one after the other"):
        distance_slice("t", {"a": np.ones((3, 2))})


def test_a_map_stores_values_from_the_top():
    values = np.array([[0.0, 1.0, 2.0], [3.0, np.nan, 5.0]])
    layers = [Layer("one", values, {"here": (0.0, 0.0)}), Layer("two", 0.5 * values, {})]
    made = map_slice(
        "Map.",
        ("x", [0.0, 1.0, 2.0]),
        ("y", [0.0, 1.0]),
        layers,
        quantity="J [m^3]",
        nothing="wall",
    )
    data = data_of(made)
    cells = np.frombuffer(base64.b64decode(data["layers"][0]["v"]), np.uint8).reshape(2, 3)
    assert cells[0].tolist() == [152, 255, 254]
    assert cells[1].tolist() == [0, 51, 102]
    assert 'href="data:image/png;base64,' in made.html
    assert "Grey: wall." in made.html
    with pytest.raises(InputError):
        map_slice("Map.", ("x", [0.0, 1.0]), ("y", [0.0, 1.0]), layers, quantity="J")


def test_the_plane_of_the_optimum_is_shown_first():
    optimum = np.array([0.2, 0.1, 0.45])
    made = placement_slice(
        "Landscape.",
        lambda p: 1.0 - 4.0 * np.sum((p - optimum) ** 2, axis=1),
        [[-1.0, 1.0], [-1.0, 1.0], [0.0, 1.0]],
        optimum,
        (0.1, 0.1, 0.9),
        steps=21,
        heights=5,
    )
    data = data_of(made)
    shown = data["layers"][data["shown"]]
    assert shown["name"] == "z = 0.450 m"
    assert [mark[0] for mark in shown["marks"]] == ["optimum"]
    assert 'data-ordered="yes"' in made.html
    assert "Grey: not feasible." in made.html
    cells = np.frombuffer(base64.b64decode(shown["v"]), np.uint8).reshape(21, 21)
    row, column = np.unravel_index(np.where(cells == 255, 0, cells).argmax(), cells.shape)
    assert abs(np.array([-1 + 0.1 * column, 1 - 0.1 * row]) - optimum[:2]).max() < 0.051


def test_nothing_is_loaded_from_elsewhere():
    made = distance_slice("t", {"a": [0.1, 0.2]})
    assert "http" not in made.html
