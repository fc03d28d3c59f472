"""`dualarm new-document` in a copy of the tree: what it writes passes, or nothing is left."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path
from shutil import copy2, copytree, ignore_patterns

import pytest

from dualarm_repro.datafiles import read_yaml
from dualarm_repro.errors import LedgerError, OutputError
from dualarm_repro.new_document import new_document

ROOT = Path(__file__).parents[2]
TITLE = 'On "arms" & <hands>: 50 % of $x_1$, {and} } \\more'
#: Executes each text alone, as a notebook of its own.
ALONE = "import sys\nfor cells in sys.argv[1:]: exec(cells, {'__name__': '__main__'})"
CELL = re.compile(r"^```\{code-cell\} ipython3\n(.*?)^```", re.DOTALL | re.MULTILINE)


def copied(folder):
    """The tree as a newcomer's clone has it, once its package has been imported.

    Without its bytecode each process would compile all of it; files that Python is about to rename
    are none.
    """
    for part in ("book", "data", "dualarm_repro", "tests", "tools"):
        left = "*.pyc.*" if part == "dualarm_repro" else "__pycache__"
        copytree(ROOT / part, folder / part, ignore=ignore_patterns(left))
    for path in ROOT.glob("*.*"):
        if path.is_file():
            copy2(path, folder)
    for name in (".zenodo.json", "LICENSE", "Makefile"):
        copy2(ROOT / name, folder)
    return folder


def files(folder):
    return {p: p.read_bytes() for p in folder.rglob("*") if p.is_file() and p.suffix != ".pyc"}


def stamps(folder):
    """When each file was written last, and its size: another as soon as anything is written."""
    found = [p for p in folder.rglob("*") if p.is_file() and p.suffix != ".pyc"]
    return {p: (p.stat().st_mtime_ns, p.stat().st_size) for p in found}


def run(clone, *command, cwd=None):
    """A command in a process that knows the copy alone."""
    path = {**os.environ, "PYTHONPATH": str(clone)}
    return subprocess.run(
        [sys.executable, *map(str, command)],
        cwd=cwd or clone,
        env=path,
        capture_output=True,
        text=True,
    )


def dualarm(clone, *arguments, cwd=None):
    return run(clone, "-m", "dualarm_repro.cli", *arguments, cwd=cwd)


@pytest.fixture(scope="module")
def extended(tmp_path_factory):
    """A clone with a fifth document, written from a folder inside of it, and what that changed."""
    folder = copied(tmp_path_factory.mktemp("clone"))
    before = files(folder)
    made = dualarm(folder, "new-document", "smith", "--title", TITLE, cwd=folder / "book")
    assert (made.returncode, made.stderr) == (0, "")
    after = files(folder)
    return folder, {p.relative_to(folder): after[p] for p in after if after[p] != before.get(p)}


@pytest.fixture(scope="module")
def clone(extended):
    return extended[0]


@pytest.fixture(scope="module")
def untouched(tmp_path_factory):
    return copied(tmp_path_factory.mktemp("untouched"))


def test_the_example_has_a_verdict(clone):
    made = json.loads(dualarm(clone, "show", "smith.example", "--json").stdout)
    assert made["verdict"] == "reproduced-under-assumption"
    assert made["draws"] == "up to date"
    assert 0 < made["robustness"]["meets_print"]["share"] < 1
    assert made["code"]["file"] == "dualarm_repro/papers/smith/pages/first.py"
    listed = json.loads(dualarm(clone, "list", "--paper", "smith", "--json").stdout)
    assert [entry["id"] for entry in listed] == ["smith.example"]
    assert read_yaml(clone / "data/papers/smith.yaml")["document"]["title"] == TITLE


@pytest.mark.long(short="test_its_pages_are_in_the_book_and_run")
def test_the_tests_of_the_clone_accept_it(clone):
    chosen = ("test_architecture", "ledger/test_completeness", "papers/test_ledger_of_papers",
              "papers/test_trust", "view/test_schemas", "test_metadata",
              "book/test_foundations")  # fmt: skip
    words = "smith or real_ledger or generated or agree or crate_is_read or pybtex or document_p"
    command = ("-m", "pytest", "-p", "no:cacheprovider", "-k", words)
    made = run(clone, *command, *(f"tests/{name}.py" for name in chosen))
    assert made.returncode == 0, made.stdout
    assert int(re.search(r"(\d+) passed", made.stdout)[1]) > 25


def test_its_pages_are_in_the_book_and_run(clone):
    contents = (clone / "book/_toc.yml").read_text()
    assert "      - file: smith/index\n        sections:\n" in contents
    folders = re.findall(r"- file: (\w+)/\w+", contents)
    documents, at = (
        {path.stem for path in (ROOT / "data/papers").glob("*.yaml")},
        folders.index("smith"),
    )
    assert folders[at - 1] in documents
    assert not documents & set(folders[at:]), "after the last page of the documents"
    pages = [(clone / f"book/smith/{page}.md").read_text() for page in ("index", "first")]
    cells = ["\n".join(CELL.findall(text)) for text in pages]
    assert all(cells)
    made = run(clone, "-c", ALONE, *cells)
    assert made.returncode == 0, made.stderr


def test_what_it_writes_is_formatted(clone):
    for command in (("format", "--check"), ("check",)):
        assert run(clone, "-m", "ruff", *command, "dualarm_repro/papers/smith").returncode == 0


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["xue"], ["xue", "names nothing in the clone"]),
        (["intro"], ["intro", "names nothing"]),
        (["foundations"], ["foundations", "names nothing"]),
        (["khatib1986"], ["khatib1986", "names nothing"]),
        (["Smith"], ["Smith", "small letters"]),
        (["2020"], ["2020", "small letters"]),
        (["a-b"], ["a-b", "small letters"]),
        (["../smith"], ["../smith", "small letters"]),
        (["class"], ["class", "small letters"]),
        (["on"], ["on", "small letters"]),
        (["null"], ["null", "small letters"]),
        (["show"], ["show", "names nothing"]),
        (["smith", "--title", " "], ["--title", "a text"]),
        (["smith", "--title", ""], ["--title", "a text"]),
        (["smith", "--root", "/"], ["--root", "a clone"]),
        ([], ["Missing argument"]),
    ],
)
def test_bad_input_is_one_line_and_writes_nothing(
    request, untouched, monkeypatch, arguments, words
):
    before = stamps(untouched)
    if arguments == ["xue"]:  # as it is typed
        made = dualarm(untouched, "new-document", *arguments)
        told = made.returncode, made.stdout, made.stderr
    else:
        monkeypatch.chdir(untouched)
        told = request.getfixturevalue("dualarm")("new-document", *arguments)
    code, out, err = told
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert all(word in err for word in words), err
    assert stamps(untouched) == before


def test_without_a_clone_around(request, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code, out, err = request.getfixturevalue("dualarm")("new-document", "smith")
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert str(tmp_path) in err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("fails_at", [1, 8])
def test_a_file_that_cannot_be_moved_leaves_all_as_before(
    untouched, extended, monkeypatch, fails_at
):
    """What is moved is what was computed for the clone above."""

    def computed_before(staged, item_id):
        for name, content in extended[1].items():
            (staged / name).parent.mkdir(parents=True, exist_ok=True)
            (staged / name).write_bytes(content)

    monkeypatch.setattr("dualarm_repro.new_document._compute", computed_before)
    before, folders = files(untouched), {p for p in untouched.rglob("*") if p.is_dir()}
    replace, calls = Path.replace, []

    def failing(path, target):
        calls.append(target)
        if len(calls) == fails_at:
            raise PermissionError(13, "Permission denied")
        return replace(path, target)

    monkeypatch.setattr(Path, "replace", failing)
    with pytest.raises(OutputError, match="Permission denied"):
        new_document("smith", root=untouched)
    assert len(calls) >= fails_at
    assert files(untouched) == before
    assert {p for p in untouched.rglob("*") if p.is_dir()} == folders


def test_a_clone_that_cannot_compute_is_left_alone(tmp_path):
    folder = copied(tmp_path)
    rules = folder / "dualarm_repro/ledger/rules.py"
    rules.write_text(rules.read_text() + "\nraise ValueError('broken')\n")
    before = files(folder)
    with pytest.raises(LedgerError, match=r"cannot compute smith\.example: ValueError: broken"):
        new_document("smith", root=folder)
    assert files(folder) == before
