"""Equations of the network: how the error decays, the state equation, the integration; the gain."""

from __future__ import annotations

from functools import partial

import numpy as np
import pandas as pd
from scipy.integrate import quad, solve_ivp

from ...control.assembly import make_buffers, sense, state
from ...control.neural.activation import ACTIVATIONS, activation
from ...control.neural.continuous import INTEGRATORS, integrate_network
from ...control.neural.fixed_step import divergence_time, simulate_network
from ...control.neural.network import network_rate, state_rate
from ...control.neural.network_settings import NetworkSettings
from ...control.neural.optimality import optimality
from ...control.settings import ROWS, Settings
from ...ledger import REGISTRY, Assumed, Bounded, Is, NoOriginal, Result
from ...view.control_figures import decay_figure
from .derivation import sample_problem, state_with_error
from .robots import SEED
from .scenario import CONTROL_STEP, frozen, network_of

checks = partial(REGISTRY.checks, page="patent/network")
GAINS = (1.0, 10.0, 80.0)
START = 0.1  # size of the error at the start of a decay


@checks(
    "patent.eq_design",
    samples=16,
    rules=[
        Bounded(
            key="defect",
            high=1e-3,
            label="error of the network against the closed solution, share of start",
        ),
        NoOriginal(key="formula", label="the decay of the error"),
    ],
)
def error_decay(assumed: Assumed) -> Result:
    """Error of the network on a problem that stands still, against d xi/dt = -gamma e^t Psi(xi)."""
    network = network_of(assumed, "gain", "activation")
    p, numbers = sample_problem(), network.numbers()
    size = p.size + len(p.b)
    still, F = np.zeros(size), np.empty(size)
    y0 = state_with_error(p, network, np.random.default_rng(SEED).uniform(-START, START, size))
    optimality(numbers, *p.parts, y0, F)
    start, kind = F.copy(), ACTIVATIONS.index(network.activation)

    def rate(t: float, y: np.ndarray) -> np.ndarray:
        dy = np.empty(size)
        network_rate(
            numbers, network.gamma * np.exp(t), still, *p.parts, np.ascontiguousarray(y), dy
        )
        return dy

    def closed(t: float, xi: np.ndarray) -> np.ndarray:
        return -network.gamma * np.exp(t) * np.array([activation(kind, v) for v in xi])

    end = float(np.log1p(3.0 / network.gamma))
    options = {"method": "Radau", "rtol": 1e-9, "atol": 1e-11}
    grid = np.linspace(0.0, end, 41)
    flow = solve_ivp(rate, (0.0, end), y0, t_eval=grid, **options).y.T
    expected = solve_ivp(closed, (0.0, end), start, t_eval=grid, **options).y.T
    reached = np.empty_like(expected)
    for row, y in zip(reached, flow, strict=True):
        optimality(numbers, *p.parts, np.ascontiguousarray(y), row)
    defect = float(np.abs(reached - expected).max() / np.abs(start).max())
    return Result(
        obtained={"defect": round(defect, 6), "start": float(np.abs(start).max())},
        caption=(
            "On a problem that stands still every entry of the error follows d xi/dt = -gamma e^t "
            f"Psi(xi) to {defect:.1e} of its start (gamma = {network.gamma:g}, "
            f"{network.activation}): the state equation does what the design asks for. For the "
            "linear activation the decay is exp(-gamma (e^t - 1))."
        ),
    )


@checks(
    "patent.eq_solver",
    samples=16,
    rules=[
        Bounded(
            key="defect",
            high=1e-3,
            label="along the motion, d xi/dt + gamma e^t Psi(xi), share of the gain",
        ),
        NoOriginal(key="formula", label="the state equation"),
    ],
)
def state_equation(assumed: Assumed) -> Result:
    """Derivative of the error along the moving arms, by differences, against the design."""
    network = network_of(
        assumed, "state_matrix", "feed_forward", "gain", "activation", "penalty_form"
    )
    scenario, settings = frozen("crossing"), Settings()
    smooth = NetworkSettings(penalty=network.penalty)
    motion, _ = integrate_network(
        scenario.system, scenario.circles, scenario.q0, settings, smooth, sample=0.02
    )
    system, numbers, numbered = scenario.system, settings.numbers(), network.numbers()
    arrays, circle = system.arrays, scenario.circles.numbers()
    n, size = system.nq, system.nq + 3 * len(system.arms)
    buffers = make_buffers(arrays, ROWS[numbers.form])
    no_noise, still = np.empty(0), np.zeros(size)
    rng = np.random.default_rng(SEED)
    k = int(motion.rows.argmax())
    q, t, worst = np.ascontiguousarray(motion.q[k]), float(motion.time[k]), 0.0

    def error(s: float, y: np.ndarray, move: np.ndarray) -> np.ndarray:
        """xi a time s later."""
        count = sense(arrays, numbers, q + s * move, no_noise, buffers)
        later = scenario.circles.at(t + s)
        rows = state(arrays, numbers, q + s * move, scenario.q0, *later, count, buffers)
        B, F = buffers, np.empty(size)
        optimality(numbered, B.target, B.A, B.b, B.G[:rows], B.h[:rows], B.lower, B.upper, y, F)
        return F

    for _ in range(10):
        y = np.concatenate([motion.x[k], np.zeros(size - n)]) + 0.02 * rng.normal(size=size)
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
        obtained={"defect": round(worst, 6)},
        caption=(
            f"Moved along the arms' motion at t = {t:.2f} s, the error changes as -gamma e^t "
            f"Psi(xi) to {worst:.1e} of the largest entry at ten random states: M dy/dt = -dF/dt "
            "- gamma e^t Psi(F) with the Hessian of the penalty in M and every rate of the "
            "problem in dF/dt. Leaving out either changes the decay."
        ),
    )


@checks(
    "patent.eq_integration",
    samples=4,
    rules=[
        Bounded(
            key="defect",
            high=1e-3,
            label="theta* against the sum of the first n entries of y* [rad]",
        ),
        Bounded(key="tip_error", high=1e-3, label="largest tip error [m]"),
        Bounded(key="distance", low=0.025, label="smallest distance of the arms [m]"),
    ],
)
def integration(assumed: Assumed) -> Result:
    """Joint angles from the network state over the frozen task."""
    scenario, settings = frozen("crossing"), Settings()
    arguments = (scenario.system, scenario.circles, scenario.q0, settings, NetworkSettings())
    if assumed["integrator"] in INTEGRATORS:
        motion, evaluations = integrate_network(*arguments, integrator=assumed["integrator"])
    else:
        motion = simulate_network(*arguments, dt=CONTROL_STEP)
        evaluations = len(motion.x)
    middle = 0.5 * (motion.x[1:] + motion.x[:-1]) * motion.dt
    summed = motion.q[0] + np.vstack([np.zeros(motion.q.shape[1]), np.cumsum(middle, axis=0)])
    defect = float(np.abs(summed - motion.q[: len(summed)]).max())
    return Result(
        obtained={
            "defect": round(defect, 6),
            "tip_error": motion.largest_error,
            "distance": motion.smallest_distance,
        },
        measured={"evaluations": evaluations},
        caption=(
            "Robot and network as one differential equation, integrated by "
            f"{assumed['integrator']} with {evaluations} evaluations for {scenario.period:g} s of "
            f"motion: the first n entries of y, summed up, are the joint angles to {defect:.1e} "
            f"rad. The tips stay within {motion.largest_error:.1e} m of their circles and the "
            f"arms {1e3 * motion.smallest_distance:.1f} mm apart."
        ),
    )


@checks(
    "patent.claim_gain_time_varying",
    samples=32,
    rules=[
        Is(
            key="always_sooner",
            value=True,
            label="growing gain is sooner below the threshold, for every gamma",
        ),
        Bounded(key="integrated", high=1e-3, label="network times against the closed ones, share"),
    ],
)
def growing_gain(assumed: Assumed) -> Result:
    """Time until the error is below the threshold, with gamma e^t and with gamma."""
    name, tolerance, own = assumed["activation"], assumed["convergence_threshold"], assumed["gain"]
    kind = ACTIVATIONS.index(name)
    # With tau the integral of the gain, d xi/d tau = -Psi(xi) whatever the gain.
    tau = quad(lambda u: np.exp(u) / activation(kind, np.exp(u)), np.log(tolerance), np.log(START))[
        0
    ]
    rows = [(g, float(np.log1p(tau / g)), tau / g) for g in sorted({*GAINS, own})]
    integrated = max(
        _relative(_time_below(kind, own, growing, tolerance), value)
        for growing, value in ((True, float(np.log1p(tau / own))), (False, tau / own))
    )
    predicted = {g: divergence_time(g, CONTROL_STEP) for g in GAINS}
    curves = {
        f"{'growing' if growing else 'constant'} gain, gamma = {g:g}": _curve(kind, g, growing)
        for g in GAINS
        for growing in (True, False)
    }
    saved = {g: constant - grown for g, grown, constant in rows}
    return Result(
        obtained={
            "always_sooner": all(grown < constant for _, grown, constant in rows),
            "integrated": integrated,
            "growing_s": [row[1] for row in rows],
            "constant_s": [row[2] for row in rows],
            "euler_limit_s": list(predicted.values()),
        },
        table=pd.DataFrame(rows, columns=["gamma [1/s]", "growing [s]", "constant [s]"]),
        caption=(
            f"From {START:g} to {tolerance:g} the error takes ln(1 + tau / gamma) seconds with "
            f"the growing gain and tau / gamma with the constant one (tau = {tau:.2f}, {name}), "
            f"so growth always helps: by {saved[GAINS[0]]:.2f} s at gamma = {GAINS[0]:g} and "
            f"{1e3 * saved[GAINS[-1]]:.1f} ms at {GAINS[-1]:g}. The seconds are those of the "
            "moving robot. And the growth has an end: explicit steps of 1 ms are unstable after "
            f"{', '.join(f'{v:.1f}' for v in predicted.values())} s for gamma = "
            f"{', '.join(f'{g:g}' for g in GAINS)}."
        ),
        alt="Decay of the error over time for three gains, growing and constant; the growing "
        "ones fall faster.",
        figure=lambda: decay_figure(curves, tolerance),
    )


def _curve(kind: int, gamma: float, growing: bool) -> tuple[np.ndarray, np.ndarray]:
    times = np.linspace(0.0, 1.5, 301)

    def rate(t: float, xi: np.ndarray) -> np.ndarray:
        return (
            -gamma * (np.exp(t) if growing else 1.0) * np.array([activation(kind, v) for v in xi])
        )

    found = solve_ivp(
        rate, (0.0, times[-1]), [START], t_eval=times, method="LSODA", rtol=1e-8, atol=1e-12
    )
    return times, found.y[0]


def _time_below(kind: int, gamma: float, growing: bool, tolerance: float) -> float:
    """Time until one entry of the error, integrated in its logarithm, is down at the tolerance."""

    def rate(t: float, log: np.ndarray) -> np.ndarray:
        gain = gamma * (np.exp(min(t, 700.0)) if growing else 1.0)
        return -gain * np.array([activation(kind, np.exp(v)) / np.exp(v) for v in log])

    def below(t: float, log: np.ndarray) -> float:
        return float(log[0] - np.log(tolerance))

    below.terminal = True
    found = solve_ivp(
        rate, (0.0, 1e9), [np.log(START)], events=below, method="LSODA", rtol=1e-8, atol=1e-10
    )
    return float(found.t[-1])


def _relative(value: float, expected: float) -> float:
    return abs(value - expected) / expected
