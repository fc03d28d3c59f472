"""Write outcomes of items, spots of studies and the machine code of both to a JSON file.

    python tools/portable_outcomes.py FILE CELLS [ID...]

CELLS of every stored study are computed again and compared with what is stored.

`verify_portable.py` runs this in a process of its own for each of its settings.
"""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path

from machine_code import FUSED, fuse_kernels, probe

SEED = 20200344


def main(path: str, cells: str, *item_ids: str) -> None:
    """Compute items and cells; kernels are compiled on import, so how is settled before."""
    if os.environ.get(FUSED):
        fuse_kernels()
    from dualarm_repro.ledger.reference import outcome
    from dualarm_repro.ledger.spot import spot_check
    from dualarm_repro.papers import load

    registry = load()
    studies = registry.studies.values() if int(cells) else ()
    checked = [spot_check(study, int(cells), SEED) for study in studies]
    made = {
        "machine": probe(),
        "items": {key: outcome(registry, key) for key in item_ids},
        "cells": sum(spot.cells for spot in checked),
        "wrong": [line for spot in checked for line in spot.wrong],
        "unsettled": [line for spot in checked for line in spot.unsettled],
    }
    Path(path).write_text(json.dumps(made), encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
