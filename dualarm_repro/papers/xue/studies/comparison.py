"""What a fair comparison of both methods needs beside the lottery: starts in contact, tool paths.

A perturbed start that touches an obstacle is a miss of the planner, though no method could do
anything about it; and the five points of (14) touch where the end effector alone does not. The
starts are drawn again, as the lottery drew them, so that such arrangements can be left out.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict
from typing import Any

import numpy as np

from ....errors import LedgerError
from ....ledger import REGISTRY, Study
from ....ledger.assumptions import Chosen
from ....ledger.streams import stream
from ....planning.trials.runs import attempt, touching
from ..outcomes import DESCENTS, TRIALS, VARIANTS, starts
from ..reading import KEPT, nominal
from .lottery import LAYOUTS, LOTTERY, draw, lottery_table


def comparison_cell(settings: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """Starts in contact of the end effector and of five points, and tool paths from the one start.

    The stream of the lottery's cell is used in place of ``rng``.

    Raises
    ------
    LedgerError
        The arrangement drawn again is not the one of the lottery.
    """
    stored = lottery_table().iloc[settings["layout"]]
    own, given = stream(LOTTERY.seed, settings["layout"]), nominal()
    for _ in range(int(stored["draws"])):
        layout = draw(own, given)
    if any(stored[name] != drawn for name, drawn in asdict(layout).items()):
        raise LedgerError(f"arrangement {settings['layout']} is not the one of {LOTTERY.name}")
    case = given._replace(layout=layout)
    begin = starts(case, float(stored["trial_perturbation"]), TRIALS, own)
    row: dict[str, Any] = {}
    for points, name in (("end_effector", "traditional"), ("five_points", "improved")):
        made = VARIANTS[name].problem(case)
        plan = attempt(made.placed, made.start, made.obstacles, made.settings)
        lengths = (plan.tcp_length, plan.length) if plan and plan.reached else (np.nan, np.nan)
        row[f"touching_{points}"] = int(touching(made, begin).sum())
        row[f"{name}_tool_path"], row[f"{name}_joint_path"] = lengths
    return row


def _cells() -> list[dict[str, Any]]:
    return [{"layout": k} for k in range(LAYOUTS)]


COMPARISON = REGISTRY.keeps(
    Study(
        name="xue_comparison",
        title="Random arrangements: starts of the trials in contact, paths of both methods",
        cells=_cells,
        compute=comparison_cell,
        compared=DESCENTS,
        seed=20200348,
        settings=Chosen("xue", KEPT, ranges=True, trials=TRIALS),
    )
)
