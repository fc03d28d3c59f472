"""The claim of high accuracy."""

from __future__ import annotations

from functools import partial

import numpy as np

from ...control.motion import Motion
from ...control.neural.continuous import INTEGRATORS, integrate_network
from ...control.neural.fixed_step import simulate_network
from ...control.neural.network_settings import NetworkSettings
from ...control.settings import ControllerSettings
from ...ledger import REGISTRY, Assumed, Bounded, Is, Result
from .constants import CONTROL_STEP, SEED
from .scenario import Frozen, frozen

checks = partial(REGISTRY.checks, page="patent/contest")
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
    y0 = _start(assumed["initial_state"], size)
    motion = _network_motion(scenario, settings, network, assumed["integrator"], y0)
    started = _network_motion(scenario, settings, network, "bdf", _start("random", size))
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
        caption=(
            f"Largest tip error over the whole path, to the micrometre: {1e6 * error:.0f} um by "
            f"{assumed['integrator']} from a state that is {assumed['initial_state']}, against "
            f"{1e6 * bound:.0f} um taken for accurate. From a random state of size {_RANDOM:g} "
            f"rad/s the tips are off by up to {1e3 * random_error:.1f} mm before the error has "
            "died out. How accurate is meant is not printed."
        ),
    )


def _start(name: str, size: int) -> np.ndarray:
    """State of the network at the start; zero is stationary at rest, away from all constraints."""
    if name == "random":
        return _RANDOM * np.random.default_rng(SEED).normal(size=size)
    return np.zeros(size)


def _network_motion(
    scenario: Frozen,
    settings: ControllerSettings,
    network: NetworkSettings,
    integrator: str,
    y0: np.ndarray,
) -> Motion:
    arguments = (scenario.system, scenario.circles, scenario.q0, settings, network)
    if integrator in INTEGRATORS:
        return integrate_network(*arguments, integrator=integrator, y0=y0)[0]
    return simulate_network(*arguments, dt=CONTROL_STEP, y0=y0)
