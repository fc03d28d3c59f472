"""The check of the built book notices printed words that a card does not show."""

import check_book
from lxml.html import document_fromstring

PRINTED = {"rows": [["0.53", "a  b"]], "trials": "10"}


def pages(text):
    return {"p": document_fromstring(f'<div id="toy.x">{text}</div>')}


def test_every_leaf_has_to_be_on_the_card():
    shown = pages("<td>0.53</td><td>a b</td>10")
    assert check_book.unprinted(shown, "p", "toy.x", "toy.x", PRINTED) == []
    assert check_book.unprinted(shown, "p", "toy.x", "toy.x", None) == []
    lines = check_book.unprinted(pages("0.53 a b"), "p", "toy.x", "toy.x", PRINTED)
    assert lines == ["p: the card of toy.x does not show the printed '10'"]


def test_a_page_that_is_missing_shows_nothing():
    assert len(check_book.unprinted({}, "p", "toy.x", "toy.x", PRINTED)) == 3
