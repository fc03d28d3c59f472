"""Cards: badge with share, witnesses, search, picture of robustness, way to the code."""

import re

import matplotlib.pyplot as plt
import pytest
from bs4 import BeautifulSoup

from dualarm_repro.ledger import record
from dualarm_repro.view.badge import badge, badge_of, percent
from dualarm_repro.view.card import card_figure, card_html, robustness_text
from dualarm_repro.view.firmness import firmness_svg
from dualarm_repro.view.wording import search_lines, verdict_line

from .full_record import FULL, POSSIBLE, ROBUST


@pytest.fixture(scope="module")
def made(registry):
    return record(registry, "xue.tab01")


def test_badge_shows_the_share_of_what_is_only_possible():
    text = badge("reproduced-under-assumption", ROBUST)
    assert "reproduced-under-assumption, 5 %" in text
    assert "1 to 16 %" in text
    assert "%" not in badge("not-reproduced", ROBUST).split(">", 1)[1]
    assert "%" not in badge("reproduced-under-assumption")


def test_a_share_of_properties_is_no_share_of_print():
    decided = {**FULL, "robustness": ROBUST, "decided_by": "toy.claim"}
    assert "%" not in badge_of(decided).split(">", 1)[1]
    assert "5 %" in badge_of({**decided, "decided_by": None})
    for told in (
        robustness_text(ROBUST, POSSIBLE, "toy.claim"),
        firmness_svg(ROBUST, POSSIBLE, "toy.claim"),
        verdict_line(decided),
    ):
        assert "properties hold" in told
        assert "rint is met" not in told


def test_percent_with_decimals():
    assert [percent(x, 1) for x in (0.042, 0.0004, 0.9996, 0.0)] == [
        "4.2 %", "< 0.1 %", "> 99.9 %", "0.0 %"
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("share", "text"),
    [(0.0, "0 %"), (0.004, "< 1 %"), (0.5, "50 %"), (0.996, "> 99 %"), (1.0, "100 %")],
)
def test_percent_says_all_or_nothing_only_where_it_is(share, text):
    assert percent(share) == text


def test_picture_has_a_bar_for_each_number():
    svg = BeautifulSoup(firmness_svg(ROBUST, POSSIBLE), "html.parser")
    bars = {t.get_text(): float(r["width"]) for t, r in zip(
        svg.find_all("text", attrs={"text-anchor": "end"}),
        [r for r in svg.find_all("rect") if r.get("fill")], strict=True)}  # fmt: skip
    assert list(bars) == ["print is met", "width", "shape<"]
    assert bars["width"] / bars["print is met"] == pytest.approx(0.61 / 0.05)
    assert "5 % of 32 draws" in svg.title.get_text()
    assert svg.find("path", class_="whisker")
    assert (
        len(
            BeautifulSoup(firmness_svg({**ROBUST, "influence": {}}, POSSIBLE), "html.parser")(
                "rect"
            )
        )
        == 2
    )


def test_sentence_on_robustness():
    text = robustness_text(ROBUST, POSSIBLE)
    assert "Print is met in 5 % of 32 draws" in text
    assert "width from 1 to 1.5, giving not-reproduced" in text
    assert "The properties hold in 5 %" in robustness_text(ROBUST, "regenerated")
    assert "No single change" in robustness_text({**ROBUST, "flip": None}, POSSIBLE)


def test_search_says_what_was_done_and_what_is_left():
    nearest = {"choice": "draw 3", "values": {}, "miss": 0.25}
    found = {"directed": False, "evaluations": 40, "nearest": nearest}
    one, two = search_lines({"search": found, "seek": "a posture"})
    assert "no directed search" in one
    assert "40 evaluations" in one
    assert "draw 3" in one
    assert two == "Still to be sought: a posture"
    assert search_lines({"search": None, "seek": None}) == []


def test_card_leads_to_the_lines_that_decide(made):
    soup = BeautifulSoup(card_html(made, "../"), "html.parser")
    link = soup.select_one(".ledger-code a")
    assert (
        link["href"] == "../_modules/dualarm_repro/papers/xue/pages/kinematics/chain.html#table_1"
    )
    assert re.search(r"chain\.py:\d+ table_1", link.get_text())


def test_card_shows_witnesses_thresholds_and_the_statement_that_decides(made):
    witness = {"choice": "draw 4", "verdict": "holds", "values": {"width": 2.0}}
    changed = {**made, "robustness": ROBUST, "witnesses": [witness], "decided_by": "toy.claim",
               "thresholds": {"limit": {"value": 0.5, "reason": "half <"}}}  # fmt: skip
    text = BeautifulSoup(card_html(changed), "html.parser").get_text(" ")
    for words in (
        "draw 4",
        "width: 2",
        "toy.claim",
        "limit",
        "half <",
        "The properties hold in 5 %",
    ):
        assert words in " ".join(text.split()), words


def test_the_figure_of_a_card_cuts_no_statement(made):
    label = "a statement that is longer than a line of the figure holds " * 4
    long = made | {"checks": [{**made["checks"][0], "label": label.strip()}]}
    figure = card_figure(long)
    words = " ".join(text.get_text() for text in figure.texts).split()
    assert " ".join(words).lower().count("a line of the figure holds") == 4
    figure.draw_without_rendering()
    width, _ = figure.canvas.get_width_height()
    for text in figure.texts:
        box = text.get_window_extent()
        assert box.x1 <= width
        assert box.y0 >= 0
        assert text.get_fontsize() >= 8.0
    plt.close(figure)
