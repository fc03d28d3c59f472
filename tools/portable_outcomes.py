"""Write the outcomes of items, and the machine code that computed them, to a JSON file.

    python tools/portable_outcomes.py FILE [ID...]

`verify_portable.py` runs this in a process of its own for each of its settings.
"""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path

from machine_code import FUSED, fuse_kernels, probe


def main(path: str, *item_ids: str) -> None:
    """Compute the items; kernels are compiled on import, so how is settled before."""
    if os.environ.get(FUSED):
        fuse_kernels()
    from dualarm_repro.ledger.reference import outcome
    from dualarm_repro.papers import load

    registry = load()
    made = {"machine": probe(), "items": {key: outcome(registry, key) for key in item_ids}}
    Path(path).write_text(json.dumps(made), encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
