"""Postures in which the pull of a goal and the push of obstacles balance for some ratio of gains.

0 = F_att + F_rep = zeta (a + r p) with r = eta_0/zeta > 0 has a solution r at a posture if and only
if a and p are opposed: a/|a| + p/|p| = 0. The ratio then is r = |a|/|p|, and there is no other. So
the search for an equilibrium over all ratios is one for postures and goals that oppose both forces,
by nonlinear least squares within bounds from several starts (M. A. Branch, T. F. Coleman, Y. Li,
SIAM J. Sci. Comput. 21, 1999).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np
import scipy

from ...differences import central_differences
from ..field.joint_attraction import conic_force
from .search_field import repulsive_torque_at
from .search_problem import SearchProblem

#: Posture and goal (nq,) of a point of the space that is searched; None where there are none.
Placing = Callable[[np.ndarray], tuple[np.ndarray, np.ndarray] | None]
_EVALUATIONS = 20
_DIFFERENCE = 1e-5
#: Residual per joint where there is no posture: the largest that there is.
_NOWHERE = 2.0


@dataclass(frozen=True, eq=False)
class Equilibrium:
    """How near forces come to a balance.

    Attributes
    ----------
    q, goal : ndarray
        Posture and goal (nq,) [rad].
    angle : float
        Between attraction and the opposite of repulsion [rad]; 0 in an equilibrium.
    ratio : float
        eta_0/zeta at which both are as large; infinite where nothing repels.
    curvature : float
        Smallest eigenvalue of the second derivatives of U/zeta at that ratio: an equilibrium with a
        negative one is left by every search.
    """

    q: np.ndarray
    goal: np.ndarray
    angle: float
    ratio: float
    curvature: float


def opposed(made: SearchProblem, q: np.ndarray, goal: np.ndarray) -> np.ndarray:
    """a/|a| + p/|p| (nq,): zero if the forces balance at some ratio of the gains."""
    pull, push = _forces(made, q, goal)
    return _unit(pull) + _unit(push)


def equilibrium_at(made: SearchProblem, q: np.ndarray, goal: np.ndarray) -> Equilibrium:
    """The forces of a search at posture ``q`` on the way to ``goal`` (nq,) [rad]."""
    pull, push = _forces(made, q, goal)
    ratio = float(np.linalg.norm(pull) / np.linalg.norm(push)) if push.any() else np.inf
    half = min(0.5 * float(np.linalg.norm(_unit(pull) + _unit(push))), 1.0)

    def force(at: np.ndarray) -> np.ndarray:
        near, far = _forces(made, at, goal)
        return near + ratio * far

    curvature = np.nan
    if np.isfinite(ratio):
        matrix = -central_differences(force, q, _DIFFERENCE)
        curvature = float(np.linalg.eigvalsh(0.5 * (matrix + matrix.T))[0])
    return Equilibrium(q, goal, 2.0 * float(np.arcsin(half)), ratio, curvature)


def nearest_equilibria(
    made: SearchProblem,
    place: Placing,
    starts: Iterable[np.ndarray],
    bounds: tuple[np.ndarray, np.ndarray],
) -> list[Equilibrium]:
    """What few steps of descent reach from each start (n,) within ``bounds`` that can be placed.

    Near an equilibrium if there is one around, and no proof that there is none elsewhere.
    """

    def residual(x: np.ndarray) -> np.ndarray:
        placed = place(x)
        return np.full(len(made.start), _NOWHERE) if placed is None else opposed(made, *placed)

    found = []
    for start in starts:
        if place(start) is not None:
            best = scipy.optimize.least_squares(
                residual, start, bounds=bounds, max_nfev=_EVALUATIONS
            )
            placed = place(best.x)
            found += [] if placed is None else [equilibrium_at(made, *placed)]
    return found


def _forces(made: SearchProblem, q: np.ndarray, goal: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Attraction and repulsion (nq,) with both gains one."""
    pull = made.settings.attraction
    push = repulsive_torque_at(made, q) / made.settings.repulsion.gain
    return conic_force(q, goal, 1.0, pull.threshold, pull.measure), push


def _unit(force: np.ndarray) -> np.ndarray:
    size = np.linalg.norm(force)
    return force / size if size > 0.0 else np.zeros_like(force)
