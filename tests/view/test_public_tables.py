"""The tables of public arms say of each file what its row says."""

from io import StringIO

import pandas as pd
import pytest

from dualarm_repro.view import public_tables
from dualarm_repro.view.public_arms import PUBLIC_ARMS

ROW = {
    "file": "a/urdf/one.urdf", "loads": True, "said": "", "seconds": 3.21, "joints": 6.0,
    "flange": "tool0", "exact": True, "shapes": 8.0, "capsules": 57.0, "contained": True,
    "excess": 1.583, "home_clear": True, "home_flagged": False, "clear": 200.0,
    "false_alarms": 3.0, "missed": 0.0, "excluded": 4.0, "remedy": False, "pair_reached": True,
    "pair_reason": "found",
    "pair_lower": 0.0123, "pair_meshes": 0.0456, "pair_apart": 0.8,
}  # fmt: skip
OTHERS = [
    {**ROW, "file": "a/urdf/two.urdf", "home_flagged": True, "pair_reached": False,
     "pair_reason": "none found"},
    {**ROW, "file": "b/three.urdf", "home_clear": False, "pair_reached": None,
     "pair_reason": "touches itself", "pair_lower": None},
    {
        **dict.fromkeys(ROW),
        "file": "b/four.urdf", "loads": False, "remedy": True,
        "said": "b/four.urdf: collision shapes = 0: expected <shapes> or shapes=\"none\"",
    },
]  # fmt: skip


@pytest.fixture(autouse=True)
def stored(monkeypatch):
    """Four rows instead of the stored ones."""
    table = pd.DataFrame([ROW, *OTHERS])
    monkeypatch.setattr(type(PUBLIC_ARMS), "load", lambda _: table)


def cells(page):
    """Rows of a page, each a list of texts."""
    (found,) = pd.read_html(StringIO(page.html), keep_default_na=False)
    return found.astype(str).to_numpy().tolist()


def test_loading():
    rows = cells(public_tables.loading_page())
    assert rows[0] == ["one", "6", "tool0", "yes", "8", "57", "yes", "1.58", "3.2"]
    assert len(rows) == 3


def test_contact():
    one, two, three = cells(public_tables.contact_page())
    assert one == ["one", "accepted", "200", "1.5", "0", "4", "found", "0.8", "12.3", "45.6"]
    assert (two[1], two[6]) == ("refused", "none found")
    assert (three[1], three[6], three[7]) == ("touches", "touches itself", "0.8")


def test_refused():
    (only,) = cells(public_tables.refused_page())
    assert only == ["four", 'collision shapes = 0: expected <shapes> or shapes="none"']
    assert "&lt;shapes&gt;" in public_tables.refused_page().html


def test_counts():
    rows = dict(cells(public_tables.counts_page()))
    assert rows["files"] == "4"
    assert rows["of these accepted"] == "1"
