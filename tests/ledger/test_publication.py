"""The export of the whole ledger: complete, deterministic, valid, and without a machine in it."""

import json
import zipfile

import pandas as pd
import pytest
from jsonschema import Draft202012Validator, ValidationError

from dualarm_repro.errors import OutputError
from dualarm_repro.ledger import record
from dualarm_repro.ledger.ledger_table import ledger_table
from dualarm_repro.ledger.project import project
from dualarm_repro.ledger.publication import ZIP, names, publish
from dualarm_repro.ledger.record_schema import ledger_schema, published, record_schema

from .toy import toy_registry


@pytest.fixture
def records(tmp_path):
    (tmp_path / "papers").mkdir()
    toy = toy_registry(tmp_path / "papers")
    return [record(toy, item_id) for item_id in toy.items]


def export(records, folder):
    schemas = {"record": published("record", record_schema())}
    return publish(records, folder, project(), [], schemas), names(schemas)


def test_every_file_is_there_and_in_the_zip(records, tmp_path):
    files, described = export(records, tmp_path / "out")
    found = {str(path.relative_to(tmp_path / "out")) for path in files}
    assert found == set(described)
    with zipfile.ZipFile(tmp_path / "out" / ZIP) as archive:
        assert archive.testzip() is None
        assert set(archive.namelist()) == found - {ZIP}
        for name in archive.namelist():
            assert archive.read(name) == (tmp_path / "out" / name).read_bytes()
    text = "".join(p.read_text() for p in files if p.suffix not in (".zip", ".parquet"))
    assert str(tmp_path) not in text


def test_same_records_same_bytes(records, tmp_path):
    for name in ("a", "b"):
        export(records, tmp_path / name)
    for path in (p for p in (tmp_path / "a").rglob("*") if p.is_file()):
        again = tmp_path / "b" / path.relative_to(tmp_path / "a")
        assert again.read_bytes() == path.read_bytes(), path.name


def test_tables_agree_with_the_records(records, tmp_path):
    export(records, tmp_path)
    assert json.loads((tmp_path / "ledger.json").read_text()) == records
    parquet = pd.read_parquet(tmp_path / "ledger.parquet")
    csv = pd.read_csv(tmp_path / "ledger.csv", dtype="string")
    assert list(parquet["id"]) == list(csv["id"]) == [made["id"] for made in records]
    assert list(parquet["verdict"]) == [made["verdict"] for made in records]
    assert [json.loads(text) for text in csv["obtained"].dropna()] == [
        made["obtained"] for made in records if made["obtained"]
    ]
    shares = [made["robustness"]["holds"] for made in records if made["robustness"]]
    assert list(parquet["holds"].dropna()) == shares


def test_further_fields_and_absent_ones_do_no_harm(records):
    more = [{**made, "new": [1]} for made in records]
    bare = [{key: made[key] for key in made if key != "witnesses"} for made in records]
    assert json.loads(ledger_table(more)["witnesses"][0]) == records[0]["witnesses"]
    assert ledger_table(bare)["witnesses"].isna().all()
    Draft202012Validator(record_schema()).validate(more[0])


@pytest.mark.parametrize(
    ("field", "value"),
    [("verdict", "fine"), ("kind", "photo"), ("checks", None), ("id", "Fig 1"), ("errata", [{}])],
)
def test_schema_refuses(records, field, value):
    validator = Draft202012Validator(published("ledger", ledger_schema()))
    validator.validate(records)
    with pytest.raises(ValidationError):
        validator.validate([{**records[0], field: value}])


def test_unwritable_folder(records, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputError, match="a folder that can be written"):
        export(records, tmp_path / "file" / "out")
