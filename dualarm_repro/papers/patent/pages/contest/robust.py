"""More robust than the primal-dual network: against what, and by which measure."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
import pandas as pd
from scipy.stats import t as student

from .....control.motion import Motion
from .....control.neural.fixed_step import simulate_network
from .....control.neural.network_settings import NetworkSettings
from .....control.neural.primal_dual import simulate_primal_dual
from .....control.readings import Readings
from .....control.settings import ControllerSettings
from .....ledger import REGISTRY, Assumed, Exceeds, Result
from .....ledger.captions import captions
from .....ledger.witnesses import one_for_each_side
from .....tracking import memo
from ...document import CONTROL_STEP, SEED, frozen, run
from ...reading import network_settings

checks = partial(REGISTRY.checks, page="patent/contest")
caption = captions(__file__)
#: Kind of disturbance to the assumption that says how large it is.
SIZES = {
    "state": "noise_amplitude",
    "readings": "reading_noise",
    "model": "model_error",
    "delay": "reading_delay",
}
_TOLD = {
    "state": "a constant push on the state equation",
    "readings": "noisy distances",
    "model": "wrong joint angles, and so a wrong model",
    "delay": "late joint angles",
}
#: Independent disturbances of each kind.
REPEATS = 4


def _late(motion: Motion) -> float:
    """Median tip error over the second half of the path, when the gain has grown [m]."""
    half = len(motion.error) // 2
    return float(np.median(motion.error[half:].max(axis=1)))


def _left(motion: Motion, calm: Motion) -> float:
    """Late error under a disturbance, as published; 0 where the disturbance hardly changes it,
    since what is left is then the error of the calm motion."""
    own, other = _late(motion), _late(calm)
    return own if abs(own - other) > _noticeable() * other else 0.0


#: Measure to what a disturbance adds to it; errors and distances are compared instant by instant,
#: since the extremes of two motions lie at different times and hide what came between.
MEASURES: dict[str, Callable[[Motion, Motion], float]] = {
    "largest_tip_error": lambda motion, calm: float((motion.error - calm.error).max()),
    "late_tip_error": lambda motion, calm: _late(motion) - _late(calm),
    "late_residual": _left,
    "smallest_distance": lambda motion, calm: float((calm.distance - motion.distance).max()),
    "peak_acceleration": lambda motion, calm: motion.peak_acceleration - calm.peak_acceleration,
}


_RULE = Exceeds(
    "advantage",
    "what the disturbance adds with the primal-dual network less that with the network, by their "
    "sum",
    threshold="noticeable",
)


@checks("patent.claim_robust", samples=8, rules=[_RULE])
def more_robust(assumed: Assumed) -> Result:
    """Both networks under a disturbance of the assumed kind, each against its own calm motion."""
    return _compared(assumed, assumed["disturbance"], "claim_robust")


@checks("patent.claim_robust_state", samples=8, rules=[_RULE])
def more_robust_against_a_push(assumed: Assumed) -> Result:
    """A constant push on the state equation, and the same for other gains."""
    result = _compared(assumed, "state", "claim_robust_state")
    count, size = round(assumed["primal_dual_network"]), assumed["noise_amplitude"]
    calm, pushed = _primal_dual(count, "none", 0.0, 0), _primal_dual(count, "state", size, 0)
    sweep = {"primal_dual": _both(pushed, calm)}
    for name, network in SWEEP.items():
        sweep[name] = _both(_network(network, "state", size, 0), _network(network, "none", 0.0, 0))
    return replace(result, obtained={**result.obtained, "sweep": sweep})


@checks("patent.claim_robust_readings", samples=8, rules=[_RULE])
def more_robust_against_noise(assumed: Assumed) -> Result:
    """White noise on the distances that the controller reads."""
    return _compared(assumed, "readings", "claim_robust_readings")


@checks("patent.claim_robust_model", samples=8, rules=[_RULE])
def more_robust_against_a_wrong_model(assumed: Assumed) -> Result:
    """Joint angles that are off, and with them the forward map, its Jacobian and the distances."""
    return _compared(assumed, "model", "claim_robust_model")


@checks("patent.claim_robust_delay", samples=8, rules=[_RULE])
def more_robust_against_delay(assumed: Assumed) -> Result:
    """Joint angles that are late."""
    return _compared(assumed, "delay", "claim_robust_delay")


#: Gains of the networks that are pushed: growing from three values, and the ceiling throughout.
SWEEP = {
    **{f"growing_{gamma}": NetworkSettings(gamma=gamma) for gamma in (10, 40, 80)},
    "constant": NetworkSettings(gamma=1.0 / CONTROL_STEP, growing=False),
}


def _both(pushed: Motion, calm: Motion) -> dict[str, float]:
    """What a push adds to the tip error at most, and what is left late in the motion [m]."""
    measures = {"peak": "largest_tip_error", "late": "late_residual"}
    return {key: _added(pushed, calm, measure) for key, measure in measures.items()}


def _compared(assumed: Assumed, kind: str, block: str) -> Result:
    declared = [n for n in ("gain", "gain_cap", "penalty_form") if n in _assumptions(block)]
    network = network_settings(assumed, *declared)
    measure = assumed["robustness_measure"]
    count, size = round(assumed["primal_dual_network"]), assumed[SIZES[kind]]
    repeats = 1 if kind == "delay" else REPEATS
    runs = {
        (name, number): motion
        for number in range(repeats)
        for name, motion in _motions(network, count, kind, size, number).items()
    }
    calm = _motions(network, count, "none", 0.0, 0)
    added = {
        name: [_added(runs[name, k], calm[name], measure) for k in range(repeats)]
        for name in ("network", "primal-dual")
    }
    shares = [_share(a, b) for a, b in zip(added["network"], added["primal-dual"], strict=True)]
    own, other = (float(np.median(added[name])) for name in ("network", "primal-dual"))
    rows = [("none", name, 0, *_row(motion)) for name, motion in calm.items()]
    rows += [(kind, name, k, *_row(motion)) for (name, k), motion in runs.items()]
    return Result(
        obtained={
            "advantage": _interval(shares),
            "added_network": own if np.isfinite(own) else None,
            "added_primal_dual": other if np.isfinite(other) else None,
        },
        witnesses=one_for_each_side(
            (f"repeat {k}", share > _noticeable(), {"advantage": share})
            for k, share in enumerate(shares)
        ),
        table=pd.DataFrame(rows, columns=["disturbance", "solver", "repeat", *_COLUMNS]),
        caption=caption(
            block,
            **{"kind": kind, "measure": measure, "repeats": repeats, "own": own, "other": other},
            told=_TOLD,
            noticeable=_noticeable(),
        ),
    )


def _assumptions(block: str) -> list[str]:
    return REGISTRY.look(f"patent.{block}", "assumptions").assumptions


_COLUMNS = (
    "finished", "distance [m]", "tip error [m]", "late tip error [m]",
    "peak acceleration [rad/s^2]",
)  # fmt: skip


def _row(motion: Motion) -> tuple[bool, float, float, float, float]:
    return (
        motion.finished,
        motion.smallest_distance,
        motion.largest_error,
        _late(motion),
        motion.peak_acceleration,
    )


def _motions(
    network: NetworkSettings, count: int, kind: str, size: float, number: int
) -> dict[str, Motion]:
    """Motions of both networks, and of the exact QP where the readings are disturbed."""
    found = {
        "network": _network(network, kind, size, number),
        "primal-dual": _primal_dual(count, kind, size, number),
    }
    return found if kind == "state" else {**found, "exact QP": _exact(kind, size, number)}


@memo(64)
def _network(network: NetworkSettings, kind: str, size: float, number: int) -> Motion:
    parts, disturbed = frozen("crossing").parts, _disturbed(kind, size, number)
    return simulate_network(*parts, ControllerSettings(), network, **disturbed)


@memo(64)
def _primal_dual(count: int, kind: str, size: float, number: int) -> Motion:
    parts, disturbed = frozen("crossing").parts, _disturbed(kind, size, number)
    return simulate_primal_dual(*parts, ControllerSettings(), iterations=count, **disturbed)


@memo(64)
def _exact(kind: str, size: float, number: int) -> Motion:
    return run(frozen("crossing"), ControllerSettings(), **_disturbed(kind, size, number))


def _disturbed(kind: str, size: float, number: int) -> dict[str, Any]:
    """Arguments of a run: a constant push of random signs on the state, white noise on the
    distances, angles off by random signs, or angles that are late (the same every time)."""
    scenario = frozen("crossing")
    steps, system = round(scenario.period / CONTROL_STEP), scenario.system
    rng = np.random.default_rng([SEED, number])
    if kind == "state":
        signs = rng.choice([-1.0, 1.0], system.nq + 3 * len(system.arms))
        return {"disturbance": np.tile(size * signs, (steps, 1))}
    if kind == "readings":
        noise = size * rng.standard_normal((steps, len(system.arrays.pairs)))
        return {"readings": Readings.of(system, noise=noise)}
    if kind == "model":
        offset = size * rng.choice([-1.0, 1.0], system.nq)
        return {"readings": Readings.of(system, offset=offset)}
    if kind == "delay":
        return {"readings": Readings.of(system, delay=round(size / CONTROL_STEP))}
    return {}


def _noticeable() -> float:
    """Relative difference from which on an effect counts as another."""
    return REGISTRY.look("patent.claim_robust", "thresholds").thresholds["noticeable"].value


def _added(motion: Motion, calm: Motion, measure: str) -> float:
    """What a disturbance adds, or what is left under it; infinite for a motion that breaks down."""
    if not motion.finished:
        return np.inf
    return max(MEASURES[measure](motion, calm), 0.0)


def _share(own: float, other: float) -> float:
    """(other - own) / (other + own) in [-1, 1]."""
    if own == other:
        return 0.0
    if np.isinf(own) or np.isinf(other):
        return -1.0 if np.isinf(own) else 1.0
    return (other - own) / (other + own)


def _interval(values: list[float]) -> dict[str, float]:
    """Mean with its 95 % interval by Student's t; a single value is all there is."""
    if len(values) == 1:
        return dict.fromkeys(("value", "low", "high"), float(values[0]))
    mean, spread = float(np.mean(values)), float(np.std(values, ddof=1))
    half = float(student.ppf(0.975, len(values) - 1) * spread / np.sqrt(len(values)))
    return {"value": mean, "low": mean - half, "high": mean + half}
