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
from .....ledger.captions import captions
from .....ledger.formula import Formula, parse
from ...document import SEED
from ...problems import sample_problem
from ...reading import network_settings

checks = partial(REGISTRY.checks, page="patent/network")
caption = captions(__file__)
#: A problem, a network and its state.
State = tuple[QuadraticProgram, NetworkSettings, np.ndarray]
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
    worst = max(_apart(code_error(*at), lagrangian_gradient(*at)) for at in _states())
    return Result(
        obtained={"gradient": worst},
        caption=caption("eq_lagrangian", states=_STATES, penalties=len(Penalty)),
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
    apart = [float(np.abs(y[: p.size] - minimiser(p, n)).max()) for p, n, y in _rests()]
    return Result(obtained={"apart": max(apart)}, caption=caption("eq_kkt", penalties=len(apart)))


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
    away = max(_apart(_sides(printed, at), lagrangian_gradient(*at)) for at in _states())
    rest = max(float(np.abs(_sides(printed, at)).max()) for at in _rests())
    return Result(
        obtained={"derivatives": away, "at_rest": rest},
        caption=caption("eq_matrix", printed=printed.text),
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
        _apart(printed.value(0, {"xi": code_error(*at)}), printed.value(1, _named(at)))
        for at in _states()
    )
    rest = max(float(np.abs(printed.value(1, _named(at))).max()) for at in _rests())
    return Result(
        obtained={"compiled": worst, "at_minimiser": rest},
        caption=caption("eq_error", printed=printed.text, penalties=len(Penalty)),
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
    return Result(obtained={"derivative": worst}, caption=caption("eq_matrix_defs"))


def _rests() -> list[State]:
    """Each form of the penalty at rest; the exponential with p s = 1, so that it is near g = 0."""
    p, usual = sample_problem(), NetworkSettings().factor
    factors = {"exponential": 1e-3, "softplus": 1e2}
    networks = [NetworkSettings(penalty=name, factor=factors.get(name, usual)) for name in Penalty]
    return [(p, network, rest_point(p, network)) for network in networks]


def _states() -> list[State]:
    """Random states about the rest point of each form."""
    rng = np.random.default_rng(SEED)
    return [
        (p, network, y + 1e-3 * rng.normal(size=len(y)))
        for p, network, y in _rests()
        for _ in range(_STATES)
    ]


def _apart(found: np.ndarray, expected: np.ndarray) -> float:
    return float(np.abs(found - expected).max() / max(np.abs(expected).max(), 1e-12))


def _named(at: State) -> dict[str, np.ndarray]:
    """The names of the printed equations."""
    return dict(zip(("E", "y", "e"), blocks(*at), strict=True))


def _sides(printed: Formula, at: State) -> np.ndarray:
    """Left side less right side."""
    given = _named(at)
    return np.asarray(printed.value(0, given) - printed.value(1, given))
