"""What is kept between processes is trusted only while all it depends on is as it was."""

import json

import pytest

from dualarm_repro.ledger import kept
from dualarm_repro.ledger.closure import hash_file, hash_inputs

from .toy import YAML, toy_registry

ROOTS = ["dualarm_repro.ledger.printed"]
INPUT = "papers/toy.yaml#items.claim_area.printed"


@pytest.fixture
def cache(tmp_path, monkeypatch):
    monkeypatch.setenv("DUALARM_CACHE", str(tmp_path / "cache"))
    return tmp_path / "cache"


@pytest.fixture
def toy(tmp_path):
    return toy_registry(tmp_path)


def entry_of(cache):
    return json.loads((cache / "numbers" / "one.json").read_text())


@pytest.mark.parametrize("value", [{"a": [1, 2.5, None]}, [1, 2], "text", 0])
def test_a_value_comes_back(toy, cache, value):
    assert kept.read(toy, "numbers", "one") is None
    kept.keep(toy, "numbers", "one", value, ROOTS, [INPUT])
    assert kept.read(toy, "numbers", "one") == value
    assert kept.read(toy, "numbers", "other") is None
    assert kept.path_of("numbers", "one") == cache / "numbers" / "one.json"


def test_another_print_is_a_miss_and_another_part_is_not(toy, cache, tmp_path):
    kept.keep(toy, "numbers", "one", 7, ROOTS, [INPUT])
    changed = tmp_path / "changed"
    changed.mkdir()
    elsewhere = toy_registry(changed, YAML.replace("title: The count", "title: Another"))
    assert kept.read(elsewhere, "numbers", "one") == 7
    reprinted = toy_registry(changed, YAML.replace('area: "1.00"', 'area: "1.01"'))
    assert kept.read(reprinted, "numbers", "one") is None


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("code", "0" * 64),
        ("versions", {"numpy": "0.1"}),
        ("value", 8),
        ("sha256", "0" * 64),
        ("inputs", {INPUT: "0" * 64}),
        ("inputs", {"papers/none.yaml#items.x": "0" * 64}),
        ("inputs", [1]),
        ("roots", None),
    ],
)
def test_whatever_differs_is_a_miss_and_never_an_error(toy, cache, field, value):
    kept.keep(toy, "numbers", "one", 7, ROOTS, [INPUT])
    path = cache / "numbers" / "one.json"
    path.write_text(json.dumps(entry_of(cache) | {field: value}))
    assert kept.read(toy, "numbers", "one") is None


def test_nothing_is_kept_where_the_cache_is_off(toy, cache, monkeypatch):
    monkeypatch.setenv("DUALARM_CACHE", "off")
    kept.keep(toy, "numbers", "one", 7, ROOTS, [])
    assert kept.path_of("numbers", "one") is None
    assert kept.read(toy, "numbers", "one") is None
    assert not cache.exists()


def test_a_cache_that_cannot_be_written_only_costs_time(toy, cache):
    cache.write_text("a file where the folder would be")
    kept.keep(toy, "numbers", "one", 7, ROOTS, [])
    assert kept.read(toy, "numbers", "one") is None


def test_an_entry_names_its_code_inputs_and_versions(toy, cache):
    kept.keep(toy, "numbers", "one", 7, [*ROOTS, "dualarm_repro.errors"], [INPUT])
    entry = entry_of(cache)
    assert entry["roots"] == ["dualarm_repro.errors", *ROOTS]
    assert entry["inputs"] == hash_inputs(toy, [INPUT])
    assert "python" in entry["versions"]


def test_hashes_of_files_and_of_what_is_not_there(tmp_path):
    path = tmp_path / "a.txt"
    assert hash_file(path) == "absent"
    path.write_bytes(b"abc")
    assert hash_file(path).startswith("ba7816bf8f01cfea")
