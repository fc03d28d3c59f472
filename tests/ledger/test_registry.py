"""The registry: what it reads, what a computation that asks it then depends on, and its errors."""

import pytest

from dualarm_repro.errors import LedgerError, UnknownNameError
from dualarm_repro.ledger import Proof, Registry, evaluate
from dualarm_repro.ledger.evaluation import assumed_values, prove
from dualarm_repro.tracking import recording

from .toy import YAML, toy_registry


@pytest.fixture
def toy(tmp_path):
    return toy_registry(tmp_path)


def second(folder, name="other", order=-1):
    text = f"""
document: {{id: {name}, order: {order}, type: misc, title: Another}}
items:
  fig01: {{kind: figure, place: "1", title: A figure, needs: nothing, pending: not drawn}}
"""
    (folder / f"{name}.yaml").write_text(text)


def test_documents_come_in_their_order_and_items_with_them(toy, tmp_path):
    second(tmp_path)
    fresh = Registry(tmp_path)
    assert fresh.documents == ("other", "toy")
    assert list(fresh.items) == [
        "other.fig01", "toy.claim_area", "toy.claim_count", "toy.fig01"
    ]  # fmt: skip
    assert list(fresh.errata) == ["toy.slip", "toy.word"]


def test_a_question_about_one_item_reads_its_document_alone(tmp_path):
    toy_registry(tmp_path)
    (tmp_path / "broken.yaml").write_text("document: [")
    assert Registry(tmp_path).item("toy.fig01").title == "A sketch"
    with pytest.raises(Exception, match="well-formed YAML"):
        _ = Registry(tmp_path).papers


@pytest.mark.parametrize(
    ("ask", "inputs"),
    [
        (lambda r: r.printed("toy.claim_area"), {"items.claim_area.printed"}),
        (lambda r: r.item("toy.claim_area"), {"items.claim_area"}),
        (lambda r: r.look("toy.claim_area", "title", "place"),
         {"items.claim_area.title", "items.claim_area.place"}),
        (lambda r: r.look("toy.claim_area"), set()),
        (lambda r: r.assumption("toy.width"), {"assumptions.width.value"}),
        (lambda r: r.declared("toy.shape", "choices"), {"assumptions.shape.choices"}),
        (lambda r: r.nominal("toy"), {"assumptions.width.value", "assumptions.shape.value"}),
        (lambda r: r.part("papers/toy.yaml#items.claim_area.printed"), set()),
        (lambda r: r.errata_of("toy.claim_area"), set()),
    ],
)  # fmt: skip
def test_what_is_read_is_noted_part_by_part(toy, ask, inputs):
    with recording() as noted:
        ask(toy)
    assert noted == {f"papers/toy.yaml#{part}" for part in inputs}


def test_a_whole_document_is_noted_whole(toy):
    with recording() as noted:
        assert toy.paper("toy").document.title == "A toy"
    assert noted == {"papers/toy.yaml"}


def test_parts_are_found_by_the_names_they_are_noted_under(toy):
    assert toy.part("papers/toy.yaml#items.claim_area.printed") == {"area": "1.00"}
    assert toy.part("papers/toy.yaml#assumptions.width.range") == [0.0, 4.0]
    assert toy.part("papers/toy.yaml#items.nothing.printed") is None
    assert toy.part("papers/toy.yaml")["document"]["id"] == "toy"


@pytest.mark.parametrize(
    ("ask", "line"),
    [
        (
            lambda r: r.item("toy.claim_aera"),
            r"ledger: item id = 'toy\.claim_aera'.*toy\.claim_area",
        ),
        (lambda r: r.item("nowhere.fig01"), r"such as toy\.fig01"),
        (lambda r: r.item("../toy.fig01"), "item id"),
        (lambda r: r.item(""), "item id such as"),
        (
            lambda r: r.assumption("toy.height"),
            r"assumption = 'toy\.height': expected one of width",
        ),
        (lambda r: r.paper("none"), "ledger: document = 'none': expected one of toy"),
    ],
)
def test_unknown_names_are_answered_with_known_ones(toy, ask, line):
    with pytest.raises(UnknownNameError, match=line):
        ask(toy)


def test_errata_belong_to_the_items_they_affect(toy):
    assert list(toy.errata_of("toy.claim_area")) == ["toy.slip"]
    assert toy.errata_of("toy.claim_count") == {}


def test_proofs_are_run_or_absent_and_registered_once(toy):
    found = prove(toy, "toy.slip")
    assert (found.holds, found.values) == (True, {"one": 1})
    assert prove(toy, "toy.word") is None
    with pytest.raises(LedgerError, match=r"toy\.slip: a second proof"):
        toy.proves("toy.slip")(lambda: Proof("again", True))


def test_assumed_values_are_nominal_but_for_the_changes_and_tell_what_was_read(toy):
    assumed = assumed_values(toy, "toy.claim_area", {"width": 3.0})
    assert dict(assumed) == {"width": 3.0, "shape": "round"}
    assumed = assumed_values(toy, "toy.claim_area")
    assert assumed.read == set()
    assert "width" in assumed
    assert assumed["width"] == 1.0
    assert assumed.read == {"width"}
    with pytest.raises(KeyError):
        assumed["height"]


def test_an_evaluation_depends_on_what_judges_it(toy):
    with recording() as noted:
        evaluation = evaluate(toy, "toy.claim_area")
    fields = {name.partition("#")[2] for name in noted}
    assert {"items.claim_area.printed", "items.claim_area.assumptions"} <= fields
    assert {"assumptions.width.value", "assumptions.shape.value"} <= fields
    assert evaluation.inputs == frozenset()
    (check,) = evaluation.checks()
    assert check == {
        "label": "area below two",
        "role": "supports",
        "expected": "at most 2",
        "obtained": 0.75,
        "holds": True,
        "outcome": "holds",
    }


def test_what_is_not_attempted_has_no_evidence_and_no_check(toy):
    evaluation = evaluate(toy, "toy.fig01")
    assert evaluation.checks() == []
    assert evaluation.rules == ()
    with pytest.raises(LedgerError, match=r"toy\.fig01: nothing obtained, not drawn yet"):
        _ = evaluation.evidence


def test_another_print_is_seen_by_the_item_and_gone_afterwards(toy):
    with toy.with_printed("toy.claim_count", {"n": "4"}):
        assert toy.printed("toy.claim_count") == {"n": "4"}
        assert toy.printed("toy.claim_area") == {"area": "1.00"}
        assert str(evaluate(toy, "toy.claim_count").verdict) == "not-reproduced"
    assert toy.printed("toy.claim_count") == {"n": "3"}
    with pytest.raises(RuntimeError), toy.with_printed("toy.claim_count", {"n": "4"}):
        raise RuntimeError
    assert toy.printed("toy.claim_count") == {"n": "3"}


def test_a_document_without_a_room_is_named(tmp_path):
    (tmp_path / "toy.yaml").write_text(YAML)
    registry = Registry(tmp_path, rooms="dualarm_repro.papers")
    with pytest.raises(LedgerError, match=r"toy: a document without a room in dualarm_repro"):
        registry.checker("toy.claim_area")
