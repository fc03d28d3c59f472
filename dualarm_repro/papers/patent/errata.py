"""Machine proofs of the errata on the network."""

from __future__ import annotations

import numpy as np

from ...control.neural.fixed_step import divergence_time, simulate_network
from ...control.neural.network_settings import NetworkSettings
from ...control.neural.penalised import rest_point
from ...control.settings import ControllerSettings
from ...ledger import REGISTRY, Proof
from .document import CONTROL_STEP, frozen, run
from .pages.network.decay import GAINS
from .problems import sample_problem


@REGISTRY.proves("patent.state_in_right_side")
def state_in_right_side() -> Proof:
    """The network with and without the Hessian of the penalty in front of the state derivative."""
    scenario = frozen("crossing")
    with_hessian, without = (
        simulate_network(*scenario.parts, ControllerSettings(), NetworkSettings(hessian=hessian))
        for hessian in (True, False)
    )
    return Proof(
        "with the Hessian in the matrix the network completes the frozen task; with E alone it "
        "diverges",
        with_hessian.completed and not without.finished,
        {
            "diverges_at_s": float(without.time[-1]),
            "tip_error_with_hessian": with_hessian.largest_error,
        },
    )


@REGISTRY.proves("patent.initial_state")
def initial_state() -> Proof:
    """A zero state where the path starts at full speed, against the exact controller."""
    scenario = frozen("crossing", law="constant_speed")
    network = simulate_network(*scenario.parts, ControllerSettings(), NetworkSettings())
    exact = run(scenario, ControllerSettings())
    return Proof(
        "started from a zero state on a path that begins at full speed the network is off the "
        "path by far more than the exact controller on the same path",
        network.largest_error > 10 * exact.largest_error,
        {"network_error": network.largest_error, "exact_error": exact.largest_error},
    )


@REGISTRY.proves("patent.soft_inequalities")
def soft_inequalities() -> Proof:
    """Violation of an avoidance row by the penalised minimiser for growing p."""
    p = sample_problem()
    violation = []
    for factor in (1e3, 1e4, 1e5):
        x = rest_point(p, NetworkSettings(penalty="quadratic", factor=factor))[: p.size]
        violation.append(float((p.G @ x - p.h).max()))
    ratios = np.divide(violation[:-1], violation[1:])
    return Proof(
        "the minimiser with the quadratic penalty violates a row for every finite p, in inverse "
        "proportion to it",
        bool(min(violation) > 0 and np.allclose(ratios, 10, rtol=0.05)),
        {"violation": violation},
    )


@REGISTRY.proves("patent.unbounded_gain")
def unbounded_gain() -> Proof:
    """Times at which explicit steps of 1 ms diverge, against ln(2 / (gamma dt))."""
    scenario = frozen("crossing")
    found, predicted = [], [divergence_time(gamma, CONTROL_STEP) for gamma in GAINS]
    for gamma in GAINS:
        network = NetworkSettings(gamma=gamma, capped=False)
        motion = simulate_network(*scenario.parts, ControllerSettings(), network)
        found.append(float(motion.time[-1]) if not motion.finished else np.inf)
    late = np.subtract(found, predicted)
    return Proof(
        "explicit steps diverge within 0.4 s of the time at which gamma exp(t) times the step is "
        "two",
        bool((late > -0.1).all() and (late < 0.4).all()),
        {"diverges_at_s": found, "predicted_s": predicted},
    )
