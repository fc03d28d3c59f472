"""Lock files: every distribution with its version, hashes, marker and the ones that ask for it."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

LOCKS = ("requirements.lock", "requirements-bench.lock", "requirements-lab.lock")
PROJECT = "dualarm-repro"
_PIN = re.compile(r"([A-Za-z0-9][A-Za-z0-9._-]*)==(\S+)(?: ; (.+?))? \\")
_HASH = re.compile(r"    --hash=sha256:([0-9a-f]{64})(?: \\)?")
_BOUND_BY = re.compile(r"    #(?: via|  ) +-c \S+")
_VIA = re.compile(r"    #(?: via|  ) +(\S+)(?: \(.*\))?")


class LockError(Exception):
    """A line of a lock that is neither a pinned distribution nor a hash nor a comment."""


@dataclass(frozen=True)
class Pinned:
    """One distribution: ``marker`` says where it is installed, ``via`` who asks for it."""

    name: str
    version: str
    marker: str
    hashes: tuple[str, ...]
    via: tuple[str, ...]


def read(text: str, source: str = "lock") -> list[Pinned]:
    """Pinned distributions of the text of a lock, in its order.

    Raises
    ------
    LockError
        A line of another form, an address for instance, or a distribution without a hash.
    """
    found: list[Pinned] = []
    for number, line in enumerate(text.splitlines(), 1):
        if not line.strip() or line.startswith("#") or line.strip() == "# via":
            continue
        if _BOUND_BY.fullmatch(line):
            continue
        if pin := _PIN.fullmatch(line):
            found.append(Pinned(pin[1], pin[2], pin[3] or "", (), ()))
        elif not found:
            raise LockError(f"{source}:{number}: no pinned distribution before this line")
        elif match := _HASH.fullmatch(line):
            found[-1] = _with(found[-1], hashes=(*found[-1].hashes, match[1]))
        elif match := _VIA.fullmatch(line):
            found[-1] = _with(found[-1], via=(*found[-1].via, match[1]))
        else:
            raise LockError(f"{source}:{number}: neither pin, sha256 nor comment: {line.strip()}")
    for pinned in found:
        if not pinned.hashes:
            raise LockError(f"{source}: {pinned.name}=={pinned.version} has no hash")
    return found


def read_all(root: Path) -> dict[str, list[Pinned]]:
    """Every lock of the project by the name of its file."""
    return {name: read((root / name).read_text(encoding="utf-8"), name) for name in LOCKS}


def reached(pinned: Iterable[Pinned], demands: Iterable[str]) -> set[str]:
    """Names of everything that some demands bring in, by who asks for whom."""
    asked: dict[str, list[str]] = {}
    for one in pinned:
        for parent in one.via:
            asked.setdefault(parent, []).append(one.name)
    seen: set[str] = set()
    waiting = [plain(demand) for demand in demands]
    while waiting:
        name = waiting.pop()
        if name not in seen:
            seen.add(name)
            waiting += asked.get(name, ())
    return seen


def plain(demand: str) -> str:
    """Normalised name of a demand such as ``dask[distributed]>=2025.1``."""
    match = re.match(r"[A-Za-z0-9._-]+", demand)
    return re.sub(r"[-_.]+", "-", match[0]).lower() if match else ""


def _with(pinned: Pinned, **changed: tuple[str, ...]) -> Pinned:
    return Pinned(**{**vars(pinned), **changed})
