"""How good the motions of the networks are: robust against a disturbance, and accurate."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
import pandas as pd
from scipy.stats import t as student

from .....control.motion import Motion
from .....control.neural.continuous import INTEGRATORS, integrate_network
from .....control.neural.fixed_step import simulate_network
from .....control.neural.network_settings import NetworkSettings
from .....control.neural.primal_dual import simulate_primal_dual
from .....control.readings import Readings
from .....control.settings import ControllerSettings
from .....ledger import REGISTRY, Assumed, Bounded, Exceeds, Is, Result
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
_RANDOM = 0.1  # [rad/s] size of a random state


def _late(motion: Motion) -> float:
    """Median tip error over the second half of the path, when the gain has grown [m]."""
    half = len(motion.error) // 2
    return float(np.median(motion.error[half:].max(axis=1)))


#: Measure to a number that grows as the motion gets worse.
MEASURES: dict[str, Callable[[Motion], float]] = {
    "largest_tip_error": lambda motion: motion.largest_error,
    "late_tip_error": _late,
    "smallest_distance": lambda motion: -motion.smallest_distance,
    "peak_acceleration": lambda motion: motion.peak_acceleration,
}


@checks(
    "patent.claim_robust",
    samples=16,
    rules=[
        Exceeds(
            "advantage",
            "what the disturbance adds with the primal-dual network less that with the "
            "network, by their sum",
            threshold="noticeable",
        )
    ],
)
def more_robust(assumed: Assumed) -> Result:
    """Both networks under the same disturbances, each against its own undisturbed motion."""
    network = network_settings(assumed, "gain", "gain_cap", "penalty_form")
    kind, measure = assumed["disturbance"], assumed["robustness_measure"]
    count = round(assumed["primal_dual_network"])
    size = assumed[SIZES[kind]]
    runs = {
        (name, number): motion
        for number in range(REPEATS)
        for name, motion in _motions(network, count, kind, size, number).items()
    }
    calm = _motions(network, count, "none", 0.0, 0)
    added = {
        name: [_added(runs[name, k], calm[name], measure) for k in range(REPEATS)]
        for name in ("network", "primal-dual")
    }
    shares = [_share(a, b) for a, b in zip(added["network"], added["primal-dual"], strict=True)]
    advantage = _interval(shares)
    own, other = (float(np.median(added[name])) for name in ("network", "primal-dual"))
    rows = [("none", name, 0, *_row(motion)) for name, motion in calm.items()]
    rows += [(kind, name, k, *_row(motion)) for (name, k), motion in runs.items()]
    return Result(
        obtained={
            "advantage": advantage,
            "added_network": own if np.isfinite(own) else None,
            "added_primal_dual": other if np.isfinite(other) else None,
        },
        witnesses=one_for_each_side(
            (f"repeat {k}", share > 0.0, {"advantage": share}) for k, share in enumerate(shares)
        ),
        table=pd.DataFrame(rows, columns=["disturbance", "solver", "repeat", *_COLUMNS]),
        caption=caption(
            "claim_robust",
            **{"kind": kind, "measure": measure, "repeats": REPEATS, "own": own, "other": other},
            told=_TOLD,
            noticeable=_noticeable(),
        ),
    )


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
    return {}


def _noticeable() -> float:
    """Relative difference from which on an effect counts as another."""
    return REGISTRY.look("patent.claim_robust", "thresholds").thresholds["noticeable"].value


def _added(motion: Motion, calm: Motion, measure: str) -> float:
    """What the disturbance adds; infinite for a motion that breaks down."""
    if not motion.finished:
        return np.inf
    return max(MEASURES[measure](motion) - MEASURES[measure](calm), 0.0)


def _share(own: float, other: float) -> float:
    """(other - own) / (other + own) in [-1, 1]."""
    if own == other:
        return 0.0
    if np.isinf(own) or np.isinf(other):
        return -1.0 if np.isinf(own) else 1.0
    return (other - own) / (other + own)


def _interval(values: list[float]) -> dict[str, float]:
    """Mean with its 95 % interval by Student's t."""
    mean, spread = float(np.mean(values)), float(np.std(values, ddof=1))
    half = float(student.ppf(0.975, len(values) - 1) * spread / np.sqrt(len(values)))
    return {"value": mean, "low": mean - half, "high": mean + half}


@checks(
    "patent.claim_accuracy",
    samples=16,
    rules=[
        Bounded("tip_error_share", "largest tip error over the bound on it", high=1),
        Is("completed", "the task is completed", value=True),
    ],
)
def accurate(assumed: Assumed) -> Result:
    """Largest tip error of the network over the frozen task, to the micrometre."""
    scenario = frozen("crossing")
    settings = ControllerSettings(feedback=assumed["feedback_gain"])
    network = NetworkSettings(gamma=assumed["gain"])
    size = scenario.system.nq + 3 * len(scenario.system.arms)
    arguments, y0 = (*scenario.parts, settings, network), assumed["initial_state"]
    motion = _network_motion(arguments, assumed["integrator"], _initial_state(y0, size))
    started = _network_motion(arguments, "bdf", _initial_state("random", size))
    bound = assumed["accuracy_bound"]
    # Below a micrometre the error is that of the integrator's step control.
    error, random_error = round(motion.largest_error, 6), round(started.largest_error, 6)
    return Result(
        obtained={
            "tip_error": error,
            "tip_error_share": error / bound,
            "completed": motion.completed,
            "tip_error_random_start": random_error,
        },
        measured={"tip_error": motion.largest_error},
        caption=caption("claim_accuracy", error=error, assumed=assumed, size=_RANDOM),
    )


def _initial_state(name: str, size: int) -> np.ndarray:
    """State of the network at the start; zero is stationary at rest, away from all constraints."""
    if name == "random":
        return _RANDOM * np.random.default_rng(SEED).normal(size=size)
    return np.zeros(size)


def _network_motion(arguments: tuple[Any, ...], integrator: str, y0: np.ndarray) -> Motion:
    if integrator in INTEGRATORS:
        return integrate_network(*arguments, integrator=integrator, y0=y0)[0]
    return simulate_network(*arguments, dt=CONTROL_STEP, y0=y0)
