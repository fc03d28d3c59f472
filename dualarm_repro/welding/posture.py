"""How the workpiece is turned so that the current seam point lies flat."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..arguments import checked
from ..errors import InputError, UnknownNameError
from .seam import Seam

_UP = np.array([0.0, 0.0, 1.0])

#: Rule to the direction of the workpiece that is turned upwards; None: the workpiece stays.
POSTURES: dict[str, Callable[[Seam], np.ndarray] | None] = {
    "bisector": lambda seam: seam.bisector,
    "main_pipe_normal": lambda seam: seam.normal_main,
    "constant": None,
}


@checked
def flat_rotations(seam: Seam, rule: str) -> np.ndarray:
    """R(theta) with R n(theta) = e_z by the smallest rotation, n given by the rule.

    Parameters
    ----------
    rule : str
        A key of :data:`POSTURES`.

    Returns
    -------
    ndarray (N, 3, 3)

    Raises
    ------
    UnknownNameError
        No such rule.
    """
    if rule not in POSTURES:
        raise UnknownNameError("flat_rotations", "rule", rule, f"one of {', '.join(POSTURES)}")
    direction = POSTURES[rule]
    if direction is None:
        return np.broadcast_to(np.eye(3), (len(seam.theta), 3, 3)).copy()
    return smallest_rotations(direction(seam), _UP)


def smallest_rotations(start: np.ndarray, end: np.ndarray) -> np.ndarray:
    """R = I + [v]x + [v]x^2 / (1 + c), v = a x b, c = a . b: the rotation a -> b about v.

    Rodrigues' formula with the angle eliminated.

    Parameters
    ----------
    start, end : ndarray (..., 3)
        Unit vectors a and b; their leading axes broadcast.

    Returns
    -------
    ndarray (..., 3, 3)

    Raises
    ------
    InputError
        Opposite vectors, for which every half turn is as small as any other.
    """
    start, end = np.broadcast_arrays(start, end)
    cosine = np.sum(start * end, axis=-1)
    if (cosine < -1.0 + 1e-9).any():
        raise InputError("smallest rotation", "cosine", float(cosine.min()), "vectors not opposite")
    x, y, z = np.moveaxis(np.cross(start, end), -1, 0)
    zero = np.zeros_like(x)
    skew = np.stack([zero, -z, y, z, zero, -x, -y, x, zero], axis=-1).reshape(*x.shape, 3, 3)
    return np.eye(3) + skew + skew @ skew / (1.0 + cosine)[..., np.newaxis, np.newaxis]
