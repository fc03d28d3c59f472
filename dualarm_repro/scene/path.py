"""Joint paths with samples so close that a check of the samples says something about the path."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import ArrayLike

from ..arguments import LATER, MOST, checked
from ..errors import InputError
from .moving import JointPath
from .quantities import positive


@checked
def densify(
    path: ArrayLike, max_step: Annotated[float, LATER], index: ArrayLike | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """Insert samples until no joint moves more than ``max_step`` between neighbours.

    q = q_k + i / m (q_(k+1) - q_k), i = 0 ... m-1, with m = ceil(max_j |dq_j| / max_step) pieces of
    equal length for each piece of the path; the samples of the path itself are kept exactly.

    Parameters
    ----------
    path : (M, nq)
        [rad]
    max_step : float
        [rad]
    index : (M,), optional
        Increasing, e.g. times; 0 ... M-1 if not given.

    Returns
    -------
    q : ndarray (K, nq)
    index : ndarray (K,)
        Interpolated in the same way, to be used as the time of moving obstacles.

    Raises
    ------
    InputError
        A wrong shape, NaN or infinity, an index that does not increase, a step not positive.
    """
    track = JointPath(path, index)
    step = positive("densify", "max_step", max_step, "rad")
    largest = np.abs(np.diff(track.configurations, axis=0)).max(axis=1, initial=0.0)
    if not (largest / step).sum() <= MOST:
        raise InputError("densify", "max_step", step, f"a step that needs at most {MOST} samples")
    pieces = np.maximum(np.ceil(largest / step).astype(int), 1)
    before = np.repeat(np.arange(len(pieces)), pieces)
    first = np.repeat(np.cumsum(pieces) - pieces, pieces)
    position = np.append(
        before + (np.arange(len(before)) - first) / pieces[before], len(track.index) - 1
    )
    time = np.interp(position, np.arange(len(track.index)), track.index)
    return track.at(time), time
