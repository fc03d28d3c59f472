"""The command line as a newcomer uses it, wrong arguments included."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from dualarm_repro import cli
from dualarm_repro.papers import load

ROOT = Path(cli.__file__).parents[2]
XUE_PART_1 = [
    *(f"xue.{name}" for name in ("fig01", "fig02", "fig03", "fig05", "fig06", "tab01")),
    *(f"xue.eq{k:02d}" for k in range(1, 9)),
    *(f"xue.claim_{c}" for c in ("spherical_wrist", "mirror", "mc_points", "overlap")),
]


@pytest.fixture(scope="module")
def records():
    """`dualarm list --json` in a process of its own."""
    command = [sys.executable, "-m", "dualarm_repro.cli", "list", "--json"]
    found = subprocess.run(command, capture_output=True, text=True, check=True)
    return json.loads(found.stdout)


def test_list_has_every_item(records):
    assert [made["id"] for made in records] == list(load().items)
    contract = {"id", "paper", "kind", "title", "printed", "obtained", "verdict", "assumptions"}
    contract |= {"errata", "witnesses", "robustness", "code", "page", "url"}
    assert all(contract <= made.keys() for made in records)


def test_code_leads_to_the_lines_that_decide(records):
    for made in records:
        for place in (made["code"], made["code"]["figure"]):
            if place is None:
                continue
            lines = (ROOT / place["file"]).read_text(encoding="utf-8").splitlines()
            outer = place["function"].partition(".<locals>")[0]
            names = {outer, place["function"].rpartition(".")[2]}
            line = lines[place["line"] - 1].lstrip()
            assert any(line.startswith(f"def {name}(") for name in names), place


def test_xue_part_1_is_attempted(records):
    verdicts = {made["id"]: made["verdict"] for made in records}
    assert [i for i in XUE_PART_1 if verdicts[i] == "not-attempted"] == []


def test_list_filters(dualarm):
    code, out, _ = dualarm("list", "--paper", "patent", "--kind", "figure", "--json")
    assert code == 0
    ids = [made["id"] for made in json.loads(out)]
    assert ids == ["patent.fig01", "patent.fig02", "patent.fig03"]


def test_show(dualarm):
    code, out, _ = dualarm("show", "xue.tab01", "--json")
    made = json.loads(out)
    assert code == 0
    assert made["verdict"] == "inconsistent-in-print"
    proofs = {entry["id"]: entry["proof"] for entry in made["errata"]}
    assert proofs["xue.table1_shift"]["holds"] is True
    code, out, _ = dualarm("show", "xue.tab01")
    assert code == 0
    assert "verdict: inconsistent-in-print" in out
    assert "d: 0, 0, 0, 1.225, 0, 0.225 | 0, 0, 0, 1.225, 0, 0.225" in out  # print beside ours


def test_run_writes_files(dualarm, tmp_path):
    code, _, _ = dualarm("run", "xue.fig03", "xue.eq01", "--out", tmp_path)
    assert code == 0
    expected = [f"xue.eq01.{s}" for s in ("csv", "json", "png", "svg")]
    expected += [f"xue.fig03.{s}" for s in ("csv", "html", "json", "png", "svg")]
    assert sorted(path.name for path in tmp_path.iterdir()) == expected
    scene = (tmp_path / "xue.fig03.html").read_text()
    assert 'class="ledger-scene"' in scene
    assert 'src="http' not in scene


def test_verify_and_robustness(dualarm):
    code, out, _ = dualarm("verify", "xue.eq01", "xue.tab01", "xue.fig05", "--json")
    report = json.loads(out)
    assert (code, report["drifted"]) == (0, [])
    assert report["checked"] == 3
    code, out, _ = dualarm("robustness", "xue.claim_overlap", "--samples", 8, "--json")
    assert code == 0
    assert json.loads(out)["robustness"]["samples"] == 8
    stored = json.loads(dualarm("show", "xue.claim_overlap", "--json")[1])["robustness"]
    again = json.loads(dualarm("robustness", "xue.claim_overlap", "--json")[1])
    assert again["robustness"] == stored
    assert "no assumption with another plausible value" in dualarm("robustness", "xue.eq01")[1]


def test_the_former_name_of_robustness_still_works(dualarm):
    assert dualarm("sensitivity", "xue.eq01") == dualarm("robustness", "xue.eq01")
    assert "sensitivity" not in dualarm("--help")[1]


def test_verify_is_the_same_for_two_workers(dualarm):
    one = dualarm("verify", "xue.eq01", "xue.tab01", "--json")
    assert dualarm("verify", "xue.eq01", "xue.tab01", "--json", "--jobs", 2) == one


def test_study_lists_what_is_stored(dualarm):
    code, out, _ = dualarm("study")
    assert code == 0
    assert out.count("\n") > len(load().studies)
    assert "robustness/xue.claim_overlap: " in out


def test_cite(dualarm):
    code, out, _ = dualarm("cite", "xue.tab01")
    assert code == 0
    assert out.startswith("@misc{dualarm_repro_xue_tab01")
    code, out, _ = dualarm("cite", "xue.tab01", "--format", "csl-json")
    assert code == 0
    assert len(json.loads(out)) == 2


def test_export_writes_the_ledger(dualarm, tmp_path, records):
    code, out, _ = dualarm("export", "--out", tmp_path / "all")
    assert code == 0
    assert "ledger.zip" in out
    written = json.loads((tmp_path / "all/ledger.json").read_text())
    assert [made["id"] for made in written] == [made["id"] for made in records]
    command = [sys.executable, "-m", "claims", "verify", "repro.yaml"]
    subprocess.run(command, cwd=tmp_path / "all", check=True, capture_output=True)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["show", "xue.fig99"], ["xue.fig99", "expected an item id"]),
        (["show"], ["Missing argument"]),
        (["shew", "xue.fig01"], ["shew"]),
        (["list", "--paper", "smith"], ["smith", "xue, patent, pan, qiu"]),
        (["list", "--kind", "photo"], ["photo"]),
        (["list", "--jsn"], ["--jsn"]),
        (["run", "xue.nothing", "--out", "."], ["xue.nothing"]),
        (["verify", "xue.nothing"], ["xue.nothing"]),
        (["cite", "xue.tab01", "--format", "ris"], ["ris"]),
        (["robustness", "xue.claim_overlap", "--samples", "0"], ["--samples", "or equal to 1"]),
        (["robustness", "xue.claim_overlap", "--samples", "1000000000"], ["65536"]),
        (["study", "nothing"], ["nothing", "dualarm study"]),
        (["study", "--scheduler", "tcp://nobody:1"], ["--scheduler", "tcp://nobody:1", "--stale"]),
        (["study", "--jobs", "2"], ["--jobs", "--stale"]),
        (["verify", "--jobs", "0"], ["--jobs"]),
        (["plan"], ["SCENE.yaml", "dualarm plan --help"]),
        (["plan", "nowhere.yaml", "--method", "apf-improved"], ["nowhere.yaml"]),
        (["plan", "nowhere.yaml", "--method", "dijkstra"], ["dijkstra", "apf-improved"]),
        (["new-document", "9x"], ["9x"]),
        (["run", "xue.tab02", "--set", "base_distance"], ["base_distance", "assumption=value"]),
        (["run", "xue.tab02", "--set", "distance=3"], ["distance=3", "base_distance"]),
        (["run", "xue.tab02", "--set", "base_distance=far"], ["far", "a finite number"]),
        (["run", "xue.tab02", "--set", "update_rule=jump"], ["jump", "neighbour_search"]),
        (["run", "xue.claim_slave_start", "--set", "base_distance=1e300"], ["arm es165d-slave"]),
        (["run", "xue.fig09", "--set", "step_limit=0"], ["step_limit = 0"]),
        (["run", "xue.eq01", "--set", "base_distance=3"], ["base_distance=3", "xue.eq01"]),
    ],
)
def test_bad_arguments_are_one_line(dualarm, arguments, words):
    code, out, err = dualarm(*arguments)
    assert code == 2
    assert err.count("\n") == 1
    assert "Traceback" not in err
    assert out == ""
    for word in words:
        for part in word.split(", "):
            assert part in err


def test_unwritable_folder_leaves_nothing(dualarm, tmp_path):
    (tmp_path / "file").write_text("kept")
    code, _, err = dualarm("run", "xue.eq01", "--out", tmp_path / "file" / "sub")
    assert code == 2
    assert err.count("\n") == 1
    assert str(tmp_path / "file") in err
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


def test_help_lists_the_commands(dualarm):
    code, out, _ = dualarm("--help")
    assert code == 0
    names = ("list", "show", "run", "verify", "robustness", "cite", "export")
    assert all(name in out for name in names)
    code, out, _ = dualarm()
    assert code == 2
    assert "Usage" in out


def test_show_url_is_the_page_of_the_item(dualarm):
    code, out, _ = dualarm("show", "xue.tab01", "--url")
    assert code == 0
    assert out.strip().endswith("items/xue.tab01.html")
    code, _, err = dualarm("show", "xue.nothing", "--url")
    assert code == 2
    assert "xue.nothing" in err
