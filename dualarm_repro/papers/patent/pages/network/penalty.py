"""Equations of the penalty: its form, the stacked inequalities, the penalised problem."""

from __future__ import annotations

from functools import partial
from itertools import product

import numpy as np
import pandas as pd

from .....control.neural.network_settings import NetworkSettings
from .....control.neural.optimality import optimality
from .....control.neural.penalised import code_error, inequalities, penalties, rest_point
from .....control.neural.penalty import Penalty, penalty
from .....control.problem import QuadraticProgram
from .....control.solvers import solve
from .....ledger import REGISTRY, Assumed, Bounded, Is, NoOriginal, Residual, Result
from .....ledger.assumptions import alternatives
from .....ledger.captions import captions
from .....settings import code
from .....view.control_figures import penalty_figure
from ...problems import sample_problem
from ...reading import PENALTY, network_settings

checks = partial(REGISTRY.checks, page="patent/network")
caption = captions(__file__)
#: Factors by which the penalty is stiffened.
STIFFER = (1.0, 10.0, 100.0)


@checks(
    "patent.eq_penalty",
    rules=[
        Residual("first_derivative", "P' is the derivative of P, relative to", high=1e-6),
        Residual("second_derivative", "P'' is the derivative of P', relative to", high=1e-5),
        Bounded("slope", "P grows with the violation: smallest P'", low=0.0),
        Bounded("bend", "P is convex: smallest P''", low=0.0),
        Bounded(
            "inside",
            "slope as far inside a bound as sigma lets it see, share of that outside",
            high="inside",
        ),
        NoOriginal("formula", "the penalty function"),
    ],
)
def penalty_function(assumed: Assumed) -> Result:
    """Every declared form at the ends of the declared parameters, against central differences."""
    found = [_properties(*choice) for choice in _declared()]
    factors = {name: 0.01 if name == "exponential" else 1.0 for name in Penalty}
    forms: dict[str, np.ndarray] = {
        name: np.array([penalty(code(name), factor, 10.0, v)[0] for v in _GRID])
        for name, factor in factors.items()
    }
    worst = {
        key: (min if key in ("slope", "bend") else max)(row[key] for row in found)
        for key in found[0]
    }
    return Result(
        obtained={**worst, "tried": len(found)},
        table=pd.DataFrame({"g": _GRID, **forms}),
        caption=caption("eq_penalty", forms=len(forms)),
        alt="Penalty curves over the violation g, all flat for negative g and rising for positive "
        "g.",
        figure=lambda: penalty_figure(_GRID, forms),
    )


@checks(
    "patent.eq_penalty_defs",
    rules=[
        Is("without_effect", "inequalities that do not enter the code's error", value=0),
        Bounded(
            "nearer",
            "stiffer by 100, P' misses the exact multipliers by this share of the miss",
            high="nearer",
        ),
        NoOriginal("formula", "the terms of the penalty"),
    ],
)
def stacked_inequalities(assumed: Assumed) -> Result:
    """C x <= d with C = [G; I; -I], and the multipliers that the penalty stands for."""
    network, p = network_settings(assumed, *PENALTY), sample_problem()
    exact = solve(p)
    multipliers = np.concatenate([exact.z, np.maximum(exact.w, 0.0), np.maximum(-exact.w, 0.0)])
    miss = []
    for factor in (STIFFER[0], STIFFER[-1]):
        stiffer = stiffened(network, factor)
        push = penalties(p, stiffer, rest_point(p, stiffer)[: p.size])[:, 1]
        miss.append(float(np.abs(push - multipliers).max() / multipliers.max()))
    return Result(
        obtained={
            "without_effect": _without_effect(p, network),
            "inequalities": len(inequalities(p)[1]),
            "miss": miss[0],
            "nearer": miss[1] / miss[0],
            "largest_multiplier": float(multipliers.max()),
        },
        caption=caption("eq_penalty_defs", joints=p.size, rows=len(p.h), stiff=miss[1]),
    )


@checks(
    "patent.eq_qp_penalized",
    rules=[
        Bounded(
            "bias_ratio",
            "a penalty stiffer by 10 is nearer to the exact minimiser by",
            low="nearer",
        ),
        Residual("equality", "the equality is kept exactly, to [m/s]", high=1e-8),
        NoOriginal("formula", "the penalised problem"),
    ],
)
def penalised_problem(assumed: Assumed) -> Result:
    """Distance of the penalised minimiser from the exact one as p and sigma grow."""
    network = network_settings(assumed, *PENALTY)
    p, exact = sample_problem(), solve(sample_problem())
    rows, equality = [], 0.0
    for factor in STIFFER:
        x = rest_point(p, stiffened(network, factor))[: p.size]
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
        caption=caption("eq_qp_penalized"),
    )


def stiffened(network: NetworkSettings, factor: float) -> NetworkSettings:
    """The same form nearer to its hard limit."""
    quadratic = network.penalty in ("quadratic", "squared_softplus")
    return network.changed(
        # The exponential keeps p s, so that a multiplier of one stays at g = 0.
        factor=network.factor
        * (factor if quadratic else 1.0 / factor if network.penalty == "exponential" else 1.0),
        sharpness=network.sharpness * factor,
    )


def _declared() -> list[tuple[str, float, float]]:
    """Declared forms with the ends and the nominal values of p and sigma."""
    forms = alternatives("patent.penalty_form", 0)
    ends = [
        (low, REGISTRY.assumption(name), high)
        for name in ("patent.penalty_factor", "patent.penalty_sharpness")
        for low, high in [alternatives(name, 2)]
    ]
    return list(product(forms, *ends))


def _properties(form: str, p: float, s: float) -> dict[str, float]:
    kind = code(Penalty(form))
    # The quadratic form has a kink at zero, which the grid leaves out.
    g = np.linspace(-4.0, 4.0, 41)[np.arange(41) != 20] / s
    step = 1e-5 / s
    at, up, down = (np.array([penalty(kind, p, s, v + d) for v in g]) for d in (0.0, step, -step))
    first, second = (
        float(np.abs((up[:, k] - down[:, k]) / (2 * step) - exact).max() / np.abs(exact).max())
        for k, exact in enumerate(at.T[1:])
    )
    slope = at[:, 1]
    return {
        "first_derivative": first,
        "second_derivative": second,
        "slope": float(slope.min()),
        "bend": float(at[:, 2].min()),
        "inside": float(slope[0] / slope[-1]),
    }


def _without_effect(p: QuadraticProgram, network: NetworkSettings) -> int:
    """Inequalities whose bound can be moved to a violation without a change of the code's error."""
    C, d = inequalities(p)
    y = rest_point(p, network)
    before, silent, k = code_error(p, network, y), 0, len(p.h)
    for row in range(len(d)):
        bound = d.copy()
        bound[row] = C[row] @ y[: p.size] - 1.0
        # A lower bound above the upper one is no problem to pose, but the error is still defined.
        h, upper, lower = np.split(bound, [k, k + p.size])
        after = np.empty(len(y))
        optimality(network.numbers(), p.parts._replace(h=h, lower=-lower, upper=upper), y, after)
        silent += bool(np.abs(after - before).max() < 1e-9 * network.factor)
    return silent


_GRID = np.linspace(-0.4, 0.4, 161)
