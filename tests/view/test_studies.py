"""Stored studies on the status page: what was recomputed, and that a difference stops the build."""

from types import SimpleNamespace

import pytest
from bs4 import BeautifulSoup

from dualarm_repro.errors import LedgerError
from dualarm_repro.ledger.spot import Spot
from dualarm_repro.view import studies


def study(name, cells, lacking=()):
    return SimpleNamespace(
        name=name, title=f"What of {name} <is>?", meta=lambda: {"cells": cells, "seed": 7},
        missing_peers=lambda: list(lacking),
    )  # fmt: skip


@pytest.fixture
def registry():
    return SimpleNamespace(studies={"a": study("a", 12), "b": study("b", 3, ["ompl", "pink"])})


@pytest.fixture
def checked(monkeypatch):
    """Arguments of the spot checks, and what each finds."""
    asked, found = [], {"wrong": [], "unsettled": []}

    def check(one, cells, seed):
        asked.append((one.name, cells, seed))
        return Spot(one, cells, **found)

    monkeypatch.setattr(studies, "spot_check", check)
    return asked, found


def rows(page):
    soup = BeautifulSoup(page.html, "html.parser")
    return [[cell.get_text() for cell in row(["th", "td"])] for row in soup("tr")]


def test_every_study_is_recomputed_in_part(registry, checked):
    asked, _ = checked
    head, one, other = rows(studies.studies_page(registry, cells=2, seed=5))
    assert asked == [("a", 2, 5), ("b", 2, 5)]
    assert head == ["study", "question", "cells", "seed", "spot check"]
    assert one == ["a", "What of a <is>?", "12", "7", "2 recomputed, equal"]
    assert other[4] == "2 recomputed, equal; ompl, pink not installed here, not compared"


def test_values_by_round_off_are_counted(registry, checked):
    checked[1]["unsettled"] = ["x", "y", "z"]
    assert rows(studies.studies_page(registry, seed=5))[1][4] == (
        "1 recomputed, equal, 3 values by round-off"
    )


def test_a_value_that_differs_stops_the_build(registry, checked):
    checked[1]["wrong"] = ["a, cell 3: share 0.5 is not 0.25"]
    with pytest.raises(LedgerError, match="a, cell 3"):
        studies.studies_page(registry, seed=5)


def test_the_seed_is_that_of_the_code_unless_one_is_given(registry, checked, monkeypatch):
    monkeypatch.setattr(studies, "seed_of_code", lambda: 99)
    studies.studies_page(registry)
    assert {seed for _, _, seed in checked[0]} == {99}


def test_draws_of_items_are_named(registry, monkeypatch):
    asked = []

    def check(given, items, seed):
        asked.append((given, items, seed))
        return [
            Spot(study(f"robustness/{name}", 1), 1, [], []) for name in ("xue.tab01", "pan.eq17")
        ]

    monkeypatch.setattr(studies, "spot_check_robustness", check)
    soup = BeautifulSoup(studies.robustness_page(registry, items=2, seed=3).html, "html.parser")
    assert asked == [(registry, 2, 3)]
    assert soup.get_text() == "Recomputed and equal: one draw each of xue.tab01, pan.eq17."
    assert [code.get_text() for code in soup("code")] == ["xue.tab01", "pan.eq17"]
