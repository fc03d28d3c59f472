"""The status page shows how many changes were noticed, and names those that were not."""

import pytest

from dualarm_repro.errors import DataFileError
from dualarm_repro.ledger.files import to_json
from dualarm_repro.ledger.trust import Tally
from dualarm_repro.ledger.trust import report as stored
from dualarm_repro.view.trust import trust_page

ROOMS = ["dualarm_repro/arms"]


@pytest.fixture
def path(tmp_path, monkeypatch):
    found = tmp_path / "trust.json"
    monkeypatch.setattr(stored, "report_path", lambda: found)
    return found


def row(**changes):
    plain = {"file": "f.py", "line": 3, "column": 4, "old": "<", "new": ">=", "killed_by": "test t"}
    return {**plain, "equivalent": None, **changes}


def test_counts_and_what_went_unnoticed(path, registry):
    tallies = {"printed": Tally(9, ("xue.eq09: formula <a>",), ("xue.fig08: nothing judges 0",))}
    rows = [row(), row(killed_by=None), row(killed_by=None, equivalent="a larger buffer")]
    path.write_text(to_json(stored.report(tallies, ROOMS, 5, rows)))
    html = trust_page(registry)._repr_html_()
    assert "<td>9</td><td>8</td><td>1</td>" in html
    assert "<td>2</td><td>1</td><td>1</td>" in html
    assert "formula &lt;a&gt;" in html
    assert "f.py:3 &lt; -&gt; &gt;=" in html
    assert "could not be tried: 1." in html
    assert "have changed since" not in html


def test_an_outcome_of_other_methods_says_so(path, registry):
    path.write_text(to_json(stored.report({}, ROOMS, 5, [row()]) | {"code": "other"}))
    html = trust_page(registry)._repr_html_()
    assert "have changed since" in html
    assert "Not noticed" not in html


def test_without_an_outcome(path, registry):
    assert "make trust-ledger" in trust_page(registry)._repr_html_()
    path.write_text("[]")
    with pytest.raises(DataFileError, match="trust-ledger"):
        trust_page(registry)
