"""What a cell of a chapter ends in."""

import matplotlib.pyplot as plt
import pytest

from dualarm_repro.view import cell


def test_a_figure_is_shown_with_its_finding_and_alternative_text():
    figure, ax = plt.subplots()
    ax.plot([0, 1])
    html = cell.shown(figure, "It rises.", "A line that rises.").html
    assert '<p class="ledger-finding">It rises</p>' in html
    assert 'alt="A line that rises."' in html
    assert not plt.fignum_exists(figure.number)


def test_numbers_stand_beside_those_of_the_ledger(monkeypatch):
    ledger = {"steps": 185, "held": {"improved": 0.25}, "by_turn": {"0.5": [1.0, 1e-17]}}
    monkeypatch.setattr(cell, "obtained", lambda item_id: ledger)
    computed = {"steps": 184, "held.improved": 1 / 3, "by_turn.0.5": [1.0, 0.0]}
    table = cell.beside_ledger("xue.fig08", computed)
    assert table["xue.fig08"].to_dict() == {
        "steps": 185, "held.improved": "0.25", "by_turn.0.5": "1, 0"}  # fmt: skip
    assert table["this page"].to_dict() == {
        "steps": 184, "held.improved": "0.333333", "by_turn.0.5": "1, 0"}  # fmt: skip


def test_a_key_that_the_ledger_does_not_have_is_refused():
    with pytest.raises(KeyError):
        cell.value_at({"held": {"improved": 1}}, "held.traditional")


def test_the_ledger_is_asked_for_what_it_obtained():
    assert cell.obtained("xue.claim_gains")["k_r"] == 1.0
