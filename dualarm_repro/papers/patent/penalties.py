"""Equations of the penalty: its form, the stacked inequalities, the penalised problem."""

from __future__ import annotations

from functools import partial

import numpy as np
import pandas as pd

from ...control.neural.network_settings import NetworkSettings
from ...control.neural.penalty import PENALTIES, penalty
from ...control.solvers import solve
from ...ledger import REGISTRY, Assumed, Bounded, Is, NoOriginal, Result
from ...view.control_figures import penalty_figure
from .derivation import rest_point, sample_problem
from .scenario import network_of

checks = partial(REGISTRY.checks, page="patent/network")
_NAMES = ("penalty_form", "penalty_factor", "penalty_sharpness")
#: Factors by which the penalty is stiffened.
STIFFER = (1.0, 10.0, 100.0)


@checks(
    "patent.eq_penalty",
    samples=32,
    rules=[
        Bounded(key="first_derivative", high=1e-6, label="P' is the derivative of P, relative to"),
        Bounded(
            key="second_derivative", high=1e-5, label="P'' is the derivative of P', relative to"
        ),
        Bounded(key="monotone", low=0.0, label="P grows with the violation: smallest P'"),
        NoOriginal(key="formula", label="the penalty function"),
    ],
)
def penalty_function(assumed: Assumed) -> Result:
    """The assumed penalty with both derivatives, against central differences."""
    network = network_of(assumed, *_NAMES)
    kind, p, s = PENALTIES.index(network.penalty), network.factor, network.sharpness
    # The quadratic form has a kink at zero, which the grid leaves out.
    g = np.linspace(-4.0, 4.0, 41)[np.arange(41) != 20] / s
    step = 1e-5 / s
    at, up, down = (np.array([penalty(kind, p, s, v + d) for v in g]) for d in (0.0, step, -step))
    errors = [
        float(
            np.abs((up[:, k] - down[:, k]) / (2 * step) - at[:, k + 1]).max()
            / np.abs(at[:, k + 1]).max()
        )
        for k in (0, 1)
    ]
    forms = {
        name: np.array([penalty(PENALTIES.index(name), _drawn(name), 10.0, v)[0] for v in _GRID])
        for name in PENALTIES
    }
    return Result(
        obtained={
            "first_derivative": errors[0],
            "second_derivative": errors[1],
            "monotone": float(at[:, 1].min()),
        },
        table=pd.DataFrame({"g": _GRID, **forms}),
        caption=(
            "Four penalties that fit the words, drawn for p = 1 (exponential 0.01) and sigma = "
            f"10. The one used ({network.penalty}, p = {p:g}, sigma = {s:g}) has derivatives that "
            f"agree with differences to {max(errors):.1e}. Which one the document means cannot be "
            "decided: p, h and sigma are named, the formula is lost."
        ),
        alt="Four penalty curves over the violation g, all flat for negative g and rising for "
        "positive g.",
        figure=lambda: penalty_figure(_GRID, forms),
    )


@checks(
    "patent.eq_penalty_defs",
    samples=16,
    rules=[
        Is(key="complete", value=True, label="every bound and row is one of the h inequalities"),
        Bounded(
            key="multipliers",
            high=0.1,
            label="P' at the minimiser is the exact multiplier, to a share of",
        ),
        NoOriginal(key="formula", label="the terms of the penalty"),
    ],
)
def stacked_inequalities(assumed: Assumed) -> Result:
    """C x <= d with C = [G; I; -I], and the multipliers that the penalty stands for."""
    network = network_of(assumed, *_NAMES)
    p, exact = sample_problem(), solve(sample_problem())
    y = rest_point(p, network)
    x = y[: p.size]
    kind = PENALTIES.index(network.penalty)
    C = np.vstack([p.G, np.eye(p.size), -np.eye(p.size)])
    d = np.concatenate([p.h, p.upper, -p.lower])
    push = np.array([penalty(kind, network.factor, network.sharpness, g)[1] for g in C @ x - d])
    multipliers = np.concatenate([exact.z, np.maximum(exact.w, 0.0), np.maximum(-exact.w, 0.0)])
    apart = float(np.abs(push - multipliers).max() / multipliers.max())
    return Result(
        obtained={
            "complete": len(C) == len(p.h) + 2 * p.size,
            "inequalities": len(C),
            "multipliers": apart,
            "largest_multiplier": float(multipliers.max()),
        },
        caption=(
            f"Both bounds of {p.size} joints and {len(p.h)} avoidance rows make h = {len(C)} "
            f"one-sided inequalities. Their largest multiplier is {multipliers.max():.3f}; the "
            f"slope of the penalty at its minimiser misses it by {apart:.1%}. That is what p and "
            "sigma have to be chosen for."
        ),
    )


@checks(
    "patent.eq_qp_penalized",
    samples=32,
    rules=[
        Bounded(
            key="bias_ratio",
            low=2.0,
            label="a penalty stiffer by 10 is nearer to the exact minimiser by",
        ),
        Bounded(key="equality", high=1e-8, label="the equality is kept exactly, to [m/s]"),
        NoOriginal(key="formula", label="the penalised problem"),
    ],
)
def penalised_problem(assumed: Assumed) -> Result:
    """Distance of the penalised minimiser from the exact one as p and sigma grow."""
    network = network_of(assumed, *_NAMES)
    p, exact = sample_problem(), solve(sample_problem())
    rows, equality = [], 0.0
    for factor in STIFFER:
        stiffer = stiffened(network, factor)
        x = rest_point(p, stiffer)[: p.size]
        equality = max(equality, float(np.abs(p.A @ x - p.b).max()))
        violation = float((p.G @ x - p.h).max())
        rows.append((factor, float(np.abs(x - exact.x).max()), max(violation, 0.0)))
    bias = [row[1] for row in rows]
    return Result(
        obtained={
            "bias": bias,
            "bias_ratio": bias[0] / bias[1],
            "violation": rows[0][2],
            "equality": equality,
        },
        table=pd.DataFrame(rows, columns=["stiffer by", "bias [rad/s]", "violation [m/s]"]),
        caption=(
            f"The penalised minimiser is {bias[0]:.1e} rad/s from the exact one where avoidance "
            f"presses most, and violates a row by {rows[0][2]:.1e} m/s: the inequalities have "
            "become soft, the equality has not. Stiffer by 10 and by 100 the distance is "
            f"{bias[1]:.1e} and {bias[2]:.1e} rad/s."
        ),
    )


def _drawn(name: str) -> float:
    """Factor that brings the form into one picture."""
    return 0.01 if name == "exponential" else 1.0


def stiffened(network: NetworkSettings, factor: float) -> NetworkSettings:
    """The same form nearer to its hard limit."""
    quadratic = network.penalty in ("quadratic", "squared_softplus")
    return NetworkSettings(
        penalty=network.penalty,
        # The exponential keeps p s, so that a multiplier of one stays at g = 0.
        factor=network.factor
        * (factor if quadratic else 1.0 / factor if network.penalty == "exponential" else 1.0),
        sharpness=network.sharpness * factor,
    )


_GRID = np.linspace(-0.4, 0.4, 161)
