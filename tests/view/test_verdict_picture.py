"""The picture of all verdicts: a cell an item, which names it and leads to its page."""

import re

from bs4 import BeautifulSoup

from dualarm_repro.ledger import Verdict, record
from dualarm_repro.view.badge import SIGN
from dualarm_repro.view.tally import GROUPS, tally
from dualarm_repro.view.verdict_picture import PITCH, ROW, answer_page, panel, verdict_picture

from .full_record import FULL


def test_every_item_has_one_cell_with_name_and_link(registry):
    soup = BeautifulSoup(verdict_picture(registry, "../").html, "html.parser")
    cells = soup.select("svg a")
    assert [c["href"] for c in cells if c["href"].startswith("../items/")] == [
        c["href"] for c in cells
    ]
    assert {c["href"][9:-5] for c in cells} == set(registry.items)
    assert len(cells) == len(registry.items)
    for cell in cells:
        made = record(registry, cell["href"][9:-5])
        assert cell["class"] == [f"verdict-{made['verdict']}"]
        assert cell["aria-label"] == cell.title.get_text()
        assert made["id"] in cell["aria-label"]
        assert made["verdict"] in cell["aria-label"]
        assert cell.select_one("text").get_text() == SIGN[Verdict(made["verdict"])]
    assert soup.find("script") is None


def test_the_legend_counts_what_is_drawn(registry):
    soup = BeautifulSoup(verdict_picture(registry).html, "html.parser")
    counted = {a["href"].partition("=")[2]: int(a.get_text().split()[0])
               for a in soup.select(".ledger-legend a")}  # fmt: skip
    assert sum(counted.values()) == len(registry.items)
    for verdict, number in counted.items():
        assert len(soup.select(f"svg .verdict-{verdict}")) == number


def made_up(number, kind, verdict="reproduced"):
    return [
        {**FULL, "id": f"toy.{kind}{k}", "kind": kind, "verdict": verdict} for k in range(number)
    ]


def test_cells_do_not_overlap_and_stay_inside():
    shown = panel("toy", "T", made_up(ROW + 1, "claim") + made_up(1, "figure"))
    corners = [(cell.x, cell.y) for cell in shown.cells]
    assert len(set(corners)) == len(corners) == ROW + 2
    assert max(x for x, _ in corners) + PITCH <= shown.width + 2
    assert max(y for _, y in corners) + PITCH <= shown.height
    assert [text for _, text in shown.headings] == ["1 figure", f"{ROW + 1} claims"]
    assert all(y not in range(c.y, c.y + PITCH) for y, _ in shown.headings for c in shown.cells)


def test_the_same_verdicts_stand_side_by_side():
    mixed = [made_up(1, "claim", verdict)[0] for verdict in ("regenerated", "reproduced") * 2]
    shown = panel("toy", "T", mixed)
    assert [cell.verdict for cell in shown.cells] == ["reproduced"] * 2 + ["regenerated"] * 2


def test_in_chinese_with_original_titles(registry):
    soup = BeautifulSoup(verdict_picture(registry, language="zh").html, "html.parser")
    assert registry.papers["pan"].document.title_original in soup.get_text()
    assert "19 幅图" in soup.get_text()
    assert soup.select_one(".ledger-legend") is None


def test_the_answer_counts_every_item_once(registry):
    counts = tally(registry)
    assert sum(counts[name] for name in GROUPS) == counts["items"] == len(registry.items)
    assert set().union(*GROUPS.values()) == set(Verdict)
    numbers = [
        int(n)
        for n in re.findall(
            r"\d+", BeautifulSoup(answer_page(registry).html, "html.parser").get_text()
        )
    ]
    assert numbers[0] == sum(numbers[1:7]) == len(registry.items)
