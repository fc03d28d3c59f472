"""Files that belong together appear together or not at all."""

import os
import signal

import pytest

from dualarm_repro.errors import OutputError
from dualarm_repro.ledger.file_set import write_texts, write_together
from dualarm_repro.ledger.files import write_text

NAMES = ("a.json", "b.csv", "below/c.svg")


def texts(staged):
    return [write_text(staged / name, name) for name in NAMES]


def inside(folder):
    return sorted(str(p.relative_to(folder)) for p in folder.rglob("*") if p.is_file())


@pytest.mark.parametrize("exists", [True, False])
def test_all_files_are_moved_to_their_place(exists, tmp_path):
    folder = tmp_path / "out"
    if exists:
        folder.mkdir()
        (folder / "a.json").write_text("old")
        (folder / "own.txt").write_text("kept")
    assert write_together(folder, texts) == [folder / name for name in NAMES]
    assert inside(folder) == sorted([*NAMES, *(["own.txt"] if exists else [])])
    assert (folder / "a.json").read_text() == "a.json"
    assert [p.name for p in tmp_path.iterdir()] == ["out"]


@pytest.mark.parametrize("ending", [KeyboardInterrupt, ValueError])
@pytest.mark.parametrize("exists", [True, False])
def test_nothing_is_left_of_files_that_were_not_all_made(ending, exists, tmp_path):
    folder = tmp_path / "out"
    if exists:
        folder.mkdir()

    def make(staged):
        write_text(staged / "a.json", "new")
        raise ending

    with pytest.raises(ending):
        write_together(folder, make)
    assert list(tmp_path.rglob("*")) == ([folder] if exists else [])


def test_an_interruption_while_files_get_their_names_waits_for_the_last(tmp_path, monkeypatch):
    from pathlib import Path

    replace, folder = Path.replace, tmp_path / "out"

    def interrupted(self, target):
        if Path(target).parent == folder:
            os.kill(os.getpid(), signal.SIGINT)
        return replace(self, target)

    monkeypatch.setattr(Path, "replace", interrupted)
    with pytest.raises(KeyboardInterrupt):
        write_together(folder, texts)
    assert inside(folder) == sorted(NAMES)


def test_an_error_names_the_folder_that_was_asked_for(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputError, match=r"file: output = "):
        write_together(tmp_path / "file", texts)

    def make(staged):
        raise OutputError(staged / "a.json", "output", "No space left on device", "room")

    with pytest.raises(OutputError) as found:
        write_together(tmp_path / "out", make)
    assert found.value.source == tmp_path / "out"


def test_texts_are_written_by_name(tmp_path, monkeypatch):
    """The contents as given; of several that cannot all be moved none is left half-written."""
    folder = tmp_path / "out"
    found = write_texts(folder, {"a.json": "{}\n", "b.csv": "q1\n0\n"})
    assert found == [folder / "a.json", folder / "b.csv"]
    assert [path.read_text() for path in found] == ["{}\n", "q1\n0\n"]
    with pytest.raises(OutputError):
        write_texts(tmp_path / "other", {"a.json": "", "a.json/b": ""})
    assert not (tmp_path / "other").exists()


def test_if_one_file_cannot_be_moved_all_is_as_before(tmp_path):
    folder = tmp_path / "out"
    (folder / "b.csv" / "taken").mkdir(parents=True)
    (folder / "a.json").write_text("old")
    with pytest.raises(OutputError):
        write_together(folder, texts)
    assert (folder / "a.json").read_text() == "old"
    assert inside(folder) == ["a.json"]
    assert not (folder / "below").exists()
