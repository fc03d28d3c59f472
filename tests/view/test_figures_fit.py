"""Every figure can be read at the width of a page; the gate notices one that cannot."""

import re

import matplotlib.pyplot as plt
import numpy as np
import pytest
from long_tests import long_where
from matplotlib.patches import FancyBboxPatch, Polygon

from dualarm_repro.ledger.reference import read_costs
from dualarm_repro.papers import load
from dualarm_repro.view import diagrams
from dualarm_repro.view.legibility import faults
from dualarm_repro.view.page import pictures
from dualarm_repro.view.style import WIDTH, house_style

REGISTRY = load()


@pytest.fixture(autouse=True)
def _closed():
    yield
    plt.close("all")


def good():
    """A figure without a fault, for tests that spoil it."""
    with house_style():
        figure, ax = plt.subplots(figsize=(WIDTH, 3))
        ax.plot([0, 1], [0, 1])
        ax.set(xlabel="time [s]", ylabel="distance [m]")
    return figure, ax


#: Items whose pictures are drawn in short, none of which takes long; the book draws all.
DRAWN = [one for one in sorted(REGISTRY.checkers)[::9] if read_costs()[one] < 1.0]


@pytest.mark.parametrize("item_id", long_where(lambda one: one not in DRAWN, REGISTRY.checkers))
def test_figure_of_an_item_can_be_read(item_id):
    assert pictures(REGISTRY, item_id)["faults"] == []


def test_a_good_figure_has_no_fault():
    assert faults(good()[0]) == []


def test_small_letters_are_found():
    figure, ax = good()
    ax.text(0.5, 0.5, "tiny", fontsize=7)
    assert re.fullmatch(r"'tiny' has (6.9|7.0) pt at the width of the page", *faults(figure))


def test_a_figure_wider_than_the_page_shrinks_its_letters():
    figure, _ = good()
    figure.set_size_inches(1.5 * WIDTH, 3)
    assert any("pt at the width of the page" in fault for fault in faults(figure))


def test_clipped_text_is_found():
    figure, ax = good()
    ax.text(0.9, 0.5, "a long remark at the edge", clip_on=True)
    assert faults(figure) == ["'a long remark at the edge' is clipped"]


def test_text_outside_the_paper_is_found():
    figure, _ = good()
    figure.text(0.9, 0.5, "a long remark at the edge", in_layout=False)
    assert "'a long remark at the edge' leaves the paper" in faults(figure)


@pytest.mark.parametrize("rotation", [0, 30])
def test_texts_over_each_other_are_found(rotation):
    figure, ax = good()
    ax.text(0.5, 0.5, "one", rotation=rotation)
    ax.text(0.51, 0.5, "other", rotation=rotation)
    assert faults(figure) == ["'one' and 'other' overlap"]


def test_turned_texts_side_by_side_are_no_fault():
    figure, ax = good()
    for shift in (0.0, 0.06):
        ax.text(0.3 + shift, 0.3, "a turned text", rotation=45)
    assert faults(figure) == []


@pytest.mark.parametrize("shape", ["box", "rhombus"])
def test_text_that_leaves_its_box_is_found(shape):
    figure, ax = good()
    corners = [(0.3, 0.5), (0.5, 0.6), (0.7, 0.5), (0.5, 0.4)]
    box = (
        FancyBboxPatch((0.3, 0.4), 0.4, 0.2, boxstyle="round,pad=0", gid="box-1")
        if shape == "box"
        else Polygon(corners, gid="box-1")
    )
    ax.add_patch(box)
    text = ax.text(0.5, 0.5, "in", ha="center", va="center", gid="box-1")
    assert faults(figure) == []
    text.set_text("a step that is described in far too many words for it")
    assert [fault for fault in faults(figure) if fault.endswith("leaves its box")]


def test_axes_without_name_or_unit_are_found():
    figure, ax = good()
    ax.set(xlabel="", ylabel="distance")
    assert faults(figure) == ["the x axis has no name", 'the y axis "distance" has no unit']


def test_names_at_an_axis_need_no_unit():
    figure, ax = good()
    ax.set_yticks([0, 1], ["left", "right"])
    ax.set_ylabel("")
    assert faults(figure) == []


def _undocumented():
    """Choose the next position of everything that moves, and of whatever else is close to it."""


def _decide():
    """Is the goal as near as it was asked for, or has nothing moved for long?"""


WORDS = "a step whose description goes on for longer than anybody would want to read it"
NUMBERED = ("processor", "memory", "program")


@pytest.mark.parametrize(
    "draw",
    [
        lambda: diagrams.flow_chart([("one", WORDS, "room.module.some_function_of_a_long_name"),
                                     ("two", WORDS, "f"), ("two", "short", "g.h"),
                                     ("three", WORDS, "room.module.f")]),
        lambda: diagrams.loop_chart(_undocumented, [_undocumented, _decide], _decide),
        lambda: diagrams.block_diagram(dict.fromkeys(NUMBERED, "1"), [WORDS] * 9),
    ],
)  # fmt: skip
def test_boxes_hold_what_is_written_into_them(draw):
    assert faults(draw()) == []


def test_pages_of_the_foundations_can_be_read(monkeypatch):
    from dualarm_repro import load_arm
    from dualarm_repro.view.foundations import agreement, conventions, distances, manipulability

    found = {}
    for module in (agreement, conventions, distances, manipulability):

        def kept(figure, alt, caption, name=module.__name__):
            found.setdefault(name, []).extend(faults(figure))
            return ""

        monkeypatch.setattr(module, "figure_html", kept)
    arm, rng = load_arm("irb120"), np.random.default_rng(1)
    agreement.finite_differences_page(arm, arm.random_configurations(3, rng))
    conventions.frames_page("irb120", rng)
    distances.crease_page()
    manipulability.map_page(arm, (-0.2, 0.7, -0.3, 1.0), columns=21)
    assert not any(found.values())
    assert len(found) == 4
