"""The cache of executed notebooks, of which nothing is believed that cannot be read or has changed.

A kill, a full disk or a bad sector may leave a register that is no database or a notebook that is
not what was executed. Both only cost time: what is doubtful is removed and executed again.
"""

from __future__ import annotations

import json
import shutil
import sqlite3
from contextlib import closing, suppress
from hashlib import sha256
from pathlib import Path
from typing import Any

import nbformat
from jupyter_cache import get_cache
from jupyter_cache.cache.db import NbCacheRecord
from sqlalchemy.exc import SQLAlchemyError

from dualarm_repro.ledger.files import to_json, write_text

#: The register that jupyter-cache keeps, and our hashes of the notebooks in it.
REGISTER, SEALS = "global.db", "seals.json"
_FILES = (REGISTER, SEALS, "pages.json")
#: jupyter-cache passes some errors of its database on as a RuntimeError.
_UNREADABLE = (OSError, ValueError, KeyError, TypeError, AttributeError, RuntimeError)


def open_cache(folder: Path) -> Any:
    """The cache of a folder without the entries that are damaged; a new one if all of it is."""
    damaged = any((folder / name).is_dir() for name in _FILES)
    if damaged or (folder.exists() and not _readable(folder / REGISTER)):
        shutil.rmtree(folder, ignore_errors=True)
    cache = get_cache(folder)
    try:
        cache.list_project_records()
        seals = _seals(folder)
        for entry in cache.list_cache_records():
            found = _hash(cache, entry.pk)
            if found is None or seals.get(entry.hashkey, found) != found:
                _remove(cache, entry)
    except (SQLAlchemyError, *_UNREADABLE):
        shutil.rmtree(folder, ignore_errors=True)
        cache = get_cache(folder)
    return cache


def seal(cache: Any, folder: Path) -> None:
    """Keep the hash of every executed notebook, by which a later change is seen."""
    found = {entry.hashkey: _hash(cache, entry.pk) for entry in cache.list_cache_records()}
    write_text(folder / SEALS, to_json(found, indent=1))


def _readable(register: Path) -> bool:
    """Whether a register is a whole database, or none is there and nothing beside it."""
    if not register.exists():
        return not (register.parent / "executed").exists()
    try:
        with closing(sqlite3.connect(register)) as connection:
            return connection.execute("PRAGMA integrity_check").fetchone() == ("ok",)
    except sqlite3.Error:
        return False


def _seals(folder: Path) -> dict[str, str]:
    try:
        found = json.loads((folder / SEALS).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return found if isinstance(found, dict) else {}


def _hash(cache: Any, pk: int) -> str | None:
    """SHA-256 of an executed notebook; None if it cannot be read."""
    try:
        written = nbformat.writes(cache.get_cache_bundle(pk).nb)
    except _UNREADABLE:
        return None
    return sha256(written.encode()).hexdigest()


def _remove(cache: Any, entry: Any) -> None:
    with suppress(KeyError):
        cache.remove_cache(entry.pk)
        return
    NbCacheRecord.remove_records([entry.pk], cache.db)  # its notebook is not there
