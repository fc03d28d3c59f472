"""Values kept between processes: trusted only while all that they depend on is as it was.

An entry that is damaged, forged by accident or out of date is a miss, never an error.
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..cache_folder import cache_folder
from ..errors import InputError, OutputError
from .closure import closure_of_modules, hash_inputs
from .files import to_json, write_text

if TYPE_CHECKING:
    from .registry import Registry


def path_of(kind: str, name: str) -> Path | None:
    """File of an entry, or None where nothing is kept."""
    root = cache_folder()
    return root / kind / f"{name}.json" if root else None


def read(registry: Registry, kind: str, name: str) -> Any | None:
    """The value of an entry, or None if there is none that can be trusted."""
    path = path_of(kind, name)
    if path is None:
        return None
    try:
        entry = json.loads(path.read_text(encoding="utf-8"))
        found = closure_of_modules(tuple(entry["roots"]), entry["drawn"])
        fresh = (
            entry["code"] == found.digest
            and entry["versions"] == dict(found.versions)
            and entry["sha256"] == _hash(entry["value"])
            and entry["inputs"] == hash_inputs(registry, entry["inputs"])
        )
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError, InputError):
        return None
    return entry["value"] if fresh else None


def keep(
    registry: Registry,
    kind: str,
    name: str,
    value: Any,
    roots: Iterable[str],
    inputs: Iterable[str],
    *,
    drawn: bool = False,
) -> None:
    """Write an entry.

    Parameters
    ----------
    roots
        Modules whose closure the value depends on.
    inputs
        Names of the inputs that were opened, see ``tracking.note``.
    drawn
        Whether the code that draws counts as well.
    """
    path, modules = path_of(kind, name), tuple(sorted(roots))
    if path is None:
        return
    found = closure_of_modules(modules, drawn)
    entry = {
        "roots": list(modules),
        "drawn": drawn,
        "code": found.digest,
        "versions": dict(found.versions),
        "inputs": hash_inputs(registry, inputs),
        "sha256": _hash(value),
        "value": value,
    }
    try:
        write_text(path, to_json(entry, indent=None))
    except OutputError:
        pass  # a cache that cannot be written only costs time


def _hash(value: Any) -> str:
    return sha256(to_json(value, indent=None).encode()).hexdigest()
