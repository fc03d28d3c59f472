"""Write outcomes of items, spots of studies and the machine code of both to a JSON file.

    python tools/portable_outcomes.py FILE CELLS JOBS [ID...]

CELLS of every stored study are computed again, by JOBS workers, and compared with what is stored.

`verify_portable.py` and `determinism.py` run this in a process of its own for each of their
settings.
"""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path
from typing import Any

from machine_code import FUSED, fuse_kernels, probe

SEED = 20200344


def main(path: str, cells: str, jobs: str, *item_ids: str) -> None:
    """Compute items and cells; kernels are compiled on import, so how is settled before."""
    if os.environ.get(FUSED):
        fuse_kernels()
    from dualarm_repro.ledger.workers import results
    from dualarm_repro.papers import load

    names = list(load().studies) if int(cells) else []
    spots = ((_spot, name, int(cells)) for name in names)
    checked = list(results(spots, len(names), "studies", int(jobs)))
    items = ((_item, key, None) for key in item_ids)
    kept = results(items, len(item_ids), "items", int(jobs))
    made = {
        "machine": probe(),
        "items": dict(zip(item_ids, kept, strict=True)),
        "cells": sum(count for count, _, _ in checked),
        "wrong": [line for _, wrong, _ in checked for line in wrong],
        "unsettled": [line for _, _, unsettled in checked for line in unsettled],
    }
    Path(path).write_text(json.dumps(made), encoding="utf-8")


def _item(item_id: str, _: None) -> Any:
    """The registry is loaded where it is needed, since functions of another process's are not."""
    from dualarm_repro.ledger.reference import outcome
    from dualarm_repro.papers import load

    return outcome(load(), item_id)


def _spot(name: str, cells: int) -> tuple[Any, ...]:
    from dualarm_repro.ledger.spot import spot_check
    from dualarm_repro.papers import load

    return spot_check(load().studies[name], cells, SEED)[1:]


if __name__ == "__main__":
    main(*sys.argv[1:])
