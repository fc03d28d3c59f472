"""Figures 1 and 3 and the ten claims: diagrams and a table made from the implementation."""

from __future__ import annotations

from functools import partial

import pandas as pd

from ...ledger import REGISTRY, Assumed, Is, NoOriginal, Result
from ...view.diagrams import block_diagram, flow_chart
from .flow import STEPS, place

checks = partial(REGISTRY.checks, page="patent/problem")

#: Claim to the steps of :data:`.flow.STEPS` it consists of.
CLAIMS: dict[int, tuple[int, ...]] = {
    1: (0, 1, 2, 3, 4, 5, 6),
    2: (0,),
    3: (1,),
    4: (2,),
    5: (3,),
    6: (4,),
    7: (5,),
    8: (6,),
    9: (0, 1, 2, 3, 4, 5, 6),
    10: (0, 1, 2, 3, 4, 5, 6),
}


@checks(
    "patent.fig01",
    rules=[
        Is(
            key="parts",
            to="parts",
            label="the code falls into the two parts of the chart, in order",
        ),
        Is(key="steps", value=[2, 5], label="with the two and the five steps of the text"),
    ],
)
def flow_chart_figure(assumed: Assumed) -> Result:
    """Figure 1 from the functions that carry out its steps."""
    parts = list(dict.fromkeys(step.part for step in STEPS))
    counts = [sum(step.part == part for step in STEPS) for part in parts]
    rows = [(step.part, step.text, place(step.code)) for step in STEPS]
    return Result(
        obtained={"parts": parts, "steps": counts},
        table=pd.DataFrame(rows, columns=["part", "step", "code"]),
        caption=(
            f"The method as it is run here: {counts[0]} steps that state the problem and "
            f"{counts[1]} that solve it, each with the function behind it. The printed drawing is "
            "not in the text edition; its steps are, and every one of them has its code."
        ),
        alt="Flow chart with two columns of boxes: two steps that state the problem, five that "
        "solve it.",
        figure=lambda: flow_chart(rows),
    )


@checks(
    "patent.fig03",
    rules=[
        Is(key="steps_run", value=len(STEPS), label="steps of Fig. 1 that the program carries out"),
        NoOriginal(key="drawing", label="the drawing"),
    ],
)
def device(assumed: Assumed) -> Result:
    """Figure 3: a processor that runs a program kept in a memory."""
    numbers = REGISTRY.printed("patent.fig03")
    runs = sum(callable(step.code) for step in STEPS)
    return Result(
        obtained={"steps_run": runs},
        caption=(
            f"Processor {numbers['processor']} runs program {numbers['program']}, kept in memory "
            f"{numbers['memory']}; the program is the {runs} steps of Fig. 1. Any computer is "
            "such a device, and the drawing is not in the text edition, so there is nothing to "
            "compare."
        ),
        alt="Block diagram: a device that contains a processor and a memory, with the program in "
        "the memory.",
        figure=lambda: block_diagram(numbers, [step.text for step in STEPS]),
    )


@checks(
    "patent.claim_claims10",
    rules=[
        Is(key="claims", value=10, label="claims with code behind them"),
        Is(key="method", value=8, label="of them on the method"),
        Is(key="uncovered", value=0, label="steps that no claim of the method leads to"),
    ],
)
def ten_claims(assumed: Assumed) -> Result:
    """Each claim with the functions that carry it out."""
    covered = {step for claim in range(2, 9) for step in CLAIMS[claim]}
    rows = [
        (claim, "; ".join(place(STEPS[step].code) for step in steps))
        for claim, steps in CLAIMS.items()
    ]
    method = sum(claim <= 8 for claim in CLAIMS)
    return Result(
        obtained={
            "claims": len(CLAIMS),
            "method": method,
            "uncovered": len(set(range(len(STEPS))) - covered),
        },
        table=pd.DataFrame(rows, columns=["claim", "code"]),
        caption=(
            f"{method} claims are on the method, one on a device and one on a storage medium. "
            f"Claims 2 to 8 lead to the {len(covered)} steps one by one; claims 1, 9 and 10 take "
            "them together."
        ),
    )
