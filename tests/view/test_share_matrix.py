"""A matrix of shares: one cell each, with the interval, named rows and columns."""

import matplotlib.pyplot as plt

from dualarm_repro.ledger.shares import Share
from dualarm_repro.view.share_matrix import share_matrix_figure


def test_every_share_has_its_cell_and_the_names_are_those_given():
    rows = {
        "one": {"a": Share.of(1, 10), "b": Share.of(9, 10)},
        "two": {"a": Share.of(0, 4), "b": Share.of(4, 4)},
    }
    figure = share_matrix_figure(rows, "missed [%]", {"two": "print: 8"})
    (ax,) = figure.axes
    texts = [text.get_text() for text in ax.texts]
    assert [text.split("\n")[0] for text in texts] == ["10", "90", "0", "100"]
    assert texts[0].split("\n")[1] == "2-40"
    assert [label.get_text() for label in ax.get_yticklabels()] == ["one", "two\nprint: 8"]
    assert [label.get_text() for label in ax.get_xticklabels()] == ["a", "b"]
    assert ax.get_xlabel() == "missed [%]"
    assert min(text.get_fontsize() for text in ax.texts) >= 8
    plt.close(figure)
