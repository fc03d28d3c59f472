"""The gate finds every gap, on the toy document and on the real ones."""

import pytest

from dualarm_repro.datafiles import data_path
from dualarm_repro.errors import DataFileError
from dualarm_repro.ledger import Registry
from dualarm_repro.ledger.completeness import gaps, read_inventory

from .toy import INVENTORY, YAML, toy_registry


def test_complete(tmp_path):
    assert gaps(toy_registry(tmp_path), INVENTORY) == []


@pytest.mark.parametrize(
    ("old", "new", "gap"),
    [
        ("  fig01: {", "  fig02: {", "toy.fig01: in the inventory"),
        ("  fig01: {", "  fig02: {", "toy.fig02: in data/papers"),
        (", pending: not drawn yet", "", "toy.fig01: neither"),
        ("needs: count}", "needs: count, pending: later}", "toy.claim_count: has a checker"),
        (", no_proof: wording only", "", "toy.word: needs either"),
        ("affects: [toy.claim_area]", "no_proof: none", "toy.slip: needs either"),
        ("kind: figure", "kind: table", "toy.fig01: kind is table"),
    ],
)
def test_gap(tmp_path, old, new, gap):
    assert old in YAML
    found = gaps(toy_registry(tmp_path, YAML.replace(old, new)), INVENTORY)
    assert any(line.startswith(gap) for line in found), found


def test_a_claim_that_no_sentence_names(tmp_path):
    sentences = "sentences:\n  - {place: '1', says: s, items: [toy.claim_area]}\n"
    toy = toy_registry(tmp_path, YAML + sentences)
    assert gaps(toy, INVENTORY) == ["toy.claim_count: no entry of sentences names it"]


def test_checker_and_proof_of_nothing(tmp_path):
    toy = toy_registry(tmp_path)
    toy.checkers["toy.ghost"] = toy.checkers["toy.claim_count"]
    toy.proofs["toy.ghost"] = toy.proofs["toy.slip"]
    found = gaps(toy, INVENTORY)
    assert found == ["toy.ghost: a checker for no item", "toy.ghost: a proof for no erratum"]


def test_real_ledger_is_complete(registry):
    assert gaps(registry, read_inventory()) == []


def test_deleted_item_is_missed(registry, tmp_path):
    text = data_path("papers", "xue.yaml").read_text(encoding="utf-8")
    start = text.index("  claim_mirror:\n")
    end = text.index("  claim_mc_points:\n", start)
    (tmp_path / "xue.yaml").write_text(text[:start] + text[end:], encoding="utf-8")
    cut = Registry(tmp_path)
    cut.checkers.update(registry.checkers)
    assert "xue.claim_mirror: in the inventory, not in data/papers" in gaps(cut, read_inventory())


def test_missing_inventory(tmp_path):
    with pytest.raises(DataFileError, match="a CSV with columns id and kind"):
        read_inventory(tmp_path / "inventory.csv")
