"""Compute results again in other circumstances and count what comes out the same.

Every item, and some cells of every stored study, are computed in a process of their own and
compared with data/results by the rule that each declares: with one worker and two, other threads
of the linear algebra, another seed of Python's hashes, an empty cache and then a warm one, the tree
in another folder. ``data/results/determinism.json`` holds the counts and what came out otherwise.
Ends with 1 if anything did.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from tree_copy import copy_tree
from verify_portable import CELLS, SEED, compare, computed

from dualarm_repro.ledger.files import to_json, write_text
from dualarm_repro.papers import load

ROOT = Path(__file__).resolve().parents[1]
STORED = ROOT / "data" / "results" / "determinism.json"
#: What a tree needs to compute its results.
TREE = ("dualarm_repro", "data", "tools", "pyproject.toml", "CITATION.cff")
FOLDER = "another folder"
_THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


@dataclass(frozen=True)
class Circumstance:
    """Environment variables, worker processes, and whether the tree is a copy elsewhere, which has
    a cache of its own."""

    environment: Mapping[str, str] = field(default_factory=dict)
    jobs: int = 1
    elsewhere: bool = False


#: The first one fills the cache that most of the others share.
CIRCUMSTANCES = {
    "empty cache": Circumstance(),
    "warm cache": Circumstance(),
    "two workers": Circumstance(jobs=2),
    "two threads of the linear algebra": Circumstance(dict.fromkeys(_THREADS, "2")),
    "another seed of hashes": Circumstance({"PYTHONHASHSEED": "4242"}),
    FOLDER: Circumstance(elsewhere=True),
}


def outcomes(
    one: Circumstance, item_ids: Sequence[str], cells: int, scratch: Path
) -> dict[str, Any]:
    """What a process gives in a circumstance, see `portable_outcomes.py`.

    Raises
    ------
    RuntimeError
        The process failed.
    """
    root = copy_tree(ROOT, TREE, scratch / "a tree") if one.elsewhere else ROOT
    usual = {"PYTHONHASHSEED": "0", **dict.fromkeys(_THREADS, "1"), "MPLBACKEND": "agg"}
    cache = scratch / ("cache elsewhere" if one.elsewhere else "cache")
    own = {"PYTHONPATH": str(root), "DUALARM_CACHE": str(cache)}
    environment = {**usual, **own, **one.environment}
    return computed(root, environment, item_ids, cells, one.jobs, scratch / "made.json")


def counted(found: Mapping[str, Mapping[str, Any]]) -> dict[str, Any]:
    """Of each circumstance how many items and cells were compared and how many came out otherwise,
    and the lines about these; values that round-off of the inputs moves too are no difference."""
    counts, otherwise = {}, {}
    for name, made in found.items():
        drifted, changed = compare(made["items"])
        lines = [*drifted, *changed, *made["wrong"]]
        if lines:
            otherwise[name] = lines
        number = {"items": len(made["items"]), "cells": made["cells"], "otherwise": len(lines)}
        counts[name] = number
    return {"seed": SEED, "counts": counts, "otherwise": otherwise}


def compared(
    names: Iterable[str], item_ids: Sequence[str], cells: int, scratch: Path
) -> dict[str, Any]:
    """Go through circumstances, telling each, and count."""
    found = {}
    for name in names:
        found[name] = outcomes(CIRCUMSTANCES[name], item_ids, cells, scratch)
        number = counted({name: found[name]})["counts"][name]
        told = ", ".join(f"{count} {what}" for what, count in number.items())
        print(f"{name}: {told}", flush=True)
    return counted(found)


def main(arguments: Sequence[str] | None = None) -> int:
    """Compare; only everything together is stored."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("ids", nargs="*", help="items; default: all")
    parser.add_argument("--in", action="append", dest="names", help="only this circumstance")
    parser.add_argument("--cells", type=int, default=CELLS, help="of every stored study")
    parser.add_argument("--out", type=Path, default=None, help="file to write")
    asked = parser.parse_args(arguments)
    names = asked.names or list(CIRCUMSTANCES)
    if unknown := set(names) - set(CIRCUMSTANCES):
        parser.error(f"no circumstance {sorted(unknown)}; there are {', '.join(CIRCUMSTANCES)}")
    with TemporaryDirectory(prefix="determinism-") as folder:
        ids = asked.ids or list(load().items)
        found = compared(names, ids, asked.cells, Path(folder))
    if asked.out or not (asked.ids or asked.names):
        write_text(asked.out or STORED, to_json(found))
    for name, lines in found["otherwise"].items():
        print("\n".join(f"  {name}: {line}" for line in lines))
    return int(bool(found["otherwise"]))


if __name__ == "__main__":
    sys.exit(main())
