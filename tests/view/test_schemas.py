"""Published schemas accept every file of the project, and refuse what the loaders refuse."""

import json
import re

import pytest
from jsonschema import Draft202012Validator

from dualarm_repro.datafiles import data_path, read_yaml
from dualarm_repro.ledger import record
from dualarm_repro.ledger.publication import names
from dualarm_repro.view.data_page import FOLDER, data_page
from dualarm_repro.view.schemas import schemas


def kind(path):
    """Name of the schema a data file follows."""
    if path.parent.name == "scenes":
        content = read_yaml(path)
        return "scenario" if "kind" in content else "task" if "scene" in content else "scene"
    return path.parent.name.removesuffix("s")


FILES = [
    path
    for folder in ("papers", "robots", "scenes")
    for path in sorted(data_path(folder).glob("*.yaml"))
]


def test_schemas_are_schemas_and_name_no_host():
    for name, schema in schemas().items():
        Draft202012Validator.check_schema(schema)
        assert schema["$id"] == f"urn:dualarm-repro:schema:{name}:1"
        rest = json.dumps({k: v for k, v in schema.items() if k != "$schema"})
        assert "://" not in rest


@pytest.mark.parametrize("path", FILES, ids=lambda path: f"{path.parent.name}/{path.stem}")
def test_schema_accepts_a_file_and_refuses_a_misspelt_field(path):
    validator = Draft202012Validator(schemas()[kind(path)])
    content = json.loads(json.dumps(read_yaml(path)))
    validator.validate(content)
    assert not validator.is_valid({**content, "misspelt": 1})


def test_every_record_fits_its_schema(registry):
    validator = Draft202012Validator(schemas()["record"])
    for item_id in registry.items:
        assert list(validator.iter_errors(record(registry, item_id))) == [], item_id


def test_the_page_links_every_file():
    links = re.findall(rf'href="{FOLDER}/([^"]+)"', data_page().html)
    assert sorted(links) == sorted(names(schemas()))
    assert links[0] == "ledger.zip"
