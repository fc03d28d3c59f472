"""Chinese on the pages: a summary of each part with its counts, and a name for every verdict."""

import re

import pytest
from bs4 import BeautifulSoup

from dualarm_repro.errors import LedgerError, UnknownNameError
from dualarm_repro.ledger import Verdict
from dualarm_repro.view.chinese import summary, summary_page, verdicts_page, words
from dualarm_repro.view.sentences import close_up
from dualarm_repro.view.tally import tally


def test_every_verdict_has_a_name_and_a_meaning():
    assert set(words().verdicts) == set(Verdict)
    names = [name for name, _ in words().verdicts.values()]
    assert len(set(names)) == len(names)


def test_a_summary_counts_the_items_of_its_document(registry):
    for paper in registry.papers:
        text, counts = summary(paper, registry), tally(registry, paper)
        told = [int(n) for n in re.findall(r"(\d+) 个", text)]
        assert told[0] == counts["items"] == sum(told[1:])
        assert 0 not in told


def test_a_summary_that_counts_nothing_needs_no_registry():
    html = summary_page("foundations").html
    assert 'lang="zh-Hans"' in html
    assert "D-H" in html
    with pytest.raises(LedgerError, match="xue"):
        summary("xue")
    with pytest.raises(UnknownNameError, match="smith"):
        summary("smith")


def test_a_summary_links_from_where_it_stands(registry):
    assert '<a href="../zh.html">' in summary("ledger", registry, "../")


def test_verdicts_with_their_numbers(registry):
    rows = BeautifulSoup(verdicts_page(registry).html, "html.parser").select("li")
    told = [int(re.search(r"（(\d+) 个）", row.get_text())[1]) for row in rows]
    assert sum(told) == len(registry.items)
    assert all(told)


def test_broken_lines_leave_no_space_between_chinese_signs():
    assert close_up("势场， 传统 有 8 次 runs") == "势场，传统有 8 次 runs"
