"""Figures 1 and 3 and the ten claims, judged by the order of calls in a traced run."""

from __future__ import annotations

from functools import partial
from itertools import groupby

import pandas as pd

from ...ledger import REGISTRY, Assumed, Is, NoOriginal, Result
from ...view.diagrams import block_diagram, flow_chart
from .flow import place, trace, traced_steps

checks = partial(REGISTRY.checks, page="patent/problem")


@checks(
    "patent.fig01",
    rules=[
        Is("parts", "a run of the code falls into the two parts, in order", to="parts"),
        Is("steps", "with the steps of the text, in the order of the text", to="steps"),
    ],
)
def flow_chart_figure(assumed: Assumed) -> Result:
    """Figure 1 from a traced run: which step ends first, which next."""
    steps = traced_steps()
    groups = [
        (part, [step.text for step in group])
        for part, group in groupby(steps, key=lambda step: step.part)
    ]
    rows = [(step.part, step.text, place(step.code)) for step in steps]
    counts = " and ".join(f"{len(texts)} of {part}" for part, texts in groups)
    return Result(
        obtained={
            "parts": [part for part, _ in groups],
            "steps": [texts for _, texts in groups],
            "returns": len(trace()),
        },
        table=pd.DataFrame(rows, columns=["part", "step", "code"]),
        caption=(
            f"The method as it runs here. Two ticks of the closed loop were traced, {len(trace())} "
            f"returns of functions; in the order in which they first end, its steps are {counts}. "
            "The printed drawing is not in the text edition; the steps are listed in the text, "
            "and the order of the run is compared with that list."
        ),
        alt="Flow chart with a column of boxes for each part of the method, in the order of a "
        "traced run.",
        figure=lambda: flow_chart(rows),
    )


@checks(
    "patent.fig03",
    rules=[
        Is("not_run", "steps of Fig. 1 that the program leaves out", value=0),
        NoOriginal("drawing", "the drawing"),
    ],
)
def device(assumed: Assumed) -> Result:
    """Figure 3: a processor that runs a program kept in a memory, which carries out Figure 1."""
    numbers = REGISTRY.printed("patent.fig03")
    asked = [text for part in REGISTRY.printed("patent.fig01")["steps"] for text in part]
    run = [step.text for step in traced_steps()]
    left_out = [text for text in asked if text not in run]
    return Result(
        obtained={"not_run": len(left_out), "run": run},
        caption=(
            f"Processor {numbers['processor']} runs program {numbers['program']}, kept in memory "
            f"{numbers['memory']}; of the {len(asked)} steps that the text gives the program, a "
            f"traced run leaves out {len(left_out)}. The drawing is not in the text edition, so "
            "it is drawn anew."
        ),
        alt="Block diagram: a device that contains a processor and a memory, with the program in "
        "the memory.",
        figure=lambda: block_diagram(numbers, run),
    )


@checks(
    "patent.claim_claims10",
    rules=[
        Is("details", "claims 2 to 8 detail the steps of a run in order", to="details"),
        Is("method", "claims on the method", to="method"),
        Is("device", "claim on the device", to="device"),
        Is("medium", "claim on the medium", to="medium"),
        Is("claims", "number of claims", to="claims"),
    ],
)
def ten_claims(assumed: Assumed) -> Result:
    """Claim 1 for the whole run, one claim for each traced step, two for device and medium."""
    steps = traced_steps()
    last = 1 + len(steps)
    rows = [(1, "all steps"), *((k, place(s.code)) for k, s in enumerate(steps, start=2))]
    rows += [(last + 1, "all steps"), (last + 2, "all steps")]
    return Result(
        obtained={
            "details": {str(k): step.text for k, step in enumerate(steps, start=2)},
            "method": f"1-{last}",
            "device": str(last + 1),
            "medium": str(last + 2),
            "claims": str(last + 2),
        },
        table=pd.DataFrame(rows, columns=["claim", "code"]),
        caption=(
            f"A traced run ends {len(steps)} steps one after the other. One claim for the whole, "
            f"one for each step in its order and two for device and medium make {last + 2} claims; "
            "the table leads from each to the code that carries it out."
        ),
    )
