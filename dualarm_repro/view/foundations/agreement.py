"""Three ways to the same kinematics: exact symbols, Pinocchio, and the compiled batch kernels."""

from __future__ import annotations

from collections.abc import Callable
from itertools import combinations

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import sympy as sp

from ...arms import Arm, dh
from ..card import figure_html
from ..page import Page
from ..style import BLUE, RED, house_style

OfOne = Callable[[np.ndarray], np.ndarray]  # a function of one configuration
_STEPS = np.logspace(-12, -0.5, 70)  # steps of the finite differences [rad]


def three_ways(arm: Arm, q: np.ndarray) -> pd.DataFrame:
    """Largest differences between the three implementations over the rows of ``q``.

    The exact Jacobian has the columns [dp/dq_j; vee(dR/dq_j R^T)] from derivatives of the symbolic
    pose; Pinocchio and the kernels build it from the joint axes.

    Returns
    -------
    DataFrame
        Index: the two implementations compared; columns: pose (entries in metres and without unit)
        and Jacobian.
    """
    pose, jacobian = _exact(arm)
    found = {
        "sympy": (np.array([pose(row) for row in q]), np.array([jacobian(row) for row in q])),
        "Pinocchio": (
            np.array([arm.fk(row) for row in q]),
            np.array([arm.jacobian(row) for row in q]),
        ),
        "batch kernel": (arm.fk(q), arm.jacobian(q)),
    }
    rows = {
        f"{a} − {b}": [np.abs(x - y).max() for x, y in zip(found[a], found[b], strict=True)]
        for a, b in combinations(found, 2)
    }
    return pd.DataFrame.from_dict(rows, orient="index", columns=["pose", "Jacobian"])


def finite_differences(arm: Arm, q: np.ndarray) -> pd.DataFrame:
    """Largest error of dp/dq by finite differences of the flange position, per step.

    Forward: (p(q + h e_j) - p(q)) / h; central: (p(q + h e_j) - p(q - h e_j)) / 2h.

    Returns
    -------
    DataFrame
        Index: step h [rad]; columns: forward, central [m/rad].
    """
    exact = arm.jacobian(q)[:, :3]
    errors = [(_error(arm, q, exact, h, 0.0), _error(arm, q, exact, h, h)) for h in _STEPS]
    return pd.DataFrame(errors, pd.Index(_STEPS, name="h"), ["forward", "central"])


def finite_differences_page(arm: Arm, q: np.ndarray) -> Page:
    """Error of finite differences against their step, with the best step of each scheme."""
    errors = finite_differences(arm, q)
    best = {scheme: (errors[scheme].idxmin(), errors[scheme].min()) for scheme in errors}
    with house_style():
        figure, ax = plt.subplots(figsize=(6.8, 3.8))
        for scheme, color in (("forward", RED), ("central", BLUE)):
            ax.loglog(errors.index, errors[scheme], color=color, label=scheme)
            ax.plot(*best[scheme], "o", color=color)
        ax.set(xlabel="step h [rad]", ylabel="largest error of dp/dq [m/rad]")
        ax.legend()
    (h1, e1), (h2, e2) = best["forward"], best["central"]
    alt = (
        "Log-log plot of the error of forward and central differences against the step: each falls "
        "to a minimum and rises again towards small steps, where rounding takes over."
    )
    caption = (
        f"{arm.title}, {len(q)} random configurations. Central differences come within {e2:.1e} "
        f"m/rad of the Jacobian at h = {h2:.0e} rad, forward differences within {e1:.1e} at "
        f"h = {h1:.0e}. Left of its minimum each curve is rounding, right of it truncation."
    )
    return Page(figure_html(figure, alt, caption))


def _error(arm: Arm, q: np.ndarray, exact: np.ndarray, ahead: float, behind: float) -> float:
    steps = np.eye(arm.nq)
    columns = [
        (arm.positions(q + ahead * e) - arm.positions(q - behind * e)) / (ahead + behind)
        for e in steps
    ]
    return float(np.abs(np.stack(columns, axis=2) - exact).max())


def _exact(arm: Arm) -> tuple[OfOne, OfOne]:
    """Functions of one q that evaluate the symbolic pose and Jacobian in double precision."""
    q = dh.joint_symbols(arm.nq)
    T = arm.symbolic_fk()
    evaluate = sp.lambdify([q], [T, *(T.diff(joint) for joint in q)], cse=True)

    def pose(row: np.ndarray) -> np.ndarray:
        return evaluate(row)[0]

    def jacobian(row: np.ndarray) -> np.ndarray:
        T, *derivatives = evaluate(row)
        spins = [dT[:3, :3] @ T[:3, :3].T for dT in derivatives]
        linear = np.column_stack([dT[:3, 3] for dT in derivatives])
        angular = np.column_stack([(w[2, 1], w[0, 2], w[1, 0]) for w in spins])
        return np.vstack([linear, angular])

    return pose, jacobian
