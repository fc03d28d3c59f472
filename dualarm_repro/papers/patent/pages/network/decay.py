"""How the error of the network decays: design and gain, state equation, integration."""

from __future__ import annotations

from functools import partial

import numpy as np
import pandas as pd
from scipy.integrate import solve_ivp

from .....control.assembly import make_buffers, sense, state
from .....control.neural.activation import SLOPE_AT_ZERO, Activation, activation
from .....control.neural.continuous import INTEGRATORS, integrate_network
from .....control.neural.fixed_step import divergence_time, simulate_network
from .....control.neural.network import network_rate, state_rate
from .....control.neural.network_settings import NetworkSettings
from .....control.neural.optimality import optimality
from .....control.neural.penalised import code_error, state_with_error
from .....control.settings import ControllerSettings
from .....control.trajectory import trajectory
from .....ledger import REGISTRY, Assumed, Bounded, NoOriginal, Result
from .....ledger.assumptions import alternatives
from .....ledger.captions import captions
from .....settings import code
from .....view.control_figures import decay_figure
from ...document import CONTROL_STEP, SEED, frozen
from ...problems import sample_problem
from ...reading import network_settings

checks = partial(REGISTRY.checks, page="patent/network")
caption = captions(__file__)
START = 0.1  # size of the error at the start of a decay
GAINS = (1.0, 10.0, 80.0)
FAR = 10.0  # size of an error beyond which the differences of a steep penalty are noise
HORIZON = 6.0  # [s] after which gamma = 1 has reached most of its ceiling
_KINDS = ("growing", "start", "ceiling")
_DONE = 1e-9  # error below every declared threshold, after which nothing is left to see


@checks(
    "patent.eq_design",
    rules=[
        Bounded("defect", "error of the network against the design, share of the start", high=1e-4),
        NoOriginal("formula", "the decay of the error"),
    ],
)
def error_decay(assumed: Assumed) -> Result:
    """Error of the network on a problem that stands still, against d xi/dt = -gamma e^t Psi(xi)."""
    names, ends = alternatives("patent.activation", 0), alternatives("patent.gain", 2)
    tried = [(name, REGISTRY.assumption("patent.gain")) for name in names]
    tried += [(names[0], gamma) for gamma in ends]
    defects = [
        _decay_defect(NetworkSettings(activation=name, gamma=gamma)) for name, gamma in tried
    ]
    return Result(
        obtained={"defect": round(max(defects), 6), "tried": len(tried)},
        table=pd.DataFrame(
            [(*pair, defect) for pair, defect in zip(tried, defects, strict=True)],
            columns=["activation", "gamma [1/s]", "defect"],
        ),
        caption=caption("eq_design", worst=max(defects), activations=len(names), gamma=ends),
    )


def _decay_defect(network: NetworkSettings) -> float:
    """Largest difference between the error of the network and the design, share of the start."""
    p, numbers = sample_problem(), network.numbers()
    size = p.size + len(p.b)
    still = np.zeros(size)
    y0 = state_with_error(p, network, np.random.default_rng(SEED).uniform(-START, START, size))
    start, kind = code_error(p, network, y0), code(network.activation)

    def rate(t: float, y: np.ndarray) -> np.ndarray:
        dy = np.empty(size)
        network_rate(
            numbers, network.gamma * np.exp(t), still, p.parts, np.ascontiguousarray(y), dy
        )
        return dy

    def design(t: float, xi: np.ndarray) -> np.ndarray:
        return -network.gamma * np.exp(t) * np.array([activation(kind, v) for v in xi])

    end = float(np.log1p(3.0 / network.gamma))
    options = {"method": "Radau", "rtol": 1e-9, "atol": 1e-11}
    grid = np.linspace(0.0, end, 41)
    flow = solve_ivp(rate, (0.0, end), y0, t_eval=grid, **options).y.T
    expected = solve_ivp(design, (0.0, end), start, t_eval=grid, **options).y.T
    reached = np.array([code_error(p, network, y) for y in flow])
    return float(np.abs(reached - expected).max() / np.abs(start).max())


@checks(
    "patent.claim_gain_time_varying",
    samples=32,
    rules=[
        Bounded(
            "sooner",
            "the growing gain is below the threshold earlier by [s], at least one step",
            low="one_step",
        )
    ],
)
def growing_gain(assumed: Assumed) -> Result:
    """Time until the error stays below the threshold, with growing and with constant gain."""
    threshold, own = assumed["convergence_threshold"], assumed["gain"]
    activation = assumed["activation"]
    curves = {
        (g, kind): decay(activation, g, kind) for g in sorted({*GAINS, own}) for kind in _KINDS
    }
    found = {key: settled(errors, threshold) for key, errors in curves.items()}
    ceiling, mean = gain_ceiling(activation), mean_gain(activation, own, found[own, "growing"])
    found[own, "mean"] = settled(decay(activation, mean, "start"), threshold)
    unstable = {g: divergence_time(g, CONTROL_STEP) for g in GAINS}
    drawn = {
        f"{label}, gamma = {g:g}": curves[g, kind]
        for g in GAINS
        for label, kind in (("growing gain", "growing"), ("constant gain", "start"))
    }
    drawn["constant gain of the same ceiling"] = curves[own, "ceiling"]
    return Result(
        obtained={
            "sooner": found[own, assumed["compared_gain"]] - found[own, "growing"],
            "growing_s": found[own, "growing"],
            "constant_s": found[own, "start"],
            "ceiling_s": found[own, "ceiling"],
            "ceiling": ceiling,
            "mean_s": found[own, "mean"],
            "mean": mean,
        },
        table=pd.DataFrame(
            [(g, *(found[g, kind] for kind in _KINDS)) for g in sorted({*GAINS, own})],
            columns=["gamma [1/s]", "growing [s]", "constant gamma [s]", "constant ceiling [s]"],
        ),
        caption=caption(
            "claim_gain_time_varying",
            **{"start": START, "horizon": HORIZON, "step": CONTROL_STEP},
            assumed=assumed,
            unstable=unstable,
        ),
        alt="Decay of the error over time for three gains, growing and constant, and for the "
        "constant gain of the same ceiling, which falls first.",
        figure=lambda: decay_figure(
            {name: (CONTROL_STEP * np.arange(len(c)), c) for name, c in drawn.items()}, threshold
        ),
    )


def gain_ceiling(activation: str) -> float:
    """Largest gain that the fixed step allows, 1 / (step Psi'(0)) [1/s]."""
    slope = SLOPE_AT_ZERO[Activation(activation)]
    return 1.0 / (CONTROL_STEP * (slope if 0.0 < slope < np.inf else 1.0))


def mean_gain(activation: str, gamma: float, until: float) -> float:
    """Mean of min(gamma e^t, ceiling) over the steps until a time: the constant of equal effort."""
    steps = np.arange(max(1, round(until / CONTROL_STEP)))
    return float(np.minimum(gamma * np.exp(steps * CONTROL_STEP), gain_ceiling(activation)).mean())


def decay(activation: str, gamma: float, kind: str) -> np.ndarray:
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


def settled(errors: np.ndarray, threshold: float) -> float:
    """When the error is below the threshold for good; the horizon if it is not [s]."""
    above = np.flatnonzero(~(errors <= threshold))
    steps = int(above[-1]) + 1 if len(above) else 0
    return HORIZON if steps >= len(errors) else CONTROL_STEP * steps


@checks(
    "patent.eq_solver",
    samples=16,
    rules=[
        Bounded(
            "defect", "along the motion, d xi/dt + gamma e^t Psi(xi), share of the gain", high=1e-4
        ),
        NoOriginal("formula", "the state equation"),
    ],
)
def state_equation(assumed: Assumed) -> Result:
    """Derivative of the error along the moving arms, by differences, against the design."""
    network = network_settings(
        assumed, "state_matrix", "feed_forward", "gain", "activation", "penalty_form"
    )
    scenario, settings = frozen("crossing"), ControllerSettings()
    smooth = NetworkSettings(penalty=network.penalty)
    motion, _ = integrate_network(*scenario.parts, settings, smooth, sample=0.02)
    system, numbers, numbered = scenario.system, settings.numbers(), network.numbers()
    arrays, circle = system.arrays, scenario.circles.numbers()
    n, size = system.nq, system.nq + 3 * len(system.arms)
    buffers = make_buffers(arrays, numbers)
    no_noise, still = np.empty(0), np.zeros(size)
    rng = np.random.default_rng(SEED)
    k = int(motion.distance[:-1].argmin())
    q, t, worst = np.ascontiguousarray(motion.q[k]), float(motion.time[k]), 0.0
    on_motion = np.concatenate([motion.x[k], np.zeros(size - n)])

    def error(s: float, y: np.ndarray, move: np.ndarray) -> np.ndarray:
        """xi a time s later."""
        count = sense(arrays, numbers, q + s * move, no_noise, buffers)
        later = scenario.circles.at(t + s)
        program = state(arrays, numbers, q + s * move, scenario.q0, *later, count, buffers)
        F = np.empty(size)
        optimality(numbered, program, y, F)
        return F

    for _ in range(10):
        y, away = on_motion, 0.02 * rng.normal(size=size)
        while np.abs(error(0.0, y := on_motion + away, y[:n])).max() > FAR and away.any():
            away *= 0.5
        rate = np.empty(size)
        state_rate(
            arrays, numbers, numbered, circle, q, scenario.q0, t, y, no_noise, still, buffers, rate
        )
        step = 1e-7 / max(1.0, float(np.abs(rate).max()) / 10)
        ends = [error(sign * step, y + sign * step * rate, y[:n]) for sign in (1.0, -1.0)]
        gain = network.gamma * np.exp(t)
        asked = -gain * np.array([activation(numbered.activation, v) for v in error(0.0, y, y[:n])])
        found = (ends[0] - ends[1]) / (2 * step)
        worst = max(worst, float(np.abs(found - asked).max() / np.abs(asked).max()))
    return Result(
        obtained={"defect": round(worst, 6)}, caption=caption("eq_solver", t=t, worst=worst)
    )


@checks(
    "patent.eq_integration",
    samples=8,
    rules=[
        Bounded(
            "defect_share",
            "theta* less the sum of the first n entries of y*, by the error of such a sum",
            high="quadrature",
        ),
        Bounded("tip_error", "largest tip error [m]", high="on_path"),
    ],
)
def integration(assumed: Assumed) -> Result:
    """Joint angles from the network state over the frozen task."""
    scenario, settings = frozen("crossing"), ControllerSettings()
    arguments = (*scenario.parts, settings, NetworkSettings())
    if assumed["integrator"] in INTEGRATORS:
        motion, evaluations = integrate_network(*arguments, integrator=assumed["integrator"])
        # Trapezoids over samples a step h apart err by h^2 / 12 times the change of the slope.
        summed = 0.5 * (motion.x[1:] + motion.x[:-1]) * motion.dt
        changes = np.abs(np.diff(motion.x, n=2, axis=0)).sum(axis=0)
        expected = motion.dt / 12.0 * float(changes.max())
    else:
        motion = simulate_network(*arguments, dt=CONTROL_STEP)
        evaluations = len(motion.x)
        summed = motion.x * motion.dt
        expected = 1e-9
    reached = motion.q[0] + np.vstack([np.zeros(motion.q.shape[1]), np.cumsum(summed, axis=0)])
    defect = float(np.abs(reached - motion.q[: len(reached)]).max())
    tips = round(motion.largest_error, 6)
    return Result(
        obtained={
            "defect_share": round(defect / expected, 3),
            "tip_error": tips,
            "distance": motion.smallest_distance,
        },
        measured={"evaluations": evaluations, "tip_error": motion.largest_error},
        table=trajectory(scenario.system, scenario.circles, motion),
        caption=caption(
            "eq_integration",
            integrator=assumed["integrator"],
            period=scenario.period,
            defect=defect,
            expected=expected,
            tips=tips,
        ),
    )
