"""Stated numbers, and the tool that is not ours which looks them up."""

import json
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

from dualarm_repro.errors import DataFileError
from dualarm_repro.ledger import reference
from dualarm_repro.ledger.claims import manifest
from dualarm_repro.ledger.headlines import Statement, headlines, rounded, statements
from dualarm_repro.ledger.project import project
from dualarm_repro.ledger.publication import publish

ROOT = Path(__file__).parents[2]
RESULTS = {"toy.claim_area": {"obtained": {"area": 0.756789, "a/b~": [3, True, "text"]}}}


def verify(path):
    """`claims verify` in its own folder: whether it passes, and what it says."""
    command = [sys.executable, "-m", "claims", "verify", "repro.yaml", "--policy", "publication"]
    found = subprocess.run(command, cwd=path, capture_output=True, text=True, check=False)
    return found.returncode == 0, found.stdout + found.stderr


@pytest.fixture
def stated(tmp_path, monkeypatch):
    """Writes one headline and reads what it states."""
    folder = tmp_path / "data"
    monkeypatch.setattr(reference, "data_path", lambda *parts: folder.joinpath(*parts))
    (folder / "results").mkdir(parents=True)
    (folder / "results/toy.json").write_text(json.dumps({"items": RESULTS}))

    def state(line):
        path = tmp_path / "headlines.yaml"
        path.write_text(f"headlines:\n  - {line}\n")
        return statements(path)

    return state


@pytest.mark.parametrize(
    ("value", "digits", "text"),
    [(2.78424, 4, "2.784"), (0.0097, 3, "0.00970"), (-1234.6, 2, "-1200"), (185, 2, "185")],
)
def test_rounded(value, digits, text):
    assert rounded(value, digits) == text


def test_statements(stated):
    (one,) = stated("{text: t, item: toy.claim_area, path: [area], digits: 2}")
    assert (one.reported, one.pointer) == ("0.76", "/area")
    (one,) = stated("{text: t, item: toy.claim_area, path: [a/b~, 0]}")
    assert (one.reported, one.pointer) == ("3", "/a~1b~0/0")


@pytest.mark.parametrize(
    "path", ["[volume]", "[area, 0]", "[a/b~, 1]", "[a/b~, 2]", "[a/b~, 9]", "[a/b~]"]
)
def test_what_is_no_number_is_refused(stated, path):
    with pytest.raises(DataFileError, match=r"headlines\.0 = 'toy\.claim_area"):
        stated(f"{{text: t, item: toy.claim_area, path: {path}}}")


@pytest.mark.parametrize(("path", "fits"), [("[d, 3]", True), ("[reach, matrices]", False)])
def test_printed_digits_must_be_printed(tmp_path, path, fits):
    file = tmp_path / "headlines.yaml"
    line = f"{{text: t, item: xue.tab01, path: {path}, printed: true}}"
    file.write_text(f"headlines:\n  - {line}\n")
    if fits:
        assert statements(file)[0].reported == "1.225"
    else:
        with pytest.raises(DataFileError, match="printed under the same path"):
            statements(file)


@pytest.mark.parametrize(("reported", "passes"), [("2.784", True), ("2.785", False)])
def test_the_tool_finds_a_wrong_number(tmp_path, reported, passes):
    records = [{"id": "toy.other"}, {"id": "toy.fig", "obtained": {"reach": [1, 2.78424]}}]
    one = Statement("reach", "toy.fig", ("reach", 1), reported)
    publish(records, tmp_path, project(), [], {}, [one])
    assert verify(tmp_path)[0] is passes


def test_the_tool_finds_an_edited_file_and_a_lost_place(tmp_path):
    records = [{"id": "toy.fig", "obtained": {"reach": 2.0}}]
    one = Statement("reach", "toy.fig", ("reach",), "2.0")
    publish(records, tmp_path, project(), [], {}, [one])
    ledger = tmp_path / "ledger.json"
    ledger.write_text(ledger.read_text() + "\n")
    assert not verify(tmp_path)[0]
    publish(records, tmp_path, project(), [], {}, [Statement("r", "toy.fig", ("gone",), "2.0")])
    assert not verify(tmp_path)[0]


def test_numbers_of_the_book(tmp_path):
    """What the root states is what `claims` finds in data/results, for every document."""
    shutil.copytree(ROOT / "data/results", tmp_path / "data/results")
    shutil.copy(ROOT / "repro.yaml", tmp_path)
    passes, said = verify(tmp_path)
    assert passes, said
    content = yaml.safe_load((ROOT / "repro.yaml").read_text(encoding="utf-8"))
    papers = [claim["evidence"][0]["artifact"] for claim in content["claims"]]
    assert {name: papers.count(name) >= 5 for name in papers} == dict.fromkeys(
        ("xue", "qiu", "patent", "pan"), True
    )
    assert f"{len(headlines())} verified" in said


def test_manifest_is_plain_yaml():
    one = Statement("t: [m]", "toy.fig", ("a",), "0.50")
    text = manifest([one], {"f": ("f.json", "0" * 64)}, lambda item: ("f", "/x"))
    (claim,) = yaml.safe_load(text)["claims"]
    assert claim["evidence"][0]["reported"] == "0.50"
    assert claim["evidence"][0]["pointer"] == "/x/a"
