"""The chapter of the arena runs on what is stored, and says what the stored rows say."""

import re

import pytest
from chapters import BOOK, cells_of, run

from dualarm_repro.arena import ARENA
from dualarm_repro.arena.study import PAPERS


@pytest.fixture(scope="module")
def ran():
    return run("arena")


def test_every_cell_shows_what_it_promises(ran):
    assert (ran.silent, ran.warned, ran.left) == ([], [], [])
    assert all(len(code.splitlines()) <= 20 for code in cells_of("arena"))


def test_a_build_reads_the_rows_and_computes_two_again(ran):
    assert len(ran.names["table"]) == len(ARENA.cells())
    assert ran.names["spot"].wrong == []
    assert ran.names["spot"].cells == 2
    text = "\n".join(cells_of("arena"))
    assert "ARENA.run" not in text
    assert text.count("spot_check(ARENA, 2") == 1


def test_prose_has_no_typed_result():
    text = (BOOK / "arena.md").read_text(encoding="utf-8")
    prose = re.sub(r"^```.*?^```", "", text, flags=re.DOTALL | re.MULTILINE)
    assert not re.search(r"\d+(\.\d+)? ?%", prose)


def test_who_wins_is_told_for_every_kind(ran):
    met = ran.names["met"]
    assert list(met) == [*dict.fromkeys(ran.names["rows"]["kind"]), "all"]
    for one in met.values():
        assert one.first in PAPERS
        assert one.second not in PAPERS
        assert one.difference.low <= one.difference.value <= one.difference.high
    told = [kind for kinds in ran.names["verdicts"].values() for kind in kinds]
    assert sorted(told) == sorted(set(met) - {"all"})
