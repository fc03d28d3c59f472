"""The rows of the matrix: a Python, which versions are chosen, and an extra."""

from __future__ import annotations

import hashlib
import json
import tomllib
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

LOCK = "requirements.lock"
#: Newest first released version of Python that is asked for; older ones start at `requires-python`.
PYTHONS = ("3.11", "3.12", "3.13", "3.14", "3.15")
#: How versions are chosen: those of the lock, the lowest that are allowed, the newest.
LOCKED, LOWEST, HIGHEST = "locked", "lowest", "highest"


@dataclass(frozen=True)
class Row:
    """One environment: ``extra`` is empty where the wheel is installed without any."""

    python: str
    versions: str
    extra: str = ""

    @property
    def name(self) -> str:
        """``3.11-highest`` or ``3.11-highest-lab``."""
        return "-".join(part for part in (self.python, self.versions, self.extra) if part)

    @property
    def record(self) -> dict[str, str]:
        """What names the row in the stored file."""
        return {"name": self.name, **asdict(self)}


def rows(extras: Sequence[str]) -> list[Row]:
    """All rows: every Python with locked and newest versions, the lowest ones, every extra."""
    first = PYTHONS[0]
    plain = [Row(python, choice) for python in PYTHONS for choice in (LOCKED, HIGHEST)]
    return [*plain, Row(first, LOWEST), *(Row(first, HIGHEST, extra) for extra in extras)]


def project_table(root: Path) -> dict[str, Any]:
    """``[project]`` of ``pyproject.toml``."""
    text = (root / "pyproject.toml").read_text(encoding="utf-8")
    return tomllib.loads(text)["project"]


def fingerprint(row: Row, root: Path) -> str:
    """SHA-256 of what decides which packages a row installs: demands, and the lock where used."""
    table = project_table(root)
    parts = [table["requires-python"], sorted(table["dependencies"])]
    parts.append(sorted(table["optional-dependencies"].get(row.extra, ())))
    if row.versions == LOCKED:
        parts.append((root / LOCK).read_text(encoding="utf-8"))
    return hashlib.sha256(json.dumps(parts).encode()).hexdigest()
