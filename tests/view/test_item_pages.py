"""What a reader finds below a card: sorted assumptions, source, files, citation, metadata."""

import json
import re
from base64 import b64encode

import pytest
from bs4 import BeautifulSoup

from dualarm_repro.ledger import record
from dualarm_repro.ledger.project import project
from dualarm_repro.view.assumption_rows import assumption_rows, rerun
from dualarm_repro.view.item_files import (
    address,
    beside_page,
    links,
    where,
    write_files,
)
from dualarm_repro.view.item_table import item_table
from dualarm_repro.view.overview import ledger_page
from dualarm_repro.view.page import own_page, present
from dualarm_repro.view.source_code import highlighted, source_of
from dualarm_repro.view.structured_data import script, structured_data

from .full_record import FULL, ROBUST

ITEM = "xue.tab01"
DRAWN = {
    "figure": f'<img src="data:image/svg+xml;base64,{b64encode(b"<svg/>").decode()}">',
    "scene": "<figure></figure>",
    "csv": "a,b\n1,2\n",
}


def entry(name, **more):
    return {"id": name, "statement": name, "value": 1.0, "why": "", "evidence": "assumed", **more}


def test_what_matters_comes_first():
    entries = [entry("idle", range=[0.5, 2.0]), entry("shape<", choices=["a_b", "c"], value="a_b"),
               entry("width", unit="m")]  # fmt: skip
    rows = assumption_rows({**FULL, "assumptions": entries, "robustness": ROBUST})
    assert [row.id for row in rows] == ["width", "shape<", "idle"]
    assert [row.moves for row in rows] == [True, True, False]
    assert rows[0].flip == "alone flips the outcome at 1.5 m"
    assert (rows[1].value, rows[1].plausible) == ("a b", "or c")
    assert rows[2].plausible == "0.5 to 2"


def test_the_command_that_changes_an_assumption():
    flipped = "dualarm run toy.x --set width=1.5", "with the choice that flips it"
    assert rerun({**FULL, "robustness": ROBUST}) == flipped
    firm = {**FULL, "robustness": {**ROBUST, "flip": None}}
    assert rerun(firm) is None, "no assumption has another plausible value"
    one = {"id": "reading", "value": "a", "choices": ["a", "b"]}
    changed = "dualarm run toy.x --set reading=b", "with an assumption changed"
    assert rerun({**firm, "assumptions": [one]}) == changed


def test_source_is_that_of_the_function(registry):
    source = source_of(record(registry, ITEM)["code"])
    assert source.startswith("@")
    assert "def table_1(" in source
    assert "table_1" in BeautifulSoup(highlighted(source), "html.parser").pre.get_text()
    assert source_of({"file": "dualarm_repro/errors.py", "function": "nowhere"}) is None
    assert source_of({"file": "/etc/hostname", "function": "f"}) is None


def test_files_are_written_and_linked(tmp_path, registry):
    made = record(registry, ITEM)
    written = write_files(made, DRAWN, tmp_path)
    assert [path.relative_to(tmp_path).as_posix() for path in written] == [
        f"items/{ITEM}.{kind}" for kind in ("json", "csv", "svg", "scene.html")
    ]
    assert [f"{tmp_path}/{at}" for _, at in links(made, DRAWN, "")] == [str(p) for p in written]
    assert json.loads(written[0].read_text())["id"] == ITEM
    assert written[2].read_bytes() == b"<svg/>"
    assert 'data-content_root="../"' in written[3].read_text()
    assert f'src="../items/{ITEM}.svg"' in beside_page(DRAWN["figure"], links(made, DRAWN, "../"))


def test_the_page_can_be_opened_where_it_is_built(tmp_path):
    assert where(ITEM, tmp_path) == address(ITEM) == "items/xue.tab01.html"
    page = tmp_path / address(ITEM)
    page.parent.mkdir()
    page.write_text("")
    assert where(ITEM, tmp_path) == page.as_uri()


def test_a_card_leads_to_its_page_data_code_and_citation(registry):
    soup = BeautifulSoup(present(registry, ITEM).html, "html.parser")
    titles = [summary.get_text().split(" (")[0].strip() for summary in soup("summary")]
    assert titles[-3:] == ["Code", "Data", "Cite"]
    assert soup.select_one(".ledger-permalink")["href"] == f"../items/{ITEM}.html"
    assert {a["href"] for a in soup.select("details a") if "items/" in a["href"]} >= {
        f"../items/{ITEM}.json", f"../items/{ITEM}.csv"}  # fmt: skip
    assert soup.select_one(".ledger-source .highlight pre")
    assert all(pre.find_parent(class_="highlight") for pre in soup.select(".ledger-cite pre"))


def test_the_own_page_holds_the_card_and_the_way_back(registry):
    soup = BeautifulSoup(own_page(registry, ITEM), "html.parser")
    assert soup.find(id="card")
    assert soup.find(id=ITEM) is None  # the anchor of the card in the chapter
    assert soup.find("a", href="../xue/kinematics.html#xue.tab01")
    assert soup.select_one(".ledger-permalink") is None


def test_structured_data_is_a_review_and_a_data_set(registry):
    made = record(registry, ITEM)
    document = registry.paper_of(ITEM).document
    data = structured_data(made, document, project(), links(made, DRAWN, "../"))
    review, dataset = data["@graph"]
    assert (review["@type"], dataset["@type"]) == ("ClaimReview", "Dataset")
    assert review["reviewRating"]["alternateName"] == made["verdict"]
    assert review["itemReviewed"]["appearance"]["name"] == document.title
    assert dataset["distribution"][0]["contentUrl"] == f"items/{ITEM}.json"
    assert 50 <= len(dataset["description"]) <= 5000
    element = BeautifulSoup(script({"a": "</script>"}), "html.parser").script
    assert json.loads(element.string) == {"a": "</script>"}


@pytest.fixture(scope="module")
def ledger(registry):
    return BeautifulSoup(ledger_page(registry).html, "html.parser")


def test_the_ledger_has_one_line_an_item(ledger, registry):
    rows = ledger.select("details.ledger-row")
    assert [row.summary.code.get_text() for row in rows] == list(registry.items)
    assert not any(row.has_attr("open") for row in rows)
    assert rows[0].find("a", href=re.compile(r"^items/"))


def test_the_menus_offer_what_the_rows_have(ledger):
    rows = ledger.select("details.ledger-row")
    for menu in ledger("select"):
        offered = {option.get_text() for option in menu("option")} - {"all"}
        assert offered == {row[f"data-{menu['name']}"] for row in rows} - {""}
    assert {menu["name"] for menu in ledger("select")} == {"paper", "kind", "verdict", "page"}
    assert "location.hash" in ledger.script.get_text()


def test_a_table_below_the_top_finds_its_way(registry):
    soup = BeautifulSoup(item_table(registry, [ITEM], root="../"), "html.parser")
    assert [a["href"] for a in soup("a")] == [
        "../items/xue.tab01.html", "../xue/kinematics.html#xue.tab01"]  # fmt: skip
