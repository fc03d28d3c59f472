"""Captions are filled from templates beside the pages, with the numbers that are judged."""

import shutil

import numpy as np
import pytest

from dualarm_repro.errors import LedgerError
from dualarm_repro.ledger import captions as rooms
from dualarm_repro.ledger.captions import captions, point
from dualarm_repro.ledger.result import Result
from dualarm_repro.tracking import recording

TEXT = """{% block fig01 %}
  {{ misses }} of
  {{ runs }} miss{% if shares %}, {{ shares|to(".1%") }} at ({{ at|point(2) }}){% endif %}.
{% endblock %}"""


@pytest.fixture
def caption(tmp_path, monkeypatch):
    monkeypatch.setattr(rooms, "_PACKAGE", tmp_path)
    (tmp_path / "page.j2").write_text(TEXT)
    return captions(str(tmp_path / "page.py"))


def test_values_of_the_result_and_its_own(caption):
    made = Result({"misses": 3, "runs": 9}, caption("fig01", runs=10, shares=0.3, at=[1, -0.0]))
    assert made.told() == "3 of 10 miss, 30.0% at (1.00, 0.00)."
    assert Result({}, "as it is").told() == "as it is"


def test_the_template_is_an_input_only_of_what_reads_it(caption):
    with recording() as inputs:
        made = Result({"misses": 3, "runs": 10, "shares": None}, caption("fig01"))
    assert inputs == set()
    with recording() as inputs:
        assert made.told() == "3 of 10 miss."
    assert inputs == {"dualarm_repro/page.j2"}


def test_another_wording_is_seen_at_once(caption, tmp_path):
    made = caption("fig01", misses=1, runs=2, shares=None)
    assert made.told({}) == "1 of 2 miss."
    (tmp_path / "page.j2").write_text("{% block fig01 %}None.{% endblock %}")
    assert made.told({}) == "None."


@pytest.mark.parametrize(
    ("block", "values"),
    [("fig02", {}), ("fig01", {"misses": 1}), ("fig01", {"misses": 1, "runs": 2, "shares": "x"})],
)
def test_what_cannot_be_filled(caption, block, values):
    with pytest.raises(LedgerError, match=rf"page\.j2, {block}"):
        caption(block, **values).told({})


def test_a_missing_template(caption, tmp_path):
    shutil.move(tmp_path / "page.j2", tmp_path / "other.j2")
    with pytest.raises(LedgerError, match=r"page\.j2"):
        caption("fig01").told({})


def test_point():
    assert point(np.array([-1e-13, 0.12344, 2.0])) == "0.0000, 0.1234, 2.0000"
