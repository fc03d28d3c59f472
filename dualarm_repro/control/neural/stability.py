"""Why the error decays from every state: the steps of the proof, as numbers to be checked.

V = |xi|^2 / 2 has dV/dt = -gamma e^t sum xi_i Psi(xi_i) <= 0, with equality at xi = 0 alone, where

1. Psi is odd and increasing, so that u Psi(u) > 0 for u != 0;
2. H = I + C^T P'' C has no eigenvalue below 1, since P is convex;
3. M = [H A^T; A 0] is regular where A has full row rank, so that dy/dt exists and
   d xi/dt = M dy/dt + dF/dt is what was asked for (Benzi, Golub and Liesen 2005, Theorem 3.2).

On a problem that stands still every entry of xi then falls on its own, whatever y was at the start.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...settings import code
from ..problem import QuadraticProgram
from .activation import Activation, activation
from .network_settings import NetworkSettings
from .penalised import state_matrix


class Steps(NamedTuple):
    """What each step of the proof rests on at a state.

    ``least_eigenvalue`` of H, ``least_singular`` value of A and of M, and the number of negative
    eigenvalues of M, which is that of the equalities.
    """

    least_eigenvalue: float
    least_singular_task: float
    least_singular: float
    negative: int


def proof_steps(p: QuadraticProgram, network: NetworkSettings, y: np.ndarray) -> Steps:
    """Steps 2 and 3 at a state y (n + m,)."""
    M = state_matrix(p, network, y)
    return Steps(
        float(np.linalg.eigvalsh(M[: p.size, : p.size]).min()),
        float(np.linalg.svd(p.A, compute_uv=False).min()),
        float(np.linalg.svd(M, compute_uv=False).min()),
        int((np.linalg.eigvalsh(M) < 0.0).sum()),
    )


def odd_and_increasing(form: Activation, reach: float = 3.0) -> tuple[float, float]:
    """Step 1 on a grid over [-reach, reach]: largest |Psi(u) + Psi(-u)| by the largest
    |Psi|, and smallest increase."""
    grid = np.linspace(-reach, reach, 1201)
    values = np.array([activation(code(form), u) for u in grid])
    odd = np.abs(values + values[::-1]).max() / np.abs(values).max()
    return float(odd), float(np.diff(values).min())
