"""Central differences, (f(x + h e_j) - f(x - h e_j)) / 2h, beside which derivatives are judged."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray


def central_differences(
    function: Callable[[NDArray[np.float64]], ArrayLike], x: ArrayLike, step: float = 1e-6
) -> NDArray[np.float64]:
    """Derivative of a function of a vector, with an error of O(h^2) and round-off of O(eps / h).

    Parameters
    ----------
    function
        Of ``x`` (n,), with a value of any shape.
    step : float
        h, in units of ``x``.

    Returns
    -------
    array (n, ...)
        Row j holds the derivative of the value by x_j.
    """
    at = np.asarray(x, dtype=float)
    shifts = step * np.eye(len(at))
    ahead = np.array([function(at + shift) for shift in shifts])
    return (ahead - np.array([function(at - shift) for shift in shifts])) / (2.0 * step)
