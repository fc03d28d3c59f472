"""Views of a document: its record, its items with their verdicts, errata and citations."""

import pytest
from bs4 import BeautifulSoup
from ledger.toy import YAML, toy_registry

from dualarm_repro.errors import UnknownNameError
from dualarm_repro.ledger import Verdict, record
from dualarm_repro.view import document
from dualarm_repro.view.overview import counts_page, ledger_page, legend_page, verdict_counts
from dualarm_repro.view.tally import GROUPS, tally
from dualarm_repro.view.verdict_picture import answer_page, verdict_picture

MORE = """\
document:
  {id: toy, type: article, title: A <toy>, title_original: Ein Spiel, authors: ["Doe, J", "Roe, R"],
   journal: Toys & Games, year: "2020", unknown: [volume, pages]}
"""


@pytest.fixture
def registry(tmp_path, monkeypatch):
    monkeypatch.setenv("DUALARM_CACHE", str(tmp_path / "cache"))
    folder = tmp_path / "papers"
    folder.mkdir()
    _, _, rest = YAML.partition("assumptions:")
    return toy_registry(folder, f"{MORE}assumptions:{rest}")


def read(page):
    return BeautifulSoup(page.html, "html.parser")


def test_a_document_tells_what_is_known_of_it(registry):
    soup = read(document.document_page(registry, "toy"))
    assert soup.dl["id"] == "toy.document"
    told = dict(
        zip((t.get_text() for t in soup("dt")), (d.get_text() for d in soup("dd")), strict=True)
    )
    assert told == {
        "Title": "A <toy>", "Original title": "Ein Spiel", "Authors": "Doe, J; Roe, R",
        "Published in": "Toys & Games", "Year": "2020", "Not in the source": "volume, pages",
    }  # fmt: skip


def test_errata_come_with_those_that_are_proved_first(registry):
    soup = read(document.errata_page(registry, "toy"))
    assert [row["id"] for row in soup("li")] == ["toy.slip", "toy.word"]
    first, second = (row.get_text(" ") for row in soup("li"))
    assert "Proved : one is one" in " ".join(first.split())
    assert "No machine proof: wording only" in " ".join(second.split())
    assert soup.p.get_text() == "2 errata, 1 of them proved by computation."


def test_items_are_listed_with_links_from_one_folder_below(registry):
    rows = read(document.items_page(registry, "toy")).select(".ledger-row")
    assert [row.code.get_text() for row in rows] == [
        "toy.claim_area",
        "toy.claim_count",
        "toy.fig01",
    ]
    for row in rows:
        made = record(registry, row.code.get_text())
        assert row["data-verdict"] == made["verdict"]
        assert row.a["href"] == f"../items/{made['id']}.html"
    assert [len(row("a")) for row in rows] == [2, 2, 1], "a pending item is in no chapter"
    told = " ".join(rows[2].get_text(" ").split())
    assert "nothing yet: not drawn yet" in told


def test_the_bibliography_is_bibtex(registry):
    text = read(document.bibliography_page(registry)).pre.get_text()
    assert text.startswith("@article{")
    assert "Doe, J and Roe, R" in text
    assert "2020" in text


@pytest.mark.parametrize(
    "view",
    [document.document_page, document.items_page, document.errata_page, document.sentences_page],
)
def test_a_document_that_is_not_there_is_named_with_those_that_are(registry, view):
    with pytest.raises(
        UnknownNameError, match=r"^ledger: document = 'smith': expected one of toy$"
    ):
        view(registry, "smith")


def test_counts_add_up_by_document_and_verdict(registry):
    table = verdict_counts(registry)
    verdicts = [record(registry, item)["verdict"] for item in registry.items]
    for verdict in set(verdicts):
        assert table.loc["toy", verdict] == verdicts.count(verdict)
    assert table.loc["total", "total"] == 3
    soup = read(counts_page(registry))
    rows = [[cell.get_text().strip() for cell in row(["th", "td"])] for row in soup("tr")]
    assert rows[0] == ["verdict", "toy", "total"]
    assert rows[-1] == ["total", "3", "3"]
    assert sum(int(row[1]) for row in rows[1:-1]) == 3


def test_a_tally_groups_every_verdict_once(registry):
    counts = tally(registry)
    assert counts["items"] == 3 == sum(counts[name] for name in GROUPS)
    assert sum(counts["by_verdict"].values()) == 3
    assert tally(registry, "smith")["items"] == 0
    flat = [verdict for verdicts in GROUPS.values() for verdict in verdicts]
    assert sorted(flat) == sorted(Verdict)


def test_the_legend_explains_every_verdict():
    soup = read(legend_page())
    badges = [span.get_text().split()[-1] for span in soup.select(".verdict")]
    assert badges == list(Verdict)
    assert all(len(row.get_text().split()) > 3 for row in soup("li"))


def test_the_ledger_offers_what_there_is(registry):
    soup = read(ledger_page(registry))
    offered = {
        menu["name"]: [option.get_text() for option in menu("option")] for menu in soup("select")
    }
    assert offered["paper"] == ["all", "toy"]
    assert offered["kind"] == ["all", "claim", "figure"]
    assert offered["page"] == ["all", "toy/page"]


def test_the_picture_has_a_cell_for_each_item(registry):
    soup = read(verdict_picture(registry, "../"))
    names = [a["aria-label"] for a in soup.select("svg a")]
    assert len(names) == 3
    assert names[0].startswith("toy.fig01, A sketch: ")
    assert "Ein Spiel" in read(verdict_picture(registry, language="zh")).get_text()
    assert "3" in read(answer_page(registry)).get_text()
