"""The bill of materials is what the locks give, and a changed lock changes it."""

import hashlib
import json
import shutil

import pytest
from installs.rows import project_table
from supply.licences import TABLE
from supply.locks import LOCKS, read_all

BILL = "data/sbom.cdx.json"


@pytest.fixture(scope="module")
def made():
    """The function that writes the bill."""
    pytest.importorskip("cyclonedx", reason="installed by `make env`")
    from supply.bill import bill

    return bill


def test_the_bill_lists_the_locks(root):
    """Told by the files alone, with no library between them."""
    listed = json.loads((root / BILL).read_text(encoding="utf-8"))
    components = {(c["name"], c["version"]) for c in listed["components"]}
    locked = {(one.name, one.version) for lock in read_all(root).values() for one in lock}
    assert components == locked, "run `make supply-chain`"
    hashes = {p["name"]: p["value"] for p in listed["metadata"]["properties"]}
    assert hashes == {
        f"sha256 of {name}": hashlib.sha256((root / name).read_bytes()).hexdigest()
        for name in LOCKS
    }
    assert all(component["licenses"] for component in listed["components"])
    references = {component["bom-ref"] for component in listed["components"]}
    asked = {child for d in listed["dependencies"] for child in d.get("dependsOn", ())}
    assert asked == references, "everything is there because something asks for it"


def test_the_bill_is_current_and_the_same_bytes_twice(root, made):
    table = project_table(root)
    text = made(root, table)
    assert text == made(root, table)
    assert text == (root / BILL).read_text(encoding="utf-8"), "run `make supply-chain`"


def test_a_changed_lock_changes_the_bill(root, made, tmp_path):
    for name in (*LOCKS, TABLE):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        shutil.copy2(root / name, tmp_path / name)
    table = project_table(root)
    before = made(tmp_path, table)
    path = tmp_path / LOCKS[0]
    path.write_text(path.read_text().replace("\ncoal==", "\ncoal==99."), encoding="utf-8")
    after = made(tmp_path, table)
    assert "coal@99." in after
    assert json.loads(before)["serialNumber"] != json.loads(after)["serialNumber"]
