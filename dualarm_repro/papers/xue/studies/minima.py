"""Minima of (13) where there is no obstacle: the sum of position and joint term is not convex."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ....arms import load_arm
from ....ledger import REGISTRY, Study
from ....ledger.comparison import Comparison
from ....planning.trials.free_minima import free_minima
from ....scene import PlacedArm
from ..document import gains

PAIRS = 40
BLOCKS = 10
#: Weights of the joint term [m^2/rad^2]; lengths in centimetres act as 1e-4, in millimetres as
#: 1e-6.
WEIGHTS = (1e-6, 1e-4, 1e-2, 0.1, 0.3, 1.0, 3.0, 10.0)
ARRIVED = 0.02  # [rad]
#: |dU/dq| up to which a descent has ended in a minimum.
MINIMUM = 1e-7


def minima_cell(settings: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """Descents from random starts to random goals; how many rest in a minimum elsewhere."""
    placed, weight = PlacedArm("arm", load_arm("es165d")), settings["weight"]
    found = free_minima(placed, gains()["k_a"], weight, PAIRS, rng, arrived=ARRIVED, flat=MINIMUM)
    return {"pairs": PAIRS, **found._asdict()}


def _cells() -> list[dict[str, Any]]:
    return [{"weight": weight, "block": k} for weight in WEIGHTS for k in range(BLOCKS)]


MINIMA = REGISTRY.keeps(
    Study(
        name="xue_minima",
        title="Minima of (13) without obstacles, over the weight of the joint term",
        cells=_cells,
        compute=minima_cell,
        compared=tuple(
            Comparison(name, "one descent may end on the other side", absolute=1)
            for name in ("minima", "elsewhere")
        ),
        seed=20200347,
        settings={"pairs": PAIRS, "weights": WEIGHTS, "arrived": ARRIVED, "flat": MINIMUM},
    )
)
