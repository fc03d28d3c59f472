"""An output of a cell brings its style where the book does not."""

import pytest

from dualarm_repro.view.page import Page
from dualarm_repro.view.running_notebook import IN_BOOK


@pytest.fixture
def page():
    return Page("<p>words</p>")


def test_in_the_book_nothing_is_added(page, monkeypatch):
    monkeypatch.setenv(IN_BOOK, "1")
    assert page._repr_html_() == page.html


def test_elsewhere_the_output_carries_the_style_of_cards_and_scenes(page, monkeypatch):
    monkeypatch.delenv(IN_BOOK, raising=False)
    shown = page._repr_html_()
    assert shown.endswith("</style><p>words</p>")
    for part in ("--pst-color-border", ".ledger-item {", ".scene-still"):
        assert part in shown


def test_a_text_names_no_place_in_memory(page):
    assert repr(page) == "Page of 12 characters of HTML"
