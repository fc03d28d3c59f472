"""Fingerprint of everything a computed value depends on: library source, data files, versions."""

from __future__ import annotations

import platform
from functools import cache
from hashlib import sha256
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from ..datafiles import data_root

#: Distributions whose version may change a number.
NUMERIC = ("numpy", "scipy", "sympy", "pandas", "numba", "pin", "coal", "cvxpy")


def hash_files(paths: list[Path], root: Path) -> str:
    """SHA-256 over names (relative to ``root``) and contents of files, in sorted order."""
    digest = sha256()
    for path in sorted(paths):
        digest.update(str(path.relative_to(root)).encode())
        digest.update(path.read_bytes())
    return digest.hexdigest()


def versions() -> dict[str, str]:
    """Versions of Python and of the numeric libraries."""
    found = {"python": platform.python_version()}
    for name in NUMERIC:
        try:
            found[name] = version(name)
        except PackageNotFoundError:
            found[name] = "absent"
    return found


@cache
def fingerprint() -> str:
    """Hash of the library's source, of ``data`` without ``data/results``, and of the versions.

    Computed once per process: source edited while a process runs is not what the process runs.
    """
    package, data = Path(__file__).resolve().parents[1], data_root()
    sources = [p for p in package.rglob("*.py")]
    inputs = [
        p for p in data.rglob("*") if p.is_file() and "results" not in p.relative_to(data).parts
    ]
    parts = hash_files(sources, package) + hash_files(inputs, data) + repr(versions())
    return sha256(parts.encode()).hexdigest()
