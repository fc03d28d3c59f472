"""Compute a stored study of a few small cells below the working folder, or tell how it stands."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from dualarm_repro.ledger import Study, study

CELLS, DRAWS = 24, 2_000_000


def cells() -> list[dict[str, Any]]:
    """Settings of the cells."""
    return [{"k": k} for k in range(CELLS)]


def compute(settings: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """A mean of random numbers, which takes a few milliseconds."""
    return {"mean": settings["k"] + float(rng.random(DRAWS).mean())}


def main(arguments: list[str]) -> int:
    """Compute it; with ``status`` or ``load``, tell whether what is stored can be trusted."""
    results = Path("out").resolve()
    study.data_path = lambda *parts: results.joinpath(*parts[1:])
    tiny = Study(name="tiny", title="Means", cells=cells, compute=compute, seed=3)
    if arguments == ["status"]:
        print(tiny.status())
    else:
        tiny.run()
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
