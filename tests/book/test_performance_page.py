"""The page of performance shows the whole stored run, and types none of its numbers."""

import re

import pytest
from chapters import BOOK, cells_of, run

from dualarm_repro.view.benchmark_run import stored


@pytest.fixture(scope="module")
def ran():
    return run("performance")


def test_every_cell_shows_what_it_promises(ran):
    assert (ran.silent, ran.warned, ran.left) == ([], [], [])
    assert all(len(code.splitlines()) <= 20 for code in cells_of("performance"))


def test_every_suite_and_curve_is_shown():
    text = "\n".join(cells_of("performance"))
    for row in stored().rows:
        assert f'"{row.suite}"' in text, row.suite
    for curve in stored().growth:
        assert f'growth_page(run, "{curve.name}"' in text or f"{curve.name}_page" in text


def test_every_claim_was_measured_where_nothing_is_missing():
    """A claim whose task or peer no row has is a slip of the pen."""
    found = stored()
    lost = [c.text for c in found.claims if (c.reason or "").startswith("not measured")]
    assert found.missing or found.cores == 1 or lost == []


def test_verdicts_of_the_stored_run_follow_from_its_numbers():
    for claim in stored().claims:
        if claim.value is not None:
            assert claim.gate_holds == (claim.margin >= 1.0), claim.text


def test_prose_has_no_typed_result():
    text = (BOOK / "performance.md").read_text(encoding="utf-8")
    prose = re.sub(r"^```.*?^```", "", text, flags=re.DOTALL | re.MULTILINE)
    assert not re.search(r"\d", prose)
