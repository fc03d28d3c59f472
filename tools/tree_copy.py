"""A part of the tree in another folder, without what Python keeps beside its sources."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from shutil import copytree, ignore_patterns

_KEPT = ignore_patterns("__pycache__", "*.pyc")


def copy_tree(root: Path, names: Iterable[str], folder: Path) -> Path:
    """Copy folders and files of ``root`` by their names; what is there already stays as it is."""
    for name in names:
        source, copy = root / name, folder / name
        if copy.exists():
            continue
        if source.is_dir():
            copytree(source, copy, ignore=_KEPT)
        else:
            copy.parent.mkdir(parents=True, exist_ok=True)
            copy.write_bytes(source.read_bytes())
    return folder
