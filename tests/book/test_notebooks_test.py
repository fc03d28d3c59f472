"""The wheel carries what a page needs, and notebooks never run against the clone."""

import sys
from pathlib import Path
from zipfile import ZipFile

import notebooks_test
import pytest
import yaml

ROOT = Path(notebooks_test.__file__).parents[1]


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    return notebooks_test.build_wheel(tmp_path_factory.mktemp("wheel"))


def test_the_wheel_holds_code_data_templates_and_style(wheel):
    names = set(ZipFile(wheel).namelist())
    data = {
        f"dualarm_repro/_data/{p.relative_to(ROOT / 'data').as_posix()}"
        for p in ROOT.glob("data/*/*.yaml")
    }
    assert data
    assert data <= names
    package = ROOT / "dualarm_repro"
    files = [p for p in package.rglob("*") if p.suffix in (".py", ".html", ".yaml", ".css")]
    assert {p.relative_to(ROOT).as_posix() for p in files} <= names
    assert "dualarm_repro/view/ledger.css" in names
    assert not any(name.startswith(("book/", "tests/", "tools/")) for name in names)


def test_pages_without_a_notebook_are_named(tmp_path):
    with pytest.raises(FileNotFoundError, match="none in"):
        notebooks_test.notebooks_in(tmp_path)
    (tmp_path / "_sources").mkdir()
    (tmp_path / "_sources/intro.ipynb").write_text("{}")
    assert [p.name for p in notebooks_test.notebooks_in(tmp_path)] == ["intro.ipynb"]
    with pytest.raises(FileNotFoundError, match=r"xue/truth\.ipynb"):
        notebooks_test.notebooks_in(tmp_path, ["intro", "xue/truth"])
    assert notebooks_test.main(["--html", str(tmp_path / "none")]) == notebooks_test.NOT_RUN


def test_the_clone_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(notebooks_test, "outside", lambda: {"PYTHONPATH": str(ROOT)})
    with pytest.raises(RuntimeError, match="in the clone"):
        notebooks_test.run(Path(sys.executable), [], tmp_path, tmp_path / "pages")


def test_the_environment_of_notebooks_forgets_the_clone(monkeypatch):
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    assert "PYTHONPATH" not in notebooks_test.outside()


def test_the_short_form_is_of_pages_with_code():
    pages = [
        p.relative_to(ROOT / "book").with_suffix("").as_posix() for p in notebooks_test_pages()
    ]
    assert set(notebooks_test.SHORT) <= set(pages)


def notebooks_test_pages():
    from prerun import notebooks

    return notebooks(ROOT / "book")


def test_binder_installs_the_locked_versions():
    """What Binder reads names files of the clone that exist."""
    folder = ROOT / "binder"
    (line,) = (folder / "requirements.txt").read_text().split("\n")[:1]
    assert (folder / line.removeprefix("-r ")).resolve().is_file()
    python = yaml.safe_load((folder / "runtime.txt").read_text()).removeprefix("python-")
    assert f"--python-version {python}" in (ROOT / "requirements-lab.lock").read_text()
    assert "tools/lab_notebooks.py" in (folder / "postBuild").read_text()
    assert (folder / "postBuild").stat().st_mode & 0o100
