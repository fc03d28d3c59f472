"""The files that are replayed are those of the command line, byte for byte."""

import pytest
from conftest import ITEMS
from exported import Export

#: One with a table of its own, one with values alone, one whose record names errata.
SOME = ("qiu.claim_bases", "pan.tab_none", "xue.eq03")


@pytest.mark.parametrize("ids", [SOME, pytest.param(ITEMS, marks=pytest.mark.long)])
def test_the_command_line_writes_them(files, ids, tmp_path):
    Export.drawn(ids, tmp_path)
    for name in (f"{item_id}.{suffix}" for item_id in ids for suffix in ("json", "csv")):
        assert (tmp_path / name).read_bytes() == (files / name).read_bytes(), name
