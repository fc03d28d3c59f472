"""Every checker of every document: verdicts that can change, proofs that hold, no drift."""

import json
import subprocess
import sys

import numpy as np
import pytest
from evaluated_items import ATTEMPTED, READ, REGISTRY, evaluated, is_dear, proved, tried
from long_tests import long_where

from dualarm_repro.ledger import Verdict, record, reference
from dualarm_repro.ledger.files import to_json
from dualarm_repro.ledger.mutation import insensitive
from dualarm_repro.ledger.printed import leaves, replaced
from dualarm_repro.ledger.reference import read_reference
from dualarm_repro.ledger.robustness import study_of


@pytest.mark.parametrize("item_id", tried(ATTEMPTED))
def test_no_data_file_is_opened_unseen(item_id):
    evaluated(item_id)
    # The documents are read whole, and noted by the parts that are used.
    assert {name for name in READ[item_id] if not name.startswith("papers/")} == set()


@pytest.mark.parametrize("item_id", tried(ATTEMPTED))
def test_checker(item_id):
    evaluation = evaluated(item_id)
    assert evaluation.verdict is not Verdict.NOT_ATTEMPTED
    assert insensitive(evaluation) == []
    assert evaluation.result.told().strip()
    json.loads(to_json(evaluation.result.obtained))


@pytest.mark.parametrize("erratum_id", sorted(REGISTRY.proofs))
def test_proof_holds(erratum_id):
    proof = proved(erratum_id)
    assert proof.holds
    assert proof.values
    json.loads(to_json(proof.values))


@pytest.mark.parametrize("dear", long_where(bool, [False, True]), ids=["soon", "dear"])
@pytest.mark.parametrize("paper", sorted(REGISTRY.papers))
def test_nothing_drifted(paper, dear, monkeypatch):
    # What the tests above computed: it is of this code, and none of another process.
    monkeypatch.setattr(reference, "evaluate", lambda registry, item_id: evaluated(item_id))
    monkeypatch.setattr(reference, "prove", lambda registry, erratum_id: proved(erratum_id))
    stored = read_reference(paper)
    ids = [item_id for item_id in REGISTRY.items if item_id.startswith(f"{paper}.")]
    assert sorted(stored) == sorted(ids)
    report = reference.verify(REGISTRY, [one for one in ids if is_dear(one) == dear])
    assert report["drifted"] == []


@pytest.mark.parametrize("item_id", ATTEMPTED)
def test_verdict_says_what_it_must(item_id):
    """Possible shows its witness; not found its search; undecidable a witness for each side."""
    made = record(REGISTRY, item_id)
    item, verdict = REGISTRY.look(item_id), made["verdict"]
    if made["decided_by"]:
        assert made["decided_by"] in item.statements
        return
    if verdict == Verdict.UNDER_ASSUMPTION:
        assert item.assumptions
        assert made["witnesses"]
    if verdict == Verdict.REPRODUCED:
        assert not item.assumptions
    if verdict == Verdict.UNDECIDABLE:
        sides = {w["verdict"] in ("holds", Verdict.UNDER_ASSUMPTION) for w in made["witnesses"]}
        assert sides == {True, False}
    if verdict == Verdict.NOT_REPRODUCED and item.assumptions:
        assert (made["search"] or {}).get("directed") or item.seek
    assert made["draws"] in ("none", "up to date")


RESTING = [i for i in ATTEMPTED if REGISTRY.look(i).assumptions]


@pytest.mark.parametrize("item_id", RESTING)
def test_every_assumption_moves_a_judged_value(item_id):
    table = study_of(REGISTRY, item_id).load()
    changes = table[table["kind"] == "change"]
    assert sorted(changes["assumption"]) == sorted(REGISTRY.look(item_id).assumptions)
    idle = changes[changes["moves"] == "nothing"]["assumption"].tolist()
    assert idle == [], "these can move nothing that is judged: they are context"


@pytest.mark.parametrize("item_id", RESTING)
def test_every_choice_can_be_computed(item_id):
    table = study_of(REGISTRY, item_id).load()
    assert table["error"].dropna().unique().tolist() == []


@pytest.mark.parametrize("item_id", ATTEMPTED)
def test_perturbed_reference_is_found(item_id):
    """Another verdict, and other obtained values, are drift."""
    stored = read_reference(item_id.partition(".")[0])[item_id]
    assert reference.differences(stored, {**stored, "verdict": "other"})
    numbers = [
        path
        for path, leaf in leaves(stored["obtained"])
        if isinstance(leaf, int | float) and not isinstance(leaf, bool) and abs(leaf) > 1e-3
    ]
    for path in numbers[:5]:
        changed = replaced(stored["obtained"], path, 1.00001 * float(np.array(_at(stored, path))))
        assert reference.differences(stored["obtained"], changed)


def _at(stored, path):
    value = stored["obtained"]
    for part in path:
        value = value[part]
    return value


FIGURES = [item_id for item_id in ATTEMPTED if REGISTRY.item(item_id).kind == "figure"]


@pytest.mark.parametrize("item_id", tried(FIGURES))
def test_figure(item_id):
    """There is one, and words for who cannot see it; it is drawn and read in `test_figures_fit`."""
    result = evaluated(item_id).result
    assert result.figure is not None or result.scene is not None
    assert result.figure is None or len(result.alt) > 30


def test_a_worker_that_has_read_nothing_knows_the_assumptions():
    """Studies run in processes that import one module and call one function."""
    code = (
        "from dualarm_repro.papers.pan.studies.sensitivity import cells\n"
        "from dualarm_repro.papers.qiu.reading import Improved\n"
        "from dualarm_repro.papers.xue.reading import nominal\n"
        "assert nominal() and cells() and Improved.nominal()"
    )
    subprocess.run([sys.executable, "-c", code], check=True, timeout=300)
