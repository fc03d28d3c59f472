"""Figures 1 and 3 and the ten claims, judged by the order of calls in a traced run."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from itertools import groupby
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from .....control import assembly, avoidance, kinematics
from .....control.neural import fixed_step, network, optimality, penalty
from .....control.neural.network_settings import NetworkSettings
from .....control.readings import Readings
from .....control.settings import ControllerSettings
from .....control.simulate import UNDISTURBED
from .....instrument import Instrument
from .....ledger import REGISTRY, Assumed, Is, NoOriginal, Result
from .....ledger.captions import captions
from .....tracking import memo
from .....view.diagrams import block_diagram, flow_chart
from ...document import CONTROL_STEP, frozen

checks = partial(REGISTRY.checks, page="patent/problem")
caption = captions(__file__)


class Step(NamedTuple):
    """One step: part of the flow chart, what it does, and the function whose return ends it."""

    part: str
    text: str
    code: Callable[..., Any]


STATEMENT, SOLUTION = "problem statement and indices", "conversion and solution"
STEPS = (
    Step(STATEMENT, "inverse kinematics at velocity level", kinematics.tip_jacobian),
    Step(STATEMENT, "indices of energy, joint limits and avoidance", avoidance.fill_rows),
    Step(SOLUTION, "QP under equalities and inequalities", assembly.state),
    Step(SOLUTION, "penalty to a QP under equalities only", penalty.penalty),
    Step(SOLUTION, "Lagrange to a matrix equation", optimality.optimality),
    Step(SOLUTION, "neural network solves it", network.state_rate),
    Step(SOLUTION, "integration to joint angles", fixed_step.run_network),
)


@memo()
def trace() -> tuple[str, ...]:
    """Names of the functions in the order of their returns in two ticks of the closed loop.

    The run starts inside the inner range, so that avoidance rows are present.
    """
    scenario, numbers = frozen("too_close"), ControllerSettings().numbers()
    system, instrument = scenario.system, Instrument()
    size = system.nq + 3 * len(system.arms)
    instrument.twin(fixed_step.run_network)(
        *(system.arrays, numbers, NetworkSettings().numbers(CONTROL_STEP)),
        *(scenario.circles.numbers(), scenario.q0, np.zeros(size), 2, CONTROL_STEP),
        *(Readings.of(system), UNDISTURBED),
    )
    return tuple(instrument.returned)


def traced_steps() -> list[Step]:
    """The steps that the run carries out, in the order in which it first ends them."""
    returned = trace()
    done = [step for step in STEPS if name(step) in returned]
    return sorted(done, key=lambda step: returned.index(name(step)))


def name(step: Step) -> str:
    """Name of the function of a step."""
    return step.code.__name__


def place(code: Callable[..., Any]) -> str:
    """Module and name of a function within the package."""
    module = code.__module__.partition(".")[2]
    return f"{module}.{code.__name__}"


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
    return Result(
        obtained={
            "parts": [part for part, _ in groups],
            "steps": [texts for _, texts in groups],
        },
        table=pd.DataFrame(rows, columns=["part", "step", "code"]),
        caption=caption("fig01", groups=groups),
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
        caption=caption("fig03", numbers=numbers, asked=len(asked)),
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
