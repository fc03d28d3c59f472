"""YAML that cannot be read is refused in one line, at little cost."""

import time

import pytest

from dualarm_repro.datafiles import read_yaml
from dualarm_repro.errors import DataFileError

BOMB = "a0: &a0 [x, x]\n" + "".join(
    f"a{k}: &a{k} [{', '.join([f'*a{k - 1}'] * 9)}]\n" for k in range(1, 12)
)


@pytest.mark.parametrize(
    "text",
    [
        "? [a]\n: b",
        "x: 2024-13-45",
        "x: !!int abc",
        "x: !!float x",
        "x: !!bool x",
        f"x: {'9' * 5000}",
        "x: 2024-01-01T00:00:00+99:99",
        f"x: {'[' * 3000}{']' * 3000}",
        "a: &a [*a]",
        BOMB,
    ],
)
def test_values_that_no_yaml_can_hold(tmp_path, text):
    path = tmp_path / "file.yaml"
    path.write_text(text, encoding="utf-8")
    start = time.process_time()
    with pytest.raises(DataFileError) as caught:
        read_yaml(path)
    assert time.process_time() - start < 2.0
    message = str(caught.value)
    assert str(path) in message
    assert "\n" not in message
    assert len(message) < 1000


def test_a_path_that_cannot_be(tmp_path):
    with pytest.raises(DataFileError, match="readable YAML file"):
        read_yaml(tmp_path / "a\0b.yaml")


def test_aliases_of_ordinary_size_are_written_out(tmp_path):
    path = tmp_path / "file.yaml"
    path.write_text("a: &a [1, 2]\nb: *a\nc: {e: *a}\n", encoding="utf-8")
    assert read_yaml(path) == {"a": [1, 2], "b": [1, 2], "c": {"e": [1, 2]}}
