"""The Sphinx extension writes a page for each item, which the search finds."""

import json
import re

import pytest
from bs4 import BeautifulSoup
from sphinx.application import Sphinx

ITEM = "xue.tab01"
CONF = "extensions = ['item_pages']\nhtml_theme = 'basic'\nitem_pages = ['xue.tab01']\n"


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    root = tmp_path_factory.mktemp("book")
    source, html = root / "source", root / "html"
    source.mkdir()
    (source / "conf.py").write_text(CONF)
    (source / "index.rst").write_text("Top\n===\n")
    app = Sphinx(source, source, html, root / "trees", "html", status=None, warning=None)
    app.build()
    return html


def test_page_with_its_files(built):
    soup = BeautifulSoup((built / f"items/{ITEM}.html").read_text(), "html.parser")
    assert soup.h1.get_text().startswith(f"{ITEM}: ")
    assert soup.select_one(".ledger-item .verdict-inconsistent-in-print")
    assert "1.225" in soup.select_one(".ledger-print").get_text()
    own = [a["href"] for a in soup.select(".ledger-item a[href^='../items/']")]
    assert own
    assert all((built / address.removeprefix("../")).is_file() for address in own)


def test_metadata_stands_in_the_head(built):
    soup = BeautifulSoup((built / f"items/{ITEM}.html").read_text(), "html.parser")
    data = json.loads(soup.head.find("script", type="application/ld+json").string)
    assert [one["@type"] for one in data["@graph"]] == ["ClaimReview", "Dataset"]


def test_search_finds_what_is_printed(built):
    index = (built / "searchindex.js").read_text()
    found = json.loads(re.search(r"Search\.setIndex\((.*)\)", index, re.DOTALL)[1])
    number = found["docnames"].index(f"items/{ITEM}")
    assert found["terms"]["number_1_225"] == number  # book/_static/search_numbers.js asks for it
    assert number in (
        found["terms"]["225"]
        if isinstance(found["terms"]["225"], list)
        else [found["terms"]["225"]]
    )
