"""Records: what they say, and when one that is kept is used again."""

import json

import pytest

from dualarm_repro.ledger import kept, record
from dualarm_repro.tracking import recording

from .toy import YAML, toy_registry


@pytest.fixture
def toy(tmp_path):
    return toy_registry(tmp_path)


def test_record_is_json_and_says_everything(toy):
    made = record(toy, "toy.claim_area")
    assert json.loads(json.dumps(made)) == made
    assert made["verdict"] == "reproduced-under-assumption"
    assert [entry["id"] for entry in made["assumptions"]] == ["width", "shape"]
    assert made["errata"][0]["proof"]["holds"] is True
    assert made["checks"][0]["obtained"] == 0.75
    assert made["checks"][0]["outcome"] == "holds"
    assert made["code"]["function"].endswith("area")
    assert record(toy, "toy.fig01")["pending"] == "not drawn yet"


@pytest.fixture
def cache(tmp_path, monkeypatch):
    monkeypatch.setenv("DUALARM_CACHE", str(tmp_path / "cache"))
    return tmp_path / "cache"


def _mark(toy, item_id, title):
    """Change the title in a kept record, with a hash that fits."""
    path = kept.path_of("records", item_id)
    entry = json.loads(path.read_text())
    entry["value"]["record"]["title"] = title
    entry["sha256"] = kept._hash(entry["value"])
    path.write_text(json.dumps(entry))


def test_kept_record_is_used_and_bypassed(toy, cache, monkeypatch):
    made = record(toy, "toy.claim_count")
    _mark(toy, "toy.claim_count", "from before")
    assert record(toy, "toy.claim_count")["title"] == "from before"
    monkeypatch.setenv("DUALARM_CACHE", "off")
    assert record(toy, "toy.claim_count") == made


@pytest.mark.parametrize(
    "text", ["", "[]", "{}", "null", "{", "\xff", '{"value": 1}', "[" * 10_000]
)
def test_a_damaged_entry_is_a_miss(toy, cache, text):
    made = record(toy, "toy.claim_count")
    kept.path_of("records", "toy.claim_count").write_text(text, encoding="latin-1")
    assert record(toy, "toy.claim_count") == made


def test_a_forged_verdict_is_a_miss(toy, cache):
    record(toy, "toy.claim_area")
    path = kept.path_of("records", "toy.claim_area")
    path.write_text(path.read_text().replace("reproduced-under-assumption", "reproduced"))
    assert record(toy, "toy.claim_area")["verdict"] == "reproduced-under-assumption"


@pytest.mark.parametrize(
    ("old", "new", "stale"),
    [
        ("value: 1.0, unit: m", "value: 1.5, unit: m", {"toy.claim_area"}),
        ("title: The count", "title: A count", {"toy.claim_count"}),
        ('printed: {area: "1.00"}', 'printed: {area: "2.00"}', {"toy.claim_area"}),
        ('slip: {place: "1"', 'slip: {place: "2"', {"toy.claim_area"}),
        ("title: A toy", "title: Another toy", set()),
    ],
)
def test_a_record_depends_on_its_own_part_of_the_document(tmp_path, cache, old, new, stale):
    toy, items = toy_registry(tmp_path), ("toy.claim_area", "toy.claim_count")
    for item_id in items:
        record(toy, item_id)
        _mark(toy, item_id, "from before")
    assert old in YAML
    changed = toy_registry(tmp_path, YAML.replace(old, new))
    fresh = {i for i in items if record(changed, i)["title"] != "from before"}
    assert fresh == stale


def test_a_kept_record_notes_its_inputs_again(toy, cache):
    with recording() as first:
        record(toy, "toy.claim_area")
    with recording() as second:
        record(toy, "toy.claim_area")
    assert first == second
    assert "papers/toy.yaml#assumptions.width.value" in first
