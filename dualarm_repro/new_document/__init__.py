"""Writes what a further document needs: data, room, pages of the book, citation, reference.

Everything is made and computed in a copy of the clone, and moved into it only when all is there.
"""

from __future__ import annotations

import csv
import os
import re
import subprocess
import sys
from collections.abc import Mapping
from keyword import iskeyword
from pathlib import Path
from shutil import copy2, copytree, ignore_patterns
from tempfile import TemporaryDirectory

import yaml

from .. import papers
from ..errors import InputError, LedgerError, OutputError
from ..ledger.file_set import move_together
from .templates import fill

_COMMAND = "new-document"
_ID = re.compile(r"[a-z][a-z0-9_]*")
#: What makes a folder a clone, and what the copy needs of it.
_CLONE = (
    "pyproject.toml",
    "data/papers/inventory.csv",
    "data/headlines.yaml",
    "book/_toc.yml",
    "book/references.bib",
    "dualarm_repro/papers/__init__.py",
    "tools/metadata.py",
)
_COPIED = ("data", "dualarm_repro", "tools")
#: Draws the assumption of the example, and writes its reference result.
_COMPUTE = """
import sys
from dualarm_repro.ledger.reference import verify
from dualarm_repro.ledger.robustness import study_of
from dualarm_repro.papers import load
study_of(load(), sys.argv[1]).run()
verify(load(), sys.argv[1:], update=True)
"""


def new_document(name: str, title: str | None = None, root: Path | None = None) -> list[Path]:
    """Add a document with one example item to a clone.

    Parameters
    ----------
    name
        Id of the document.
    title
        Its title; default a placeholder with the id.
    root
        The clone; default the one around the working directory.

    Returns
    -------
    list of Path
        The files that are new or changed.

    Raises
    ------
    InputError
        No clone there, an id that cannot be used or is taken, or an empty title.
    OutputError
        The clone cannot be written.
    LedgerError
        The clone cannot compute the example.
    """
    root = _clone(root)
    title = f"Document {name}" if title is None else title
    words = {"id": _usable(name, root), "title": " ".join(title.split())}
    if not words["title"]:
        raise InputError(_COMMAND, "--title", title, "a text")
    try:
        with TemporaryDirectory(dir=root, prefix=f".{_COMMAND}-") as folder:
            staged = Path(folder)
            _copy(root, staged)
            copied = _contents(staged)
            _write(staged, words)
            _compute(staged, f"{name}.example")
            return _move(staged, root, copied)
    except OSError as error:
        reason = error.strerror or str(error)
        raise OutputError(root, "clone", reason, "a folder that can be written") from None


def _clone(root: Path | None) -> Path:
    """The clone at a folder, or around the working directory."""
    here = Path.cwd()
    for folder in [root] if root else [here, *here.parents]:
        if all((folder / part).is_file() for part in _CLONE):
            return folder.resolve()
    lacking = f"a clone of the project, with {', '.join(_CLONE[:4])}"
    raise InputError(_COMMAND, "--root", str(root or here), lacking)


def _usable(name: str, root: Path) -> str:
    """The id, if it has the right form and names nothing in the clone."""
    if not _ID.fullmatch(name) or iskeyword(name) or yaml.safe_load(name) != name:
        expected = "small letters, digits and _, a letter first, and no word of Python or YAML"
        raise InputError(_COMMAND, "ID", name, expected)
    taken = {path.stem for path in root.glob("data/papers/*.yaml")} | set(vars(papers))
    taken |= {path.stem for path in root.glob("data/results/*")}
    taken |= {path.stem for path in root.glob("dualarm_repro/papers/*")}
    taken |= {path.stem for path in root.glob("book/*")}
    taken |= set(re.findall(r"^@\w+\{(\w+),", _read(root / "book/references.bib"), re.MULTILINE))
    if name in taken:
        raise InputError(_COMMAND, "ID", name, "an id that names nothing in the clone yet")
    return name


def _copy(root: Path, staged: Path) -> None:
    for part in _COPIED:
        copytree(root / part, staged / part, ignore=ignore_patterns("__pycache__"))
    for path in (*root.glob("*.*"), root / "book/_toc.yml", root / "book/references.bib"):
        if path.is_file():
            (staged / path.relative_to(root)).parent.mkdir(exist_ok=True)
            copy2(path, staged / path.relative_to(root))


def _write(staged: Path, words: dict[str, str]) -> None:
    """The new files, and the lines that the lists of the clone gain."""
    inventory = staged / "data/papers/inventory.csv"
    with inventory.open(encoding="utf-8", newline="") as handle:
        documents = dict.fromkeys(row["id"].partition(".")[0] for row in csv.DictReader(handle))
    found = fill({**words, "order": len(documents) + 1})
    _append(inventory, f"{words['id']}.example,claim\n")
    _append(staged / "data/headlines.yaml", found.pop("headline.yaml"))
    _append(staged / "book/references.bib", found.pop("reference.bib"))
    contents = staged / "book/_toc.yml"
    contents.write_text(_listed(_read(contents), found.pop("toc.yml"), documents), "utf-8")
    for path, text in found.items():
        (staged / path).parent.mkdir(parents=True, exist_ok=True)
        (staged / path).write_text(text, encoding="utf-8")


def _listed(contents: str, entry: str, documents: dict[str, None]) -> str:
    """The table of contents with an entry after the last page of a document."""
    lines = contents.splitlines(keepends=True)
    pages = re.compile(rf"\s*- file: (?:{'|'.join(documents)})/\w+\s*")
    last = max((k for k, line in enumerate(lines) if pages.fullmatch(line)), default=None)
    if last is None:
        raise InputError("book/_toc.yml", "parts", "no page of a document", "pages of documents")
    return "".join((*lines[: last + 1], entry, *lines[last + 1 :]))


def _compute(staged: Path, item_id: str) -> None:
    """Draws, reference result and the descriptions of the project, all by the code of the copy."""
    made = {**os.environ, "PYTHONPATH": str(staged), "PYTHONDONTWRITEBYTECODE": "1"}
    for command in (["-c", _COMPUTE, item_id], ["tools/metadata.py"]):
        run = subprocess.run(
            [sys.executable, *command], cwd=staged, env=made, capture_output=True, text=True
        )
        if run.returncode:
            lines = run.stderr.strip().splitlines() or ["no message"]
            raise LedgerError(f"{_COMMAND}: the clone cannot compute {item_id}: {lines[-1]}")


def _contents(folder: Path) -> dict[Path, bytes]:
    """What the files of a folder hold, under their relative paths."""
    paths = {path.relative_to(folder): path for path in sorted(folder.rglob("*"))}
    return {
        name: path.read_bytes()
        for name, path in paths.items()
        if path.is_file() and "__pycache__" not in name.parts
    }


def _move(staged: Path, root: Path, copied: Mapping[Path, bytes]) -> list[Path]:
    """Move what was written into the clone; if one file cannot be moved, all is as before.

    Raises
    ------
    LedgerError
        Somebody changed one of these files in the clone meanwhile.
    """
    names = [name for name, text in _contents(staged).items() if copied.get(name) != text]
    before = {n: (root / n).read_bytes() if (root / n).is_file() else None for n in names}
    if changed := [str(name) for name in names if before[name] != copied.get(name)]:
        raise LedgerError(f"{_COMMAND}: changed meanwhile, so nothing is written: {changed[0]}")
    move_together(staged, root, names)
    return [root / name for name in names]


def _append(path: Path, text: str) -> None:
    content = _read(path)
    path.write_text(content + ("" if content.endswith("\n") else "\n") + text, encoding="utf-8")


def _read(path: Path) -> str:
    return path.read_text(encoding="utf-8")
