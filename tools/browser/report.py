"""What the browser found: problems by check, as JSON and on the status page of the same build."""

from __future__ import annotations

import json
import re
from collections import Counter
from collections.abc import Iterable
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from dualarm_repro.view.browser_report import ANCHOR, report_html

#: Every check, with what has to hold.
CHECKS = {
    "console": "no error in the console, no request that fails or leaves the book",
    "maths": "every formula is typeset",
    "width": "nothing wider than the screen, at 1440 and 390 px, light and dark, folds open",
    "access": "axe-core finds nothing serious or critical, light and dark",
    "size": "at most 3 MB besides what all pages share",
    "scripts": "text and pictures are there without scripts",
    "links": "every link and download leads somewhere",
    "scenes": "3-D scenes draw, and those that have a motion move",
    "use": "filters, folds, copying, search and dark mode work, from files; a newcomer gets from "
    "the front page to the verdict on xue.tab02, its reason, code, rerun and citation in 5 steps",
}
FILE = "_static/browser.json"
_BLOCK = re.compile(rf'<div id="{ANCHOR}">.*?</div><!-- {ANCHOR} -->', re.DOTALL)


@dataclass(frozen=True, order=True)
class Problem:
    """One thing that is wrong: the check that sees it, the page, and what it is."""

    check: str
    page: str
    text: str

    def __str__(self) -> str:
        return f"{self.page}: {self.check}: {self.text}"


@dataclass
class Report:
    """Outcome of a run."""

    chromium: str
    tried: Counter[str] = field(default_factory=Counter)
    pages: set[str] = field(default_factory=set)
    problems: list[Problem] = field(default_factory=list)

    def add(self, check: str, page: str, texts: Iterable[str]) -> None:
        """Note that a check looked at a page (or a scene, a use of it) and what it found."""
        self.tried[check] += 1
        self.pages.add(page)
        self.problems += [Problem(check, page, text) for text in texts]

    def content(self) -> dict[str, Any]:
        """The report as it is stored."""
        found = Counter(problem.check for problem in self.problems)
        rows = [
            {"check": name, "holds": text, "tried": self.tried[name], "problems": found[name]}
            for name, text in CHECKS.items()
        ]
        return {
            "chromium": self.chromium,
            "pages": len(self.pages),
            "problems": len(self.problems),
            "checks": rows,
            "listed": [asdict(problem) for problem in sorted(self.problems)],
        }


def publish(report: Report, html: Path) -> None:
    """Write the report into the built book, as a file and on its status page."""
    found = report.content()
    html.joinpath(FILE).write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
    status = html / "status.html"
    if not status.is_file():
        return
    text = status.read_text(encoding="utf-8")
    if not _BLOCK.search(text):
        raise ValueError(f"{status.name} has no place for the checks in a browser")
    status.write_text(_BLOCK.sub(lambda _: report_html(found), text), encoding="utf-8")
