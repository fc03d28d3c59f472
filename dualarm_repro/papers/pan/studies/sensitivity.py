"""How far the optimum of `pan` moves when one assumption at a time is changed."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas as pd

from ....ledger import REGISTRY, Study
from ....ledger.assumptions import Chosen, alternatives
from ..document import SEED
from ..reading import PROBLEM, Problem, optimum

_VALUES = 5  # of a range


def cells() -> list[dict[str, Any]]:
    """The declared assumptions, then one of them changed at a time."""
    entries = {key: REGISTRY.declared(f"pan.{key}", "value") for key in PROBLEM}
    changes = [
        {"assumption": key, "value": str(value)}
        for key, entry in entries.items()
        if entry.varies
        for value in alternatives(f"pan.{key}", _VALUES)
        if value != entry.value
    ]
    return [{"assumption": "none", "value": ""}, *changes]


def compute(settings: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """The optimum under one change."""
    values, key = REGISTRY.nominal("pan"), settings["assumption"]
    if key != "none":
        choices = alternatives(f"pan.{key}", _VALUES)
        values[key] = next(v for v in choices if str(v) == settings["value"])
    found = optimum(Problem.of(values))
    position = dict(zip("xyz", map(float, found.position), strict=True))
    return {**position, "fitness": found.fitness}


SENSITIVITY = Study(
    name="pan_sensitivity",
    title="The optimum when one assumption at a time is changed",
    cells=cells,
    compute=compute,
    seed=SEED,
    settings=Chosen("pan", (*PROBLEM, "search_box"), ranges=True),
)
REGISTRY.keeps(SENSITIVITY)


def sensitivity_table() -> pd.DataFrame:
    """Rows of the stored study with the displacement of the optimum, mirror images as one [m]."""
    table = SENSITIVITY.load()
    points = table[["x", "y", "z"]].to_numpy() * 1.0
    points[:, 0] = np.abs(points[:, 0])
    nominal = points[(table["assumption"] == "none").argmax()]
    return table.assign(moved=np.linalg.norm(points - nominal, axis=1))
