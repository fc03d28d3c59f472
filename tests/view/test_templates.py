"""The templates lay out a card as it is kept in ``cards.html``, and escape what is no markup."""

import re
from pathlib import Path

import pytest
from bs4 import BeautifulSoup
from bs4.element import NavigableString
from jinja2 import UndefinedError

from dualarm_repro.view.card import card_html, head_html, legend_html
from dualarm_repro.view.rendering import TEMPLATES, render

from .full_record import ADAPTED, EMPTY, FOREIGN, FULL

KEPT = BeautifulSoup(Path(__file__).with_name("cards.html").read_text("utf-8"), "html.parser")


def dom(node):
    """Names, attributes and texts of a tree; white space counts only as a space within a text."""
    if isinstance(node, NavigableString):
        return re.sub(r"\s+", " ", node).strip()
    children = [found for child in node.children if (found := dom(child))]
    return (node.name, dict(sorted(node.attrs.items())), children)


def laid_out(made):
    """Head and folds of a card with every part that it can have."""
    files = [("json", "../items/toy.x.json"), ("svg", "../items/toy.x.svg")]
    return head_html(made, "../") + card_html(made, "../", files, {"BibTeX": "@misc{<x>}"})


def parsed(html):
    return BeautifulSoup(f"<div>{html}</div>", "html.parser").div


@pytest.mark.parametrize(
    ("name", "made"),
    [("full", FULL), ("adapted", ADAPTED), ("empty", EMPTY), ("foreign", FOREIGN)],
)
def test_card_is_laid_out_as_kept(name, made):
    found = dom(parsed(laid_out(made)))
    assert found[2] == dom(KEPT.find(id=name))[2]


def test_legend_is_laid_out_as_kept():
    assert dom(parsed(legend_html()))[2] == dom(KEPT.find(id="legend"))[2]


def test_words_of_a_line_stay_apart():
    text = " ".join(parsed(laid_out(FULL)).get_text().split())
    for words in (
        "toy.x a < b (claim",
        "reproduced-under-assumption possible",
        "<w> & (assumed; width) 1 m",
        "toy.claim.",
    ):
        assert words in text, words


def test_every_template_refuses_a_value_that_is_not_given():
    for path in TEMPLATES.glob("*.html"):
        with pytest.raises(UndefinedError):
            render(path.stem)
