"""Tables of cells: digits, truths, gaps and the index."""

import numpy as np
import pandas as pd
from bs4 import BeautifulSoup

from dualarm_repro.view.cell_table import table

FRAME = pd.DataFrame(
    {"name": ["a < b", "c"], "x": [1 / 3, np.nan], "n": [12345, 2], "met": [True, False]}
)


def read(page):
    """Rows of texts."""
    rows = BeautifulSoup(page.html, "html.parser").find_all("tr")
    return [[cell.get_text() for cell in row.find_all(["th", "td"])] for row in rows]


def test_numbers_have_their_digits_and_whole_ones_stay_whole():
    assert read(table(FRAME)) == [
        ["name", "x", "n", "met"],
        ["a < b", "0.3333", "12345", "yes"],
        ["c", "", "2", "no"],
    ]
    assert read(table(FRAME, "{:.1f}"))[1] == ["a < b", "0.3", "12345", "yes"]
    assert read(table(FRAME, {"n": "{:.0e}"}))[1] == ["a < b", "0.3333", "1e+04", "yes"]


def test_an_index_that_says_something_is_shown():
    named = FRAME.set_index("name")
    assert read(table(named))[-1][0] == "c"
    counted = FRAME.rename_axis("turn")
    assert read(table(counted))[-1][0] == "1"


def test_the_same_frame_gives_the_same_page():
    assert table(FRAME).html == table(FRAME).html
