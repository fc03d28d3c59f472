"""From the penalised problem to E y = e: printed equations and compiled code at the same states."""

from __future__ import annotations

from functools import partial

import numpy as np

from .....control.neural.network_settings import NetworkSettings
from .....control.neural.penalised import (
    blocks,
    code_error,
    lagrangian_gradient,
    minimiser,
    rest_point,
    state_matrix,
)
from .....control.neural.penalty import Penalty
from .....control.problem import QuadraticProgram
from .....differences import central_differences
from .....ledger import REGISTRY, Assumed, NoOriginal, Residual, Result
from .....ledger.formula import Formula, parse
from ...document import SEED
from ...problems import sample_problem
from ...reading import network_settings

checks = partial(REGISTRY.checks, page="patent/network")
_STATES = 5  # random states about the rest point, for each form of the penalty


@checks(
    "patent.eq_lagrangian",
    rules=[
        Residual(
            "gradient",
            "the code's error is the derivative of the Lagrangian, share of the largest",
            high=1e-5,
        ),
        NoOriginal("formula", "the Lagrangian"),
    ],
)
def lagrange_function(assumed: Assumed) -> Result:
    """Differences of the Lagrangian, from values alone, against the error that the code drives."""
    worst = max(
        _apart(code_error(p, network, y), lagrangian_gradient(p, network, y))
        for p, network, y in _states()
    )
    return Result(
        obtained={"gradient": worst},
        caption=(
            "Objective with penalty, plus lambda times the equality: the words around the lost "
            f"formula leave no other. Its differences at {_STATES} states for each of "
            f"{len(Penalty)} penalties agree with the error that the compiled network drives to "
            f"zero to {worst:.1e} of the largest entry."
        ),
    )


@checks(
    "patent.eq_kkt",
    rules=[
        Residual(
            "apart",
            "where both derivatives vanish, from the minimiser found without them [rad/s]",
            high=1e-6,
        ),
        NoOriginal("formula", "the two derivatives"),
    ],
)
def optimality_conditions(assumed: Assumed) -> Result:
    """The zero of both derivatives against a minimiser of the objective along the equality."""
    p = sample_problem()
    apart = {
        name: float(np.abs(rest_point(p, n)[: p.size] - minimiser(p, n)).max())
        for name, n in _networks().items()
    }
    worst = max(apart.values())
    return Result(
        obtained={"apart": worst},
        caption=(
            "Where both derivatives vanish lies the minimiser: a descent of the penalised "
            "objective along the joint velocities that keep the tip velocity, which knows no "
            f"multiplier, ends within {worst:.1e} rad/s of it for each of {len(apart)} penalties."
        ),
    )


@checks(
    "patent.eq_matrix",
    rules=[
        Residual(
            "derivatives",
            "left side less right side is both derivatives of the Lagrangian, share",
            high=1e-5,
        ),
        Residual("at_rest", "where the network rests both sides agree, to", high=1e-6),
    ],
)
def matrix_form(assumed: Assumed) -> Result:
    """Both printed sides, with the blocks built anew, at random states and at rest."""
    printed = parse(REGISTRY.printed("patent.eq_matrix")["formula"])
    away = max(
        _apart(_sides(printed, p, network, y), lagrangian_gradient(p, network, y))
        for p, network, y in _states()
    )
    p = sample_problem()
    rest = max(
        float(np.abs(_sides(printed, p, network, rest_point(p, network))).max())
        for network in _networks().values()
    )
    return Result(
        obtained={"derivatives": away, "at_rest": rest},
        caption=(
            f"The printed {printed.text}, with E = [I, J^T; J, 0], y = [phi; lambda] and e = "
            "[-grad P; dr/dt] as blocks: at random states left less right differs from the "
            f"derivatives of the Lagrangian by {away:.1e} of the largest, and where the network "
            f"rests both sides agree to {rest:.1e}. Since P depends on phi, e depends on the "
            "unknown y: the equation is not linear."
        ),
    )


@checks(
    "patent.eq_error",
    rules=[
        Residual("compiled", "the code's error differs from the printed one", high=1e-9),
        Residual("at_minimiser", "and at the minimiser it is", high=1e-6),
    ],
)
def error_function(assumed: Assumed) -> Result:
    """xi of the code against the printed right side, with the blocks built anew."""
    printed = parse(REGISTRY.printed("patent.eq_error")["formula"])
    worst = max(
        _apart(
            printed.value(0, {"xi": code_error(p, network, y)}),
            printed.value(1, _named(p, network, y)),
        )
        for p, network, y in _states()
    )
    p = sample_problem()
    rest = max(
        float(np.abs(printed.value(1, _named(p, network, rest_point(p, network)))).max())
        for network in _networks().values()
    )
    return Result(
        obtained={"compiled": worst, "at_minimiser": rest},
        caption=(
            f"The error that the code drives to zero is the printed {printed.text}, to "
            f"{worst:.1e} of its size with the blocks built anew for {len(Penalty)} forms of "
            f"the penalty. At the minimiser the printed right side is {rest:.1e}."
        ),
    )


@checks(
    "patent.eq_matrix_defs",
    samples=8,
    rules=[
        Residual("derivative", "the state matrix is the derivative of the error by y", high=1e-5),
        NoOriginal("formula", "the blocks"),
    ],
)
def matrix_blocks(assumed: Assumed) -> Result:
    """The matrix in front of the state derivative against differences of xi by y."""
    network = network_settings(assumed, "state_matrix", "penalty_form")
    p = sample_problem()
    y = rest_point(p, NetworkSettings(penalty=network.penalty))
    M = state_matrix(p, network, y)
    differences = central_differences(lambda at: code_error(p, network, at), y, 1e-7).T
    worst = _apart(M, differences)
    return Result(
        obtained={"derivative": worst},
        caption=(
            "Differentiating the error by the state gives E with the Hessian of the penalty added "
            "to its identity block. The matrix used here differs from differences of the error by "
            f"{worst:.1e} of the largest entry; without the Hessian it would be E itself."
        ),
    )


def _networks() -> dict[str, NetworkSettings]:
    """Each form of the penalty; the exponential with p s = 1, so that its rest lies near g = 0."""
    factors = {"exponential": 1e-3, "softplus": 1e2}
    return {
        name: NetworkSettings(penalty=name, factor=factors.get(name, NetworkSettings().factor))
        for name in Penalty
    }


def _states() -> list[tuple[QuadraticProgram, NetworkSettings, np.ndarray]]:
    """Random states about the rest point of each form."""
    p, rng = sample_problem(), np.random.default_rng(SEED)
    size = p.size + len(p.b)
    return [
        (p, network, rest_point(p, network) + 1e-3 * rng.normal(size=size))
        for network in _networks().values()
        for _ in range(_STATES)
    ]


def _apart(found: np.ndarray, expected: np.ndarray) -> float:
    return float(np.abs(found - expected).max() / max(np.abs(expected).max(), 1e-12))


def _named(p: QuadraticProgram, network: NetworkSettings, y: np.ndarray) -> dict[str, np.ndarray]:
    """The names of the printed equations."""
    return dict(zip(("E", "y", "e"), blocks(p, network, y), strict=True))


def _sides(
    printed: Formula, p: QuadraticProgram, network: NetworkSettings, y: np.ndarray
) -> np.ndarray:
    """Left side less right side."""
    given = _named(p, network, y)
    return np.asarray(printed.value(0, given) - printed.value(1, given))
