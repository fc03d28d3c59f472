"""A flow chart holds its text, and every way starts and ends at the edge of a box."""

import matplotlib.pyplot as plt

from dualarm_repro.view.decisions import (
    Node,
    Way,
    above,
    below,
    decisions_figure,
    left_of,
    right_of,
)
from dualarm_repro.view.legibility import faults

NODES = {
    "first": Node("Take the first of all arms and nothing else", 1, 0),
    "ask": Node("Has it arrived within the tolerance?", 1, 1, question=True),
    "end": Node("Both paths are found", 2, 1, end=True),
}


def chart(text="yes 3"):
    ways = [
        Way([below(NODES["first"]), above(NODES["ask"])]),
        Way([right_of(NODES["ask"]), left_of(NODES["end"])], text),
    ]
    return decisions_figure(NODES, ways)


def test_a_chart_can_be_read():
    figure = chart()
    assert faults(figure) == []
    told = {text.get_text().replace("\n", " ") for text in figure.axes[0].texts}
    assert {"yes 3", *(node.text for node in NODES.values())} <= told
    plt.close(figure)


def test_text_beyond_its_box_is_a_fault():
    long = {**NODES, "ask": Node("a question of far too many words for one box " * 4, 1, 1, True)}
    figure = decisions_figure(long, [])
    assert faults(figure)
    plt.close(figure)


def test_sides_of_a_node_lie_around_it():
    node = NODES["ask"]
    assert left_of(node)[0] < node.column < right_of(node)[0]
    assert above(node)[1] < node.row < below(node)[1]
