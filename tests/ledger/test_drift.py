"""What counts as drift: digits, the bound of a residual, a declared tolerance."""

import json

import pytest

from dualarm_repro.errors import DataFileError
from dualarm_repro.ledger import Bounded, Residual, Result, reference
from dualarm_repro.ledger.comparison import Comparison, comparisons, idle
from dualarm_repro.ledger.drift import differences
from dualarm_repro.ledger.reference import declared, read_reference
from dualarm_repro.ledger.rules import Evidence
from dualarm_repro.ledger.schema import load_paper

from .toy import YAML, toy_registry

RESIDUAL = Residual(key="error", label="error", high=1e-9)
TOLERANCE = Comparison("rows.*.slope", "measured spread 1e-5", relative=1e-4)


def _made(**obtained):
    return {"verdict": "reproduced", "obtained": obtained, "proofs": {"p": True}}


@pytest.mark.parametrize(
    ("a", "b", "same"),
    [
        (1.0, 1.0 + 5e-7, True),
        (1.0, 1.0 + 2e-6, False),
        (0.0, 5e-10, True),
        (0.0, 5e-9, False),
        (7, 7, True),
        (7, 8, False),
        (7, 7.0000001, True),
        (True, 1, False),
        (True, True, True),
        (None, 0.0, False),
        ("left", "right", False),
    ],
)
def test_digits(a, b, same):
    assert (differences(_made(x=a), _made(x=b)) == []) is same


@pytest.mark.parametrize(
    ("a", "b", "same"),
    [
        (1e-17, 8e-10, True),
        (-8e-10, 8e-10, True),
        (8e-10, 3e-9, False),  # one on the other side of the bound
        (3e-6, 4e-6, False),  # a residual that fails is a finding, and keeps its digits
        (3e-6, 3e-6 + 1e-13, True),
        (None, 1e-12, False),
    ],
)
def test_a_residual_is_compared_with_its_bound(a, b, same):
    ways = [Comparison("error", "label", bound=RESIDUAL.high)]
    assert (differences(_made(error=a), _made(error=b), ways) == []) is same


def test_only_the_declared_value_is_compared_so():
    ways = [Comparison("error", "label", bound=1e-3)]
    lines = differences(_made(error=1e-4, other=1e-4), _made(error=2e-4, other=2e-4), ways)
    assert lines == ["obtained.other: reference 0.0001, found 0.0002"]
    lines = differences(_made(error=1e-4), _made(error=2e-3), ways)
    assert lines == [
        "obtained.error: reference 0.0001, found 0.002; "
        "compared with the bound 0.001, not by digits (label)"
    ]


def test_a_tolerance_covers_its_paths():
    rows = [{"slope": 2.0, "count": 3}, {"slope": 4.0, "count": 5}]
    near = [{"slope": 2.0001, "count": 3}, {"slope": 4.0, "count": 5}]
    far = [{"slope": 2.0003, "count": 3}, {"slope": 4.0, "count": 6}]
    assert differences(_made(rows=rows), _made(rows=near), [TOLERANCE]) == []
    assert len(differences(_made(rows=rows), _made(rows=near))) == 1
    assert len(differences(_made(rows=rows), _made(rows=far), [TOLERANCE])) == 2
    assert TOLERANCE.covers(("rows", 0, "slope"))
    assert TOLERANCE.covers(("rows", 0, "slope", 1))
    assert not TOLERANCE.covers(("rows", 0))
    assert not TOLERANCE.covers(("rows", 0, "count"))
    assert idle([TOLERANCE], {"rows": rows}) == []
    assert idle([TOLERANCE, Comparison("row", "r", relative=0.1)], {"rows": rows}) == ["row"]


def test_verdict_and_proofs_are_never_tolerated():
    ways = [Comparison("*", "r", relative=0.1)]
    changed = {**_made(x=1.0), "verdict": "undecidable", "proofs": {"p": False}}
    assert len(differences(_made(x=1.0), changed, ways)) == 2


def test_residual_rule():
    for value, holds in ((0.0, True), (-1e-9, True), (2e-9, False), (-2e-9, False), (None, False)):
        evidence = Evidence({"error": value}, None)
        assert RESIDUAL.holds(evidence) is holds
        assert RESIDUAL.holds(RESIDUAL.flipped(evidence)) is not holds
    assert not RESIDUAL.holds(Evidence({"error": float("nan")}, None))
    for bad in ({"high": 0.0}, {"low": 0.0}, {"low": 0.0, "high": 1.0}, {"high": float("inf")}, {}):
        with pytest.raises(ValueError, match="positive bound"):
            Residual(key="error", label="error", **bad)


TOLERANT = YAML.replace(
    "needs: area\n",
    "needs: area\n    tolerances: {area: {relative: 1.0e-3, reason: spread 1e-5}}\n",
)


@pytest.mark.parametrize(
    ("old", "new", "field"),
    [
        ("reason: spread 1e-5", 'reason: ""', "reason"),
        (", reason: spread 1e-5", "", "reason"),
        ("relative: 1.0e-3, ", "", "either relative or absolute"),
        ("relative: 1.0e-3", "relative: 1.0e-3, absolute: 1.0", "either relative or absolute"),
        ("relative: 1.0e-3", "relative: 0.5", "relative"),
    ],
)
def test_a_tolerance_needs_a_size_and_a_reason(tmp_path, old, new, field):
    path = tmp_path / "toy.yaml"
    path.write_text(TOLERANT.replace(old, new, 1))
    with pytest.raises(DataFileError, match=field):
        load_paper(path)


@pytest.mark.parametrize("text", [YAML, TOLERANT])
def test_verify_honours_and_names_the_tolerance(tmp_path, monkeypatch, text):
    monkeypatch.setattr(reference, "data_path", lambda *parts: tmp_path.joinpath("data", *parts))
    toy = toy_registry(tmp_path, text)
    reference.verify(toy, toy.items, update=True)
    path = tmp_path / "data/results/toy.json"
    content = json.loads(path.read_text())
    content["items"]["toy.claim_area"]["obtained"]["area"] *= 1 + 1e-4
    path.write_text(json.dumps(content))
    report = reference.verify(toy, toy.items)
    tolerant = text is TOLERANT
    assert bool(report["drifted"]) is not tolerant
    how = {"id": "toy.claim_area", "path": "area", "how": "within 0.001 relative (spread 1e-5)"}
    assert report["compared"] == ([how] if tolerant else [])


def test_verify_compares_a_residual_with_its_bound(tmp_path, monkeypatch):
    monkeypatch.setattr(reference, "data_path", lambda *parts: tmp_path.joinpath("data", *parts))
    toy = toy_registry(tmp_path)
    values = {"error": 3e-10}
    del toy.checkers["toy.claim_count"]
    toy.checks("toy.claim_count", [RESIDUAL], page="toy/page")(
        lambda assumed: Result(dict(values), caption="c")
    )
    reference.verify(toy, toy.items, update=True)
    for value, drifted in ((9e-10, 0), (-9e-10, 0), (4e-9, 1)):
        values["error"] = value
        report = reference.verify(toy, toy.items)
        assert len(report["drifted"]) == drifted
        assert [entry["path"] for entry in report["compared"]] == ["error"]


def test_what_is_declared_exists(registry):
    for item_id, item in registry.items.items():
        obtained = read_reference(item_id.partition(".")[0])[item_id]["obtained"]
        ways = declared(registry, item_id)
        assert idle(ways, obtained) == [], item_id
        paths = [way.path for way in ways]
        assert len(paths) == len(set(paths)), f"{item_id} declares a value twice"
        assert comparisons(item, ()) == ways[len(ways) - len(item.tolerances) :]


def test_a_bounded_value_keeps_its_digits(registry):
    rules = [Bounded(key="error", label="error", high=1.0)]
    assert comparisons(registry.item("xue.eq01"), rules) == []
