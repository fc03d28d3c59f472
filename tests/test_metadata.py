"""What archives read of the project comes from one source, agrees, and is valid."""

import importlib.util
import json
import shutil
import sys
import tomllib
from pathlib import Path

import pytest
import yaml

from dualarm_repro.ledger.cite import bibtex, cite, csl
from dualarm_repro.ledger.crate import NAME, Part, crate
from dualarm_repro.ledger.project import YEAR, from_table
from dualarm_repro.ledger.project import project as installed

ROOT = Path(__file__).parents[1]
NEEDS = "needs what `make env` installs for checks of archives"


def tool(name):
    """A script of tools/ as a module."""
    spec = importlib.util.spec_from_file_location(name, ROOT / "tools" / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


metadata, check_archive = tool("metadata"), tool("check_archive")


@pytest.mark.parametrize(
    "name", ["CITATION.cff", "codemeta.json", ".zenodo.json", NAME, "repro.yaml"]
)
def test_committed_files_are_what_is_generated(name):
    text = (ROOT / name).read_text(encoding="utf-8")
    assert text == metadata.written()[name], f"{name}: run `make metadata`"


def test_files_agree():
    def read(name):
        return json.loads((ROOT / name).read_text(encoding="utf-8"))

    cff = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    codemeta, zenodo, graph = read("codemeta.json"), read(".zenodo.json"), read(NAME)["@graph"]
    root = next(entity for entity in graph if entity["@id"] == "./")
    assert cff["title"] == codemeta["name"] == zenodo["title"] == root["name"]
    assert cff["version"] == codemeta["version"] == zenodo["version"] == root["version"]
    assert cff["keywords"] == codemeta["keywords"] == zenodo["keywords"] == root["keywords"]
    assert cff["abstract"] == codemeta["description"] == zenodo["description"]
    authors = [author["name"] for author in cff["authors"]]
    assert authors == [a["name"] for a in codemeta["author"]]
    assert authors == [a["name"] for a in zenodo["creators"]]
    titles = [reference["title"] for reference in cff["references"]]
    assert titles == [reference["name"] for reference in codemeta["citation"]]
    assert all(t in line for t, line in zip(titles, zenodo["references"], strict=True))
    assert zenodo["license"] == cff["license"][0].lower()
    names = [f"https://spdx.org/licenses/{name}" for name in cff["license"]]
    assert names == codemeta["license"] == [entity["@id"] for entity in root["license"]]
    assert "doi" not in cff
    assert "identifier" not in zenodo


def test_the_installed_package_says_the_same():
    table = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert from_table(table) == installed()
    config = yaml.safe_load((ROOT / "_config.yml").read_text(encoding="utf-8"))
    assert (config["copyright"], config["author"]) == (YEAR, table["authors"][0]["name"])


def test_original_titles_are_everywhere(registry):
    texts = [(ROOT / name).read_text(encoding="utf-8") for name in (".zenodo.json", NAME)]
    texts += [(ROOT / name).read_text(encoding="utf-8") for name in ("codemeta.json",)]
    for paper in registry.papers.values():
        original = paper.document.title_original
        assert original is None or all(original in text for text in texts)


def test_the_crate_is_read_back_complete():
    assert check_archive.wrong_crate(ROOT) == []
    described = set(metadata.parts())
    for folder in ("papers", "robots", "scenes", "results", "results/robustness"):
        for path in (ROOT / "data" / folder).iterdir():
            assert path.is_dir() or str(path.relative_to(ROOT)) in described
    assert all(ROOT.joinpath(name).is_file() for name in described)


def test_a_crate_with_a_gap_is_found(tmp_path):
    text = crate(installed(), [], {"a.csv": Part("a table"), "b.csv": Part("")})
    (tmp_path / NAME).write_text(text)
    (tmp_path / "b.csv").write_text("x")
    lines = check_archive.wrong_crate(tmp_path)
    assert any("names a.csv, which is not there" in line for line in lines)
    assert any("b.csv has no description" in line for line in lines)
    (tmp_path / NAME).write_text(text.replace('"@id": "#the-', '"@id": "#a-', 1))
    assert any("refers to #a-" in line for line in check_archive.wrong_crate(tmp_path))
    (tmp_path / NAME).write_text("{}")
    assert "no RO-Crate" in check_archive.wrong_crate(tmp_path)[0]


def test_cffconvert_accepts_the_citation_file(tmp_path):
    pytest.importorskip("cffconvert", reason=NEEDS)
    assert check_archive.wrong_cff(ROOT / "CITATION.cff") == []
    broken = tmp_path / "CITATION.cff"
    text = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    for old, new in (("version: 0", "doi: x\nversion: 0"), ("type: software", "type: thing")):
        assert old in text
        broken.write_text(text.replace(old, new, 1))
        assert len(check_archive.wrong_cff(broken)) == 1


def test_what_cffconvert_makes_of_it_agrees_with_the_other_files():
    cffconvert = pytest.importorskip("cffconvert", reason=NEEDS)
    citation = cffconvert.Citation((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    converted = {".zenodo.json": citation.as_zenodo(), "codemeta.json": citation.as_codemeta()}
    for name, text in converted.items():
        ours, theirs = json.loads((ROOT / name).read_text(encoding="utf-8")), json.loads(text)
        for field in theirs.keys() - {"license", "author"}:  # it knows one licence, and no group
            assert ours[field] == theirs[field], f"{name}: {field}"


def test_the_official_schema_accepts_every_citation(registry):
    if importlib.util.find_spec("commonmeta") is None:
        pytest.skip(NEEDS)
    found = [csl(paper.document) for paper in registry.papers.values()]
    for item_id in registry.items:
        found += cite(registry, item_id, "csl-json", "reproduced")
    assert check_archive.wrong_csl(found) == []
    assert len(check_archive.wrong_csl([{**found[0], "type": "thing"}])) == 1
    assert len(check_archive.wrong_csl([{**found[0], "authors": "X"}])) == 1


def test_pybtex_parses_every_citation(registry):
    for item_id in registry.items:
        assert check_archive.wrong_bibtex(cite(registry, item_id, "bibtex", "reproduced")) == []
    text = bibtex(registry.papers["xue"].document)
    assert len(check_archive.wrong_bibtex(text.rstrip().rstrip("}"))) == 1
    assert check_archive.wrong_bibtex("no entry at all") == ["BibTeX: no entry"]


def test_the_command_counts_violations(tmp_path, monkeypatch, capsys):
    for name in ("CITATION.cff", NAME):
        shutil.copy(ROOT / name, tmp_path)
    monkeypatch.setattr(sys, "argv", ["check_archive.py", str(tmp_path)])
    assert check_archive.main() == 1  # the crate names files that were not copied
    assert "which is not there" in capsys.readouterr().err
