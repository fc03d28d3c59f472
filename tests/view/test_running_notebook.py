"""An output of a cell brings style and viewer where the book does not."""

import pytest

from dualarm_repro.view.page import Page
from dualarm_repro.view.running_notebook import IN_BOOK
from dualarm_repro.view.static_meshcat import page_iframe, static_visualizer


@pytest.fixture
def page():
    return Page(page_iframe(static_visualizer(), "A scene", 300))


def test_in_the_book_nothing_is_added(page, monkeypatch):
    monkeypatch.setenv(IN_BOOK, "1")
    assert page._repr_html_() == page.html
    assert len(page.html) < 5_000


def test_elsewhere_the_scene_carries_its_viewer(page, monkeypatch):
    monkeypatch.delenv(IN_BOOK, raising=False)
    shown = page._repr_html_()
    assert "--pst-color-border" in shown
    assert ".ledger-item {" in shown
    assert len(shown) > 800_000
    assert "content_root" not in shown
    assert "content_root" in page.html


def test_a_page_without_a_scene_gets_the_style_alone(monkeypatch):
    monkeypatch.delenv(IN_BOOK, raising=False)
    shown = Page("<p>words</p>")._repr_html_()
    assert shown.endswith("</style><p>words</p>")
