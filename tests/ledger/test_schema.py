"""Malformed paper files are refused with file, field, value and expectation."""

import json

import pytest

from dualarm_repro.errors import DataFileError, LedgerError
from dualarm_repro.ledger import Registry
from dualarm_repro.ledger.schema import json_schema, load_paper

from .toy import YAML


@pytest.mark.parametrize(
    ("old", "new", "field"),
    [
        ("title: The count", "titel: The count", "items.claim_count.titel"),
        ("title: The count, ", "", "items.claim_count.title"),
        ('printed: {n: "3"}', "printed: {n: 3}", "items.claim_count.printed"),
        ('printed: {n: "3"}', "printed: {}", "items.claim_count.printed"),
        ("kind: figure", "kind: picture", "items.fig01.kind"),
        ("assumptions: [width, shape]", "assumptions: [widht]", "no assumption named 'widht'"),
        ("affects: [toy.claim_area]", "affects: [toy.x]", "no item named 'toy.x'"),
        ("needs: count}", "needs: count, context: [widht]}", "no assumption named 'widht'"),
        ("needs: area\n", "needs: area\n    context: [width]\n", "are assumptions already"),
        ("needs: count}", "needs: count, statements: [toy.x]}", "no item named 'toy.x'"),
        ("needs: count}", "needs: count, scope: always}", "items.claim_count.scope"),
        ("needs: count}", "needs: count, thresholds: {a: {value: 1}}}", "thresholds.a.reason"),
        ("needs: count}", "needs: count, search: {starts: 0}}", "search.starts"),
        ("range: [0.0, 4.0]", "range: [2.0, 4.0]", "assumptions.width"),
        ("range: [0.0, 4.0]", "range: [0.0, .nan]", "assumptions.width"),
        ("choices: [round, square]", "choices: [square]", "assumptions.shape"),
        ("items:", "items: [", "well-formed YAML"),
        ("  claim_count: {", "  claim_area: {", "given twice"),
    ],
)
def test_refused(tmp_path, old, new, field):
    assert old in YAML
    path = tmp_path / "toy.yaml"
    path.write_text(YAML.replace(old, new, 1))
    with pytest.raises(DataFileError) as caught:
        load_paper(path)
    message = str(caught.value)
    assert field in message
    assert str(path) in message
    assert "expected" in message
    assert "\n" not in message


@pytest.mark.parametrize(
    ("entry", "field"),
    [
        ("{place: '1', says: s, items: [toy.claim_size]}", "no item named 'toy.claim_size'"),
        ("{place: '1', says: s}", "give either items or unjudged"),
        ("{place: '1', says: s, items: [toy.claim_area], unjudged: u}", "give either"),
        ("{place: '1', items: [toy.claim_area]}", "sentences.0.says"),
    ],
)
def test_a_sentence_names_the_items_that_judge_it_or_says_why_none_can(tmp_path, entry, field):
    path = tmp_path / "toy.yaml"
    path.write_text(f"{YAML}sentences:\n  - {entry}\n")
    with pytest.raises(DataFileError, match=field):
        load_paper(path)


def test_missing_file_and_wrong_name(tmp_path):
    with pytest.raises(DataFileError, match="a readable YAML file"):
        load_paper(tmp_path / "none.yaml")
    (tmp_path / "other.yaml").write_text(YAML)
    with pytest.raises(LedgerError, match=r"other\.yaml: document\.id is 'toy'"):
        _ = Registry(tmp_path).papers


def test_json_schema_accepts_the_paper_files(registry):
    from jsonschema import Draft202012Validator

    from dualarm_repro.datafiles import data_path, read_yaml

    schema = json.loads(json.dumps(json_schema()))
    Draft202012Validator.check_schema(schema)
    for name in registry.papers:
        content = read_yaml(data_path("papers", f"{name}.yaml"))
        assert list(Draft202012Validator(schema).iter_errors(content)) == [], name
