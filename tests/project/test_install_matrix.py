"""Rows of the install matrix: complete, current, and failures are seen as such."""

import json
import shutil
import sys
from pathlib import Path

import install_matrix
import pytest
from installs.environment import InstallFailed, build_wheel, interpreter, run, variables
from installs.questions import LISTED, MODULES, STEPS, answers
from installs.rows import HIGHEST, LOCKED, LOWEST, PYTHONS, Row, fingerprint, project_table, rows

OUTCOMES = {install_matrix.PASSED, install_matrix.FAILED, install_matrix.NOT_RUN}


@pytest.fixture(scope="module")
def matrix(root):
    return rows(list(project_table(root)["optional-dependencies"]))


@pytest.fixture(scope="module")
def stored():
    return install_matrix.stored()


def test_rows_cover_pythons_bounds_and_extras(root, matrix):
    table = project_table(root)
    assert table["requires-python"] == f">={PYTHONS[0]}"
    assert {(r.python, r.versions) for r in matrix if not r.extra} == {
        *((python, choice) for python in PYTHONS for choice in (LOCKED, HIGHEST)),
        (PYTHONS[0], LOWEST),
    }
    assert {r.extra for r in matrix} - {""} == set(table["optional-dependencies"]) == set(MODULES)
    assert len({row.name for row in matrix}) == len(matrix)


def test_every_row_is_stored_with_an_outcome(matrix, stored):
    assert set(stored) == {row.name for row in matrix}
    for name, record in stored.items():
        assert record["outcome"] in OUTCOMES, name
        if record["outcome"] == install_matrix.PASSED:
            wanted = ["import", *(["extra"] if record["extra"] else []), *STEPS]
            assert record["steps"] == wanted, name
            assert record["versions_found"]["python"].startswith(record["python"])
        else:
            assert record["reason"], name


def test_no_row_failed(stored):
    failed = {n: r["reason"] for n, r in stored.items() if r["outcome"] == install_matrix.FAILED}
    assert failed == {}


def test_rows_are_those_of_the_present_demands(root, matrix, stored):
    stale = [r.name for r in matrix if stored[r.name]["demands"] != fingerprint(r, root)]
    assert stale == [], "run `make install-matrix`"


def test_a_changed_bound_makes_its_rows_stale(root, tmp_path):
    for name in ("pyproject.toml", "requirements.lock"):
        shutil.copy2(root / name, tmp_path / name)
    plain, locked, lab = Row("3.11", HIGHEST), Row("3.11", LOCKED), Row("3.11", HIGHEST, "lab")
    before = [fingerprint(row, tmp_path) for row in (plain, locked, lab)]
    assert before == [fingerprint(row, root) for row in (plain, locked, lab)]
    path = tmp_path / "pyproject.toml"
    path.write_text(path.read_text().replace("jupyterlab>=4.3", "jupyterlab>=4.2"))
    after = [fingerprint(row, tmp_path) for row in (plain, locked, lab)]
    assert [a != b for a, b in zip(before, after, strict=True)] == [False, False, True]
    path.write_text(path.read_text().replace("numpy>=2.2", "numpy>=2.1"))
    last = [fingerprint(row, tmp_path) for row in (plain, locked, lab)]
    assert all(a != b for a, b in zip(after, last, strict=True))


def test_an_absent_python_is_not_run_and_a_broken_install_fails(tmp_path):
    absent = install_matrix.tried(Row("3.99", HIGHEST), Path("uv"), Path("x"), tmp_path, 10)
    assert (absent["outcome"], absent["reason"]) == (
        install_matrix.NOT_RUN,
        "no Python 3.99 on this machine",
    )
    here = ".".join(map(str, sys.version_info[:2]))
    assert interpreter(here) is not None
    false = Path(shutil.which("false"))
    broken = install_matrix.tried(Row(here, HIGHEST), false, Path("x"), tmp_path, 10)
    assert (broken["outcome"], broken["step"]) == (install_matrix.FAILED, "venv")


def test_a_command_that_fails_or_hangs_says_why(tmp_path):
    failing = [sys.executable, "-c", "raise SystemExit('see http://somewhere/x and /a/b/c/d')"]
    with pytest.raises(InstallFailed, match=r"exit code 1: see \(…\) and \(…\)"):
        run("plan", failing, tmp_path, {})
    with pytest.raises(InstallFailed, match=r"still running after 0\.8 s"):
        run("plan", [sys.executable, "-c", "import time; time.sleep(99)"], tmp_path, {}, 0.1)
    # by its own computing, or by the clock where the machine gives it next to none
    with pytest.raises(InstallFailed, match=r"more than 1 s of computing|still running after 8 s"):
        run("plan", [sys.executable, "-c", "while True: pass"], tmp_path, {}, 1)


def test_the_clone_itself_is_no_install(root, tmp_path):
    """A package that is imported from the clone would prove nothing."""
    environment = {**variables(tmp_path), "PYTHONPATH": str(root)}
    with pytest.raises(InstallFailed, match="that of the clone"):
        answers(Path(sys.executable), "", root, tmp_path, environment, 60)


@pytest.mark.parametrize("spoilt", ["list", "verify"])
def test_an_answer_that_is_wrong_fails(spoilt):
    said = {"list": [], "verify": {"checked": 1, "drifted": [{"id": "x"}]}}[spoilt]
    with pytest.raises(InstallFailed) as caught:
        STEPS[spoilt](lambda *arguments: json.dumps(said), Path())
    assert caught.value.step == spoilt
    assert LISTED


def test_the_wheel_carries_what_an_install_reads(root, tmp_path):
    from zipfile import ZipFile

    names = set(ZipFile(build_wheel(root, tmp_path)).namelist())
    for needed in ("_data/scenes/example_tasks.yaml", "_data/papers/xue.yaml", "cli/__main__.py"):
        assert f"dualarm_repro/{needed}" in names
    assert not any(name.startswith(("tests/", "tools/", "book/")) for name in names)
