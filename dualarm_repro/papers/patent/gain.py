"""The claim that a growing gain converges faster."""

from __future__ import annotations

from functools import partial

import numpy as np
import pandas as pd

from ...control.neural.activation import SLOPE_AT_ZERO
from ...control.neural.fixed_step import divergence_time as stability_end
from ...control.neural.network import network_rate
from ...control.neural.network_settings import NetworkSettings
from ...ledger import REGISTRY, Assumed, Bounded, Result
from ...view.control_figures import decay_figure
from .constants import CONTROL_STEP, SEED
from .penalised import code_error, sample_problem, state_with_error

checks = partial(REGISTRY.checks, page="patent/network")
GAINS = (1.0, 10.0, 80.0)
_KINDS = ("growing", "start", "ceiling")
START = 0.1  # size of the error at the start of a decay
HORIZON = 6.0  # [s] after which gamma = 1 has reached most of its ceiling


@checks(
    "patent.claim_gain_time_varying",
    samples=32,
    rules=[
        Bounded(
            "sooner",
            "the growing gain is below the threshold earlier by [s], at least one step",
            low="one_step",
        ),
    ],
)
def growing_gain(assumed: Assumed) -> Result:
    """Time until the error stays below the threshold, with growing and with constant gain."""
    threshold, own = assumed["convergence_threshold"], assumed["gain"]
    activation, rival = assumed["activation"], assumed["compared_gain"]
    curves = {
        (g, kind): _decay(activation, g, kind) for g in sorted({*GAINS, own}) for kind in _KINDS
    }
    found = {key: _settled(errors, threshold) for key, errors in curves.items()}
    ceiling = gain_ceiling(activation)
    words = {"start": f"gamma = {own:g} 1/s throughout", "ceiling": f"{ceiling:g} 1/s throughout"}
    sooner = found[own, rival] - found[own, "growing"]
    drawn = {
        f"{label}, gamma = {g:g}": (CONTROL_STEP * np.arange(len(curves[g, kind])), curves[g, kind])
        for g in GAINS
        for label, kind in (("growing gain", "growing"), ("constant gain", "start"))
    }
    drawn["constant gain of the same ceiling"] = (
        CONTROL_STEP * np.arange(len(curves[own, "ceiling"])),
        curves[own, "ceiling"],
    )
    return Result(
        obtained={
            "sooner": sooner,
            "growing_s": found[own, "growing"],
            "constant_s": found[own, "start"],
            "ceiling_s": found[own, "ceiling"],
            "ceiling": ceiling,
        },
        table=pd.DataFrame(
            [(g, *(found[g, kind] for kind in _KINDS)) for g in sorted({*GAINS, own})],
            columns=["gamma [1/s]", "growing [s]", "constant gamma [s]", "constant ceiling [s]"],
        ),
        caption=(
            f"From an error of {START:g} the network of fixed step is below {threshold:g} for good "
            f"after {_text(found[own, 'growing'])} with the growing gain (gamma = {own:g}, "
            f"{activation}), after {_text(found[own, 'start'])} with gamma constant, and after "
            f"{_text(found[own, 'ceiling'])} with the constant gain of the same ceiling, "
            f"{ceiling:g} 1/s, beyond which the step allows no growth. Compared with "
            f"{words[rival]}, the growing gain is "
            f"{'sooner' if sooner >= CONTROL_STEP else 'not sooner'}. Which constant gain is meant "
            "is not printed. Without that ceiling explicit steps become unstable after "
            f"{', '.join(f'{stability_end(g, CONTROL_STEP):.1f}' for g in GAINS)} s for gamma = "
            f"{', '.join(f'{g:g}' for g in GAINS)}."
        ),
        alt="Decay of the error over time for three gains, growing and constant, and for the "
        "constant gain of the same ceiling, which falls first.",
        figure=lambda: decay_figure(drawn, threshold),
    )


def gain_ceiling(activation: str) -> float:
    """Largest gain that the fixed step allows, 1 / (step Psi'(0)) [1/s]."""
    slope = SLOPE_AT_ZERO[activation]
    return 1.0 / (CONTROL_STEP * (slope if 0.0 < slope < np.inf else 1.0))


def _decay(activation: str, gamma: float, kind: str) -> np.ndarray:
    """|F|_inf before every explicit step on the problem that stands still."""
    network, p = NetworkSettings(activation=activation), sample_problem()
    numbers, ceiling = network.numbers(), gain_ceiling(activation)
    size = p.size + len(p.b)
    still, rate = np.zeros(size), np.empty(size)
    y = state_with_error(p, network, np.random.default_rng(SEED).uniform(-START, START, size))
    errors = []
    for step in range(round(HORIZON / CONTROL_STEP)):
        errors.append(float(np.abs(code_error(p, network, y)).max()))
        grown = gamma * np.exp(step * CONTROL_STEP) if kind == "growing" else gamma
        gain = ceiling if kind == "ceiling" else min(grown, ceiling)
        network_rate(numbers, gain, still, p.parts, y, rate)
        y = y + CONTROL_STEP * rate
        if not errors[-1] < 1e6 or errors[-1] < _DONE:
            break
    return np.array(errors)


_DONE = 1e-9  # error below every declared threshold, after which nothing is left to see


def _settled(errors: np.ndarray, threshold: float) -> float:
    """When the error is below the threshold for good; the horizon if it is not [s]."""
    above = np.flatnonzero(~(errors <= threshold))
    steps = int(above[-1]) + 1 if len(above) else 0
    return HORIZON if steps >= len(errors) else CONTROL_STEP * steps


def _text(seconds: float) -> str:
    return f"{seconds:.3f} s" if seconds < HORIZON else f"more than {HORIZON:g} s"
