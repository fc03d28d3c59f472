"""The network in real time: operations of a whole step in its period, and what the rate costs."""

from __future__ import annotations

from functools import partial

import pandas as pd

from .....control.motion import Motion
from .....control.neural.fixed_step import simulate_network
from .....control.neural.network_settings import NetworkSettings
from .....control.neural.single_precision import simulate_in_single_precision
from .....control.settings import ControllerSettings
from .....ledger import REGISTRY, Assumed, Bounded, Is, Result
from .....ledger.captions import captions
from .....tracking import memo
from .....view.rate_figure import rate_figure
from ...document import frozen
from ..avoidance.frozen_tasks import step_operations

checks = partial(REGISTRY.checks, page="patent/contest")
caption = captions(__file__)
#: Gains [1/s] and steps [s] of the map.
GAINS = (1.0, 10.0, 80.0)
STEPS = (0.001, 0.002, 0.005, 0.01, 0.02, 0.05)


@checks(
    "patent.claim_real_time",
    samples=16,
    rules=[
        Bounded("period_share", "operations of a whole step, share of its period", high=1),
        Bounded("tip_error_share", "largest tip error over the bound on it", high=1),
        Bounded("shortfall", "the distance falls short of d2 by at most [m]", high="resolution"),
        Is("completed", "the motion breaks no bound", value=True),
    ],
)
def in_real_time(assumed: Assumed) -> Result:
    """Closed loop of the network at a fixed rate, in the precision of the processor."""
    dt, settings = assumed["time_step"], ControllerSettings()
    motion = _motion(10.0, dt, assumed["arithmetic"])
    operations = step_operations(settings, assumed["function_cost"])["network"]
    rows = [(gamma, step, *_measures(_motion(gamma, step))) for gamma in GAINS for step in STEPS]
    table = pd.DataFrame(
        rows, columns=["gamma [1/s]", "step [s]", "tip error [m]", "distance [m]", "completed"]
    )
    return Result(
        obtained={
            "period_share": operations / assumed["operation_rate"] / dt,
            "operations": operations,
            "tip_error": motion.largest_error,
            "tip_error_share": motion.largest_error / assumed["accuracy_bound"],
            "shortfall": settings.inner - motion.smallest_distance,
            "completed": motion.completed,
        },
        table=table,
        caption=caption(
            "claim_real_time",
            **{"assumed": assumed, "dt": dt, "shortest": STEPS[0], "longest": STEPS[-1]},
            worst=float(table["tip error [m]"].max()),
            nearest=float(table["distance [m]"].min()),
        ),
        alt="Largest tip error over the step, in proportion to it, alike for three gains.",
        figure=lambda: rate_figure(table, assumed["accuracy_bound"]),
    )


@memo(64)
def _motion(gamma: float, dt: float, arithmetic: str = "double") -> Motion:
    run = simulate_network if arithmetic == "double" else simulate_in_single_precision
    return run(*frozen("crossing").parts, ControllerSettings(), NetworkSettings(gamma=gamma), dt=dt)


def _measures(motion: Motion) -> tuple[float, float, bool]:
    return motion.largest_error, motion.smallest_distance, motion.completed
