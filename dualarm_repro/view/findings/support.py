"""Whether the records support a finding, and what it then says."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from ...ledger import Registry, record
from ..sentences import close_up, condition, fill
from .schema import Finding, read_findings

Records = Mapping[str, Mapping[str, Any]]


@dataclass(frozen=True)
class Told:
    """A finding as the records leave it.

    Attributes
    ----------
    name : str
        Document and name, ``"xue.rows_of_table_2"``.
    records : tuple
        Records it rests on.
    lapsed : tuple of str
        Conditions that do not hold; while there is one, nothing is said.
    title, text, under : str
        What it says; empty once it has lapsed, but for the title, which names it.
    """

    name: str
    records: tuple[Mapping[str, Any], ...]
    lapsed: tuple[str, ...]
    title: str
    text: str
    under: str

    @property
    def holds(self) -> bool:
        """Whether the records support it."""
        return not self.lapsed


def tell(name: str, finding: Finding, records: Records, language: str = "en") -> Told:
    """A finding filled from records, or the conditions that keep it from being said.

    Parameters
    ----------
    records
        Record of each item in ``rests_on``, by its id without the document.
    language
        ``"en"`` or ``"zh"``.

    Raises
    ------
    LedgerError
        A condition is no expression, or a text names a value that no record has.
    """
    known = {key: _readable(records[key]) for key in finding.rests_on}
    lapsed = tuple(text for text in finding.holds if not condition(text, name)(**known))
    title, text, under = (
        (finding.title_zh, finding.text_zh, finding.under_zh)
        if language == "zh"
        else (finding.title, finding.text, finding.under)
    )
    said = ["", ""] if lapsed else [fill(one or "", name, **known) for one in (text, under)]
    if language == "zh":
        said = [close_up(one) for one in said]
    return Told(name, tuple(records[key] for key in finding.rests_on), lapsed, title, *said)


def findings_of(registry: Registry, paper: str, language: str = "en") -> list[Told]:
    """The findings on a document, as its records leave them now."""
    return [_told(registry, paper, name, language) for name in read_findings(paper)]


def leading(registry: Registry, language: str = "en") -> list[Told]:
    """The findings that lead, over all documents, in their order."""
    ranked = [
        (finding.landing, paper, name)
        for paper in registry.papers
        for name, finding in read_findings(paper).items()
        if finding.landing is not None
    ]
    return [_told(registry, paper, name, language) for _, paper, name in sorted(ranked)]


def _told(registry: Registry, paper: str, name: str, language: str) -> Told:
    finding = read_findings(paper)[name]
    records = {key: record(registry, f"{paper}.{key}") for key in finding.rests_on}
    return tell(f"{paper}.{name}", finding, records, language)


def _readable(made: Mapping[str, Any]) -> dict[str, Any]:
    """A record with what is assumed by name."""
    rows = [*made["assumptions"], *made["context"]]
    return {**made, "assumed": {row["id"]: row["value"] for row in rows}}
