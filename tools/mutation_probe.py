"""Compute stored cells and items again, inside a copy of the tree, and say where they differ.

One JSON line a check. ``{"cells": null, "items": null}`` on standard input tries a few of
everything and names the modules each rests on; lists of names try those and stop at the first
difference.
"""

from __future__ import annotations

import json
import resource
import signal
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from time import process_time
from typing import Any

import numpy as np

sys.path.insert(0, str(Path.cwd()))

from dualarm_repro.errors import LedgerError
from dualarm_repro.ledger import Registry, evaluate
from dualarm_repro.ledger.closure import closure, hash_file
from dualarm_repro.ledger.drift import differences
from dualarm_repro.ledger.files import through_json
from dualarm_repro.ledger.reference import declared, read_reference
from dualarm_repro.papers import load

#: Cells of each study that are tried, and CPU seconds after which a check is too dear.
CELLS, DEAR = 2, 30
SEED = 20200344


class TooDear(Exception):
    """A check took more than its share of time."""


def main() -> None:
    """Run the checks that are asked for."""
    asked = json.load(sys.stdin)
    resource.setrlimit(resource.RLIMIT_CPU, (asked["limit"], asked["limit"] + 5))
    signal.signal(signal.SIGPROF, _stop)
    registry = load()
    stop = asked["cells"] is not None
    for check in (*_cells(registry, asked["cells"]), *_items(registry, asked["items"])):
        kind, name, index, modules, run = check
        start = process_time()
        signal.setitimer(signal.ITIMER_PROF, 0 if stop else DEAR)
        try:
            lines = run()
        except LedgerError:  # what it loads is stale, since the sources changed
            lines = None
        except TooDear:
            lines = None
        except Exception as error:
            lines = [f"{type(error).__name__}: {error}"[:120]]
        signal.setitimer(signal.ITIMER_PROF, 0)
        row = {"kind": kind, "name": name, "index": index, "differs": lines}
        row |= {"seconds": round(process_time() - start, 2), "modules": [] if stop else modules()}
        print(json.dumps(row), flush=True)
        if stop and lines:
            return


def _stop(*_: Any) -> None:
    raise TooDear


Check = tuple[str, str, int, Callable[[], list[str]], Callable[[], list[str]]]


def _cells(registry: Registry, asked: list[list[Any]] | None) -> Iterator[Check]:
    import pandas as pd

    if asked == []:
        return
    rng = np.random.default_rng(SEED)
    for name, study in registry.studies.items():
        if study.missing_peers() or not study.table_path.is_file():
            continue
        cells = study.cells()
        if asked is None:
            if hash_file(study.table_path) != study.meta()["table_sha256"]:
                continue
            chosen = sorted(int(k) for k in rng.choice(len(cells), CELLS, replace=False))
        else:
            chosen = [k for other, k in asked if other == name]
        table = pd.read_parquet(study.table_path) if chosen else None
        for k in chosen:

            def run(study=study, k=k, cells=cells, table=table) -> list[str]:
                made = study.cell(k, cells[k])
                stored = table.iloc[k].reindex(made).to_dict()
                return study.differs(stored, made)

            yield "cell", name, k, lambda study=study: study.code["modules"], run


def _items(registry: Registry, asked: list[str] | None) -> Iterator[Check]:
    for item_id in registry.checkers if asked is None else asked:
        reference = read_reference(item_id.partition(".")[0]).get(item_id, {})

        def run(item_id=item_id, reference=reference) -> list[str] | None:
            evaluation = evaluate(registry, item_id)
            if any(name.startswith("results/") for name in evaluation.inputs):
                return None
            made = through_json({"obtained": evaluation.result.obtained})
            stored = {"obtained": reference.get("obtained")}
            return differences(stored, made, declared(registry, item_id))

        def modules(item_id=item_id) -> list[str]:
            return list(closure([registry.checker(item_id).compute]).modules)

        yield "item", item_id, 0, modules, run


if __name__ == "__main__":
    main()
