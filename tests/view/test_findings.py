"""Findings are filled from records, say nothing that these do not support, and can lapse."""

import copy
import re

import pytest
from bs4 import BeautifulSoup

from dualarm_repro.errors import DataFileError, LedgerError
from dualarm_repro.ledger import record
from dualarm_repro.view.findings import findings_of, findings_page, leading, leading_page, tell
from dualarm_repro.view.findings import support as supporting
from dualarm_repro.view.findings.schema import Finding, read_findings
from dualarm_repro.view.sentences import condition

from .full_record import FULL

DOCUMENTS = ("xue", "qiu", "patent", "pan")
NAMED = [(paper, name) for paper in DOCUMENTS for name in read_findings(paper)]
#: Digits that belong to a name, in either language.
NAMES = re.compile(
    r"(?:Table|Fig\.|Equation|base|表|图|式|基座) \(?\d+\)?|IRB 120|ER16|\b1/s"
)  # fmt: skip
TEXTS = ("title", "text", "under", "title_zh", "text_zh", "under_zh")
TOY = {
    "rests_on": ["x"], "holds": ["x.obtained.n > 1"], "title": "T <1>", "title_zh": "题",
    "text": "It is {{ x.obtained.n }} & {{ x.assumed.width }}.",
    "text_zh": "为 {{ x.obtained.n }}。",
}  # fmt: skip


def records_of(registry, paper, finding):
    return {key: record(registry, f"{paper}.{key}") for key in finding.rests_on}


@pytest.mark.parametrize(("paper", "name"), NAMED, ids=[f"{p}.{n}" for p, n in NAMED])
def test_the_records_support_it(registry, paper, name):
    told = tell(
        name, read_findings(paper)[name], records_of(registry, paper, read_findings(paper)[name])
    )
    assert told.holds, f"word it anew, for this is not true any more: {told.lapsed}"
    assert told.text
    assert "{" not in told.text + told.under


@pytest.mark.parametrize(("paper", "name"), NAMED, ids=[f"{p}.{n}" for p, n in NAMED])
def test_no_number_is_typed(paper, name):
    finding = read_findings(paper)[name]
    for field in TEXTS:
        typed = re.sub(r"\{\{.*?\}\}|\{%.*?%\}", "", getattr(finding, field) or "", flags=re.DOTALL)
        assert not re.search(r"\d", NAMES.sub("", typed)), f"{field}: {typed}"


@pytest.mark.parametrize(("paper", "name"), NAMED, ids=[f"{p}.{n}" for p, n in NAMED])
def test_both_languages_state_the_same_numbers(registry, paper, name):
    finding = read_findings(paper)[name]
    english, chinese = (
        tell(name, finding, records_of(registry, paper, finding), language)
        for language in ("en", "zh")
    )
    stated = [set(re.findall(r"\d+(?:\.\d+)?", told.text)) for told in (english, chinese)]
    assert stated[1]
    assert stated[1] <= stated[0]


@pytest.mark.parametrize(("paper", "name"), NAMED, ids=[f"{p}.{n}" for p, n in NAMED])
def test_what_was_assumed_is_said(registry, paper, name):
    finding = read_findings(paper)[name]
    assumed = any(made["assumptions"] for made in records_of(registry, paper, finding).values())
    assert bool(finding.under) == bool(finding.under_zh)
    assert finding.under or not assumed


def changed(value):
    """Records in each of which one value is another."""
    if isinstance(value, dict):
        for key, part in value.items():
            for other in changed(part):
                yield {**value, key: other}
    elif isinstance(value, list):
        yield []
        for k, part in enumerate(value):
            for other in changed(part):
                yield [*value[:k], other, *value[k + 1 :]]
    elif isinstance(value, bool):
        yield not value
    elif isinstance(value, int | float):
        yield from (0, 1e12, -1e12)
    elif isinstance(value, str):
        yield "another"
        yield "feasible"


def judged(made):
    """What a finding may look at, with what is assumed by name."""
    rows = [*made["assumptions"], *made["context"]]
    kept = {key: made[key] for key in ("verdict", "printed", "obtained", "thresholds")}
    witnesses = [{"verdict": one["verdict"]} for one in made["witnesses"]]
    return {**kept, "witnesses": witnesses, "assumed": {row["id"]: row["value"] for row in rows}}


@pytest.mark.parametrize(("paper", "name"), NAMED, ids=[f"{p}.{n}" for p, n in NAMED])
def test_every_condition_can_fail(registry, paper, name):
    finding = read_findings(paper)[name]
    known = {k: judged(made) for k, made in records_of(registry, paper, finding).items()}
    for text in finding.holds:
        holds = condition(text, name)
        named = [key for key in known if re.search(rf"\b{key}\b", text)]
        assert holds(**known)
        assert any(
            not holds(**{**known, key: other}) for key in named for other in changed(known[key])
        ), text


def test_five_of_each_document_and_ten_that_lead(registry):
    assert all(len(findings_of(registry, paper)) == 5 for paper in DOCUMENTS)
    ranks = [f.landing for paper in DOCUMENTS for f in read_findings(paper).values() if f.landing]
    assert sorted(ranks) == list(range(1, 11))
    assert {told.name.partition(".")[0] for told in leading(registry)} == set(DOCUMENTS)


def test_a_document_without_findings_has_none():
    assert read_findings("smith") == {}


def toy(n, **changes):
    finding = Finding.model_validate({**TOY, **changes})
    return tell("toy.it", finding, {"x": {**FULL, "obtained": {"n": n}}})


def test_a_finding_that_holds_and_one_that_has_lapsed():
    assert toy(2).text == "It is 2 & 1.0."
    lapsed = toy(1)
    assert not lapsed.holds
    assert lapsed.text == lapsed.under == ""
    assert lapsed.lapsed == ("x.obtained.n > 1",)


def test_a_value_that_is_missing():
    assert not toy(2, holds=["x.obtained.m > 1"]).holds
    with pytest.raises(LedgerError, match=r"toy\.it.*'m'"):
        toy(2, text="{{ x.obtained.m }}")
    with pytest.raises(LedgerError, match=r"toy\.it"):
        toy(2, holds=["x.obtained.n >"])


def test_a_field_that_is_misspelt(tmp_path):
    (tmp_path / "toy.yaml").write_text("findings: {it: {rest_on: [x]}}")
    with pytest.raises(DataFileError, match="rest_on"):
        read_findings("toy", tmp_path)


@pytest.mark.parametrize(
    ("language", "says"), [("en", "No longer supported."), ("zh", "此结论不再成立。")]
)
def test_the_page_says_that_a_finding_has_lapsed(registry, monkeypatch, language, says):
    def other(registry, item_id):
        made = copy.deepcopy(record(registry, item_id))
        if item_id == "xue.tab01":
            made["obtained"]["goal_distance"] = 0.0
        return made

    before = findings_page(registry, "xue", language).html
    monkeypatch.setattr(supporting, "record", other)
    soup = BeautifulSoup(findings_page(registry, "xue", language).html, "html.parser")
    assert says not in before
    (lapsed,) = soup.select(".ledger-lapsed")
    assert says in lapsed.get_text()
    assert "goal_distance > 0.1" in lapsed.get_text()
    assert lapsed.select_one("a[href='../items/xue.tab01.html']")
    assert "0.611" in before
    assert "0 m apart" not in soup.get_text()
    assert len(soup.select("ol > li")) == 5


def test_every_finding_leads_to_its_items(registry):
    soup = BeautifulSoup(leading_page(registry).html, "html.parser")
    rows = soup.select(".ledger-findings > li")
    assert len(rows) == 10
    for row in rows:
        for link in row.select("a"):
            assert link["href"] == f"items/{link.get_text()}.html"
            assert link.get_text() in registry.items
        assert len(row.select("a")) == len(row.select(".verdict")) > 0
