"""How accurate the motion of the network is."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from .....control.motion import Motion
from .....control.neural.continuous import INTEGRATORS, integrate_network
from .....control.neural.fixed_step import simulate_network
from .....control.neural.network_settings import NetworkSettings
from .....control.settings import ControllerSettings
from .....control.trajectory import trajectories
from .....ledger import REGISTRY, Assumed, Bounded, Is, Result
from .....ledger.captions import captions
from ...document import CONTROL_STEP, SEED, frozen

checks = partial(REGISTRY.checks, page="patent/contest")
caption = captions(__file__)
_RANDOM = 0.1  # [rad/s] size of a random state


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
        table=trajectories(
            {
                f"{assumed['initial_state']} state": (*scenario.parts[:2], motion),
                "random state": (*scenario.parts[:2], started),
            }
        ),
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
