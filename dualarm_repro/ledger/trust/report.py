"""The stored outcome of all changes, ``data/results/trust.json``, which the status page shows."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from ...datafiles import data_path, opened
from ...errors import DataFileError
from ...sources import graph
from .counts import Tally


def report_path() -> Path:
    """File with the stored outcome."""
    return data_path("results", "trust.json")


def digest_of(rooms: Iterable[str]) -> str:
    """Digest of the code of some rooms of the package (``dualarm_repro/arms``)."""
    stems = tuple(f"{room.replace('/', '.')}." for room in rooms)
    return graph().digest(name for name in graph().files if f"{name}.".startswith(stems))


def report(
    tallies: Mapping[str, Tally], rooms: Sequence[str], seed: int, rows: Iterable[Mapping[str, Any]]
) -> dict[str, Any]:
    """Counts of every direction, what went unnoticed, and every mutant of the method."""
    mutants = [
        {name: row[name] for name in ("file", "line", "column", "old", "new", "equivalent")}
        | {"killed_by": row["killed_by"] and row["killed_by"].partition(": ")[0]}
        for row in rows
    ]
    tried = [row for row in mutants if not row["equivalent"]]
    killed = [row for row in tried if row["killed_by"]]
    method = {
        "tried": len(tried),
        "killed": len(killed),
        "survived": len(tried) - len(killed),
        "equivalent": len(mutants) - len(tried),
        "ended_by_limit": sum(row["killed_by"] == "time limit" for row in killed),
    }
    counts = {
        name: {
            "tried": tally.tried,
            "killed": tally.killed,
            "survived": len(tally.violations),
            "open": len(tally.open),
        }
        for name, tally in tallies.items()
    }
    return {
        "seed": seed,
        "rooms": list(rooms),
        "code": digest_of(rooms),
        "counts": counts | {"method": method},
        "survived": {name: list(tally.violations) for name, tally in tallies.items()},
        "open": {name: list(tally.open) for name, tally in tallies.items()},
        "mutants": mutants,
    }


def read_report() -> dict[str, Any] | None:
    """The stored outcome; None where there is none.

    Raises
    ------
    DataFileError
        The file is there but holds none.
    """
    path = report_path()
    if not path.is_file():
        return None
    expected = "an outcome of `make trust-ledger`"
    try:
        found = json.loads(opened(path).read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise DataFileError(path, "file", str(error), expected) from None
    if not isinstance(found, dict) or not {"counts", "rooms", "code", "mutants"} <= found.keys():
        raise DataFileError(path, "file", type(found).__name__, expected)
    return found
