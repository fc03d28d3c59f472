"""Diagrams: boxes in order and apart, arrows from edge to edge, every step with its words."""

import re

import numpy as np
import pytest
from matplotlib.patches import FancyBboxPatch, Polygon

from dualarm_repro.view import diagrams
from dualarm_repro.view.legibility import faults
from dualarm_repro.view.style import WIDTH

STEPS = [
    ("search", "Choose the next step of everything that moves", "planning.search.next_step"),
    ("search", "Look whether it is free of contact", "scene.clearance"),
    ("smooth", "Join both halves", ""),
    ("smooth", "Lay a spline through the corners of the joined path", "planning.spline.fitted"),
]


def boxes(ax):
    """Corner and size of each box by its name."""
    found = {}
    for patch in ax.patches:
        if isinstance(patch, FancyBboxPatch):
            x, y = patch.get_x(), patch.get_y()
            found[patch.get_gid()] = (x, y, x + patch.get_width(), y + patch.get_height())
    return found


def arrows(ax):
    """Start and end (2, 2) of each arrow."""
    return [np.array([text.xyann, text.xy]) for text in ax.texts if not text.get_text()]


def plain(text):
    return re.sub(r"\s+", " ", text.get_text())


def on_edge(point, box, slack=1e-9):
    x0, y0, x1, y1 = box
    inside = x0 - slack <= point[0] <= x1 + slack and y0 - slack <= point[1] <= y1 + slack
    gaps = (abs(point[0] - x0), abs(point[0] - x1), abs(point[1] - y0), abs(point[1] - y1))
    return inside and min(gaps) <= slack


def test_a_flow_chart_has_a_column_for_each_part():
    figure = diagrams.flow_chart(STEPS)
    ax = figure.axes[0]
    found = boxes(ax)
    assert list(found) == ["box-0-0", "box-0-1", "box-1-0", "box-1-1"]
    told = {plain(text) for text in ax.texts}
    assert {"search", "smooth", *(text for _, text, _ in STEPS)} <= told
    code = {text.get_text().replace("\n", "") for text in ax.texts
            if text.get_family() == ["monospace"]}  # fmt: skip
    assert code == {one for _, _, one in STEPS if one}
    first, second, third, fourth = found.values()
    assert first[1] > second[3], "the second step stands below the first"
    assert first[2] < third[0], "the second part stands to the right of the first"
    assert third[1] > fourth[3]
    width, height = figure.get_size_inches()
    assert width <= WIDTH
    for x0, y0, x1, y1 in found.values():
        assert 0.0 <= x0 < x1 <= width
        assert 0.0 <= y0 < y1 <= height
    assert faults(figure) == []


def test_arrows_of_a_flow_chart_join_the_boxes_in_order():
    ax = diagrams.flow_chart(STEPS).axes[0]
    found = list(boxes(ax).values())
    drawn = arrows(ax)
    assert len(drawn) == 3
    for (start, end), before, after in zip(drawn[:1], found[:1], found[1:2], strict=True):
        assert on_edge(start, before)
        assert on_edge(end, after)
    elbow = drawn[1]
    assert on_edge(elbow[1], found[2])
    first_line = np.column_stack(ax.lines[0].get_data())
    assert on_edge(first_line[0], found[1]), "it leaves the last step of the part before"
    assert on_edge(drawn[2][0], found[2])
    assert on_edge(drawn[2][1], found[3])


def first():
    """Draw the first generation at random."""


def bred():
    """Breed the next generation from the fittest.

    More that is not shown.
    """


def stopped():
    """Has the last generation been reached?"""


def test_a_loop_returns_to_its_first_step():
    figure = diagrams.loop_chart(first, [bred, stopped], stopped)
    ax = figure.axes[0]
    told = {plain(text) for text in ax.texts}
    assert {"Draw the first generation at random", "Breed the next generation from the fittest",
            "Has the last generation been reached?", "next generation", "yes",
            "best individual"} <= told  # fmt: skip
    assert not any("not shown" in text for text in told)
    (rhombus,) = [patch for patch in ax.patches if isinstance(patch, Polygon)]
    corners = rhombus.get_xy()[:4]
    found = boxes(ax)
    assert len(found) == 2
    x0, y0, _, y1 = found["box-1"]
    back = next(a for a in arrows(ax) if np.allclose(a[1], (x0, 0.5 * (y0 + y1))))
    assert back[0][0] < back[1][0], "it comes from the left"
    loop = np.column_stack(ax.lines[0].get_data())
    np.testing.assert_allclose(loop[-1], back[0])
    right = corners[corners[:, 0].argmax()]
    assert any(np.allclose(a[0], right) for a in arrows(ax)), "the way out leaves the decision"
    assert faults(figure) == []


def test_a_function_without_a_docstring_goes_by_its_name():
    def quiet():
        pass

    ax = diagrams.loop_chart(quiet, [bred, stopped], stopped).axes[0]
    assert "quiet" in {plain(text) for text in ax.texts}


def test_a_device_holds_a_program_that_is_numbered():
    numbers = {"processor": "601", "memory": "602", "program": "603"}
    figure = diagrams.block_diagram(numbers, ["read the joints", "solve", "send the speeds"])
    ax = figure.axes[0]
    told = [text.get_text() for text in ax.texts if text.get_text()]
    for name, mark in numbers.items():
        assert f"{name} {mark}" in told
    (program,) = [text for text in told if text.startswith("1. ")]
    assert program.splitlines() == ["1. read the joints", "2. solve", "3. send the speeds"]
    found = boxes(ax)
    memory = next(patch for patch in ax.patches if patch.get_gid() == "box-memory")
    x0, y0 = memory.get_xy()
    inner = found["box-program"]
    assert x0 < inner[0] < inner[2] < x0 + memory.get_width()
    assert y0 < inner[1] < inner[3] < y0 + memory.get_height(), "the program lies in the memory"
    (arrow,) = arrows(ax)
    assert on_edge(arrow[1], found["box-processor"])
    assert arrow[0][0] == pytest.approx(x0)
    colours = {patch.get_gid(): patch.get_edgecolor() for patch in ax.patches}
    assert colours["box-processor"] != colours["box-program"]
    assert faults(figure) == []


@pytest.mark.parametrize(
    ("code", "wide", "lines"),
    [("a.b", 3.0, ["a.b"]), ("module.function_name", 0.9, ["module.", "function_", "name"]),
     ("", 3.0, [""])],
)  # fmt: skip
def test_code_breaks_at_dots_and_underscores(code, wide, lines):
    text, wrapped = diagrams._wrapped("words", code, wide)
    assert wrapped.split("\n") == lines
    assert wrapped.replace("\n", "") == code
    assert text == "words"
