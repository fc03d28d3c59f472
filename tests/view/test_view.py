"""Cards, badges and tables."""

import re

from dualarm_repro.ledger import MEANING, Verdict
from dualarm_repro.papers import show
from dualarm_repro.view.badge import SIGN, badge
from dualarm_repro.view.card import card_html, head_html
from dualarm_repro.view.overview import counts_page, ledger_page, verdict_counts
from dualarm_repro.view.wording import short

from .full_record import EMPTY


def test_every_verdict_has_meaning_sign_and_badge():
    assert set(MEANING) == set(SIGN) == set(Verdict)
    assert len(set(SIGN.values())) == len(Verdict)
    for verdict in Verdict:
        assert f"verdict-{verdict}" in badge(verdict)


def test_short_numbers():
    assert short([0.12345678, {"a": True}, None]) == "(0.1235, a: yes, none)"


def test_card_escapes_text():
    made = {**EMPTY, "title": "a < b", "missing": ["<script>"], "printed": {"a": "<b>"}}
    html = head_html(made, "") + card_html(made)
    assert "<script>" not in html
    assert "a &lt; b" in html
    assert "&lt;b&gt;" in html
    assert html.count("<details>") == html.count("</details>") == 1


def test_page_of_an_item():
    html = show("xue.fig02").html
    assert 'id="xue.fig02"' in html
    assert re.search(r'<img alt="[^"]{30,}" src="data:image/svg\+xml;base64,', html)
    assert "verdict-regenerated" in html
    assert "http" not in re.sub(r"base64,[^\"]*", "", html)


def test_overview_counts_everything(registry):
    table = verdict_counts(registry)
    assert table.loc["total", "total"] == len(registry.items)
    assert (table.iloc[:-1].sum() == table.iloc[-1]).all()
    assert 'id="verdict-counts"' in counts_page(registry).html
    assert ledger_page(registry).html.count('<details class="ledger-row"') == len(registry.items)


def test_sentences_of_a_document_lead_to_the_items_that_judge_them(registry):
    from dualarm_repro.view.document import sentences_page

    page = sentences_page(registry, "xue").html
    paper = registry.papers["xue"]
    judged = sum(bool(sentence.items) for sentence in paper.sentences)
    assert f"{len(paper.sentences)} sentences" in page
    assert f"items judge {judged} of them" in page
    assert page.count("<tr><td>") == len(paper.sentences)
    assert 'href="../items/xue.claim_virtual_escapes.html"' in page
    assert "none: " in page
