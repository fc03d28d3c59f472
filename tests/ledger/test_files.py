"""Files are written whole or not at all, and JSON says what numpy means."""

import json
import os
import stat

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualarm_repro.errors import OutputError
from dualarm_repro.ledger.files import through_json, to_json, write, write_text

PLAIN = st.recursive(
    st.none() | st.booleans() | st.integers(-(10**9), 10**9) | st.floats(-1e9, 1e9) | st.text(),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(), inner, max_size=3),
    max_leaves=8,
)


@settings(max_examples=50)
@given(value=st.dictionaries(st.text(), PLAIN, max_size=4))
def test_plain_values_come_back_as_they_were(value):
    assert through_json(value) == value
    assert json.loads(to_json(value, indent=None)) == value


def test_numpy_and_tuples_become_numbers_and_lists():
    made = through_json(
        {
            "array": np.array([[1.5, np.nan], [np.inf, -0.0]]),
            "count": np.int64(3),
            "flag": np.bool_(False),
            "pair": (1, (2.0, "a")),
            7: {"deep": np.float32(0.5)},
        }
    )
    assert made == {
        "array": [[1.5, None], [None, -0.0]],
        "count": 3,
        "flag": False,
        "pair": [1, [2.0, "a"]],
        "7": {"deep": 0.5},
    }
    assert type(made["count"]) is int
    assert type(made["flag"]) is bool


def test_text_is_kept_as_it_is_read():
    assert to_json({"a": "臂 – é"}, indent=None) == '{"a": "臂 – é"}\n'
    assert to_json([1], indent=2) == "[\n  1\n]\n"


def test_folders_are_made_and_a_file_is_replaced(tmp_path):
    path = tmp_path / "a" / "b" / "c.txt"
    assert write_text(path, "één") == path
    assert path.read_bytes() == "één".encode()
    write_text(path, "two")
    assert path.read_text() == "two"
    assert list(path.parent.iterdir()) == [path]


def test_permissions_are_those_of_any_new_file(tmp_path):
    mask = os.umask(0o027)
    try:
        path = write_text(tmp_path / "a.txt", "x")
    finally:
        os.umask(mask)
    assert stat.S_IMODE(path.stat().st_mode) == 0o640


@pytest.mark.parametrize("error", [RuntimeError("boom"), KeyboardInterrupt()])
def test_what_was_there_stays_when_writing_fails(tmp_path, error):
    path = write_text(tmp_path / "a.txt", "old")

    def save(temporary):
        temporary.write_text("new, but ha")
        raise error

    with pytest.raises(type(error)):
        write(path, save)
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_the_temporary_file_has_the_suffix_of_the_last(tmp_path):
    """Writers of figures and tables choose the format by it."""
    seen = []
    write(tmp_path / "figure.svg", lambda path: seen.append(path) or path.write_text("x"))
    assert seen[0].suffix == ".svg"
    assert seen[0].parent == tmp_path
    assert seen[0].name.startswith(".figure.")


def test_a_folder_in_the_place_of_the_file_is_refused_in_one_line(tmp_path):
    (tmp_path / "a.txt").mkdir()
    with pytest.raises(
        OutputError, match=r"a\.txt: output = .*a file that can be written"
    ) as caught:
        write_text(tmp_path / "a.txt", "x")
    assert "\n" not in str(caught.value)
    assert [path.name for path in tmp_path.iterdir()] == ["a.txt"]
