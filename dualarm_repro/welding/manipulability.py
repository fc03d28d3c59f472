"""Manipulability in closed form, of one arm and of a cell."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from ..arguments import checked
from ..arms import Arm
from ..arms.wrist_geometry import wrist_geometry
from ..errors import UnknownNameError
from ..kernel import kernel

PAIR_MEASURES = ("product", "geometric_mean")


@checked
def closed_form(arm: Arm, q: ArrayLike) -> np.ndarray:
    """w = |det J| = l_2 l_3 |sin phi| |x_w| |sin q_5'| of six joints with a spherical wrist.

    The Jacobian at the wrist centre is block-triangular. phi is the angle between upper arm and
    forearm, x_w the coordinate of the wrist centre in the plane of the arm, measured from axis 1,
    and sin q_5' = z_4 . (z_5 x z_6), the sine of q_5 up to its zero and to the twists of the wrist.
    Neither q_1, q_4, q_6 nor the length of a tool has a part in it.
    T. Yoshikawa, Manipulability of robotic mechanisms, IJRR 4(2), 1985, for the measure.

    Parameters
    ----------
    q : ndarray (N, 6) [rad]

    Returns
    -------
    ndarray (N,)
        [m^3]

    Raises
    ------
    UnsupportedArmError
        The arm has no spherical wrist.
    """
    return manipulabilities(
        wrist_geometry(arm.name, arm.chain), np.atleast_2d(arm.configurations(q))
    )


@kernel
def manipulabilities(geometry, q):
    """The closed form for rows q (N, 6) -> (N,)."""
    out = np.empty(len(q))
    upper, fore = geometry.upper_arm, geometry.forearm
    scale = upper[0] * fore[0] * geometry.twists[0][0] * geometry.twists[1][0]
    for n in range(len(q)):
        pitch = q[n, 1] + geometry.elbow_sign * q[n, 2]
        s2, c2, s3, c3 = math.sin(q[n, 1]), math.cos(q[n, 1]), math.sin(pitch), math.cos(pitch)
        sine2, cosine2 = s2 * upper[2] + c2 * upper[1], c2 * upper[2] - s2 * upper[1]
        sine3, cosine3 = s3 * fore[2] + c3 * fore[1], c3 * fore[2] - s3 * fore[1]
        elbow = sine3 * cosine2 - cosine3 * sine2
        out_of_axis = geometry.shoulder[0] + upper[0] * sine2 + fore[0] * sine3
        sine, cosine = geometry.turn
        wrist = sine * math.cos(q[n, 4]) + cosine * math.sin(q[n, 4])
        out[n] = abs(scale * elbow * out_of_axis * wrist)
    return out


def tight_measure(first: np.ndarray, second: np.ndarray, measure: str = "product") -> np.ndarray:
    """M_tight = w_1 w_2, the measure of diag(J_1, J_2), or its square root.

    Parameters
    ----------
    measure : str
        One of :data:`PAIR_MEASURES`; the geometric mean has the unit of one measure.

    Raises
    ------
    UnknownNameError
        No such measure.
    """
    if measure not in PAIR_MEASURES:
        expected = f"one of {', '.join(PAIR_MEASURES)}"
        raise UnknownNameError("tight_measure", "measure", measure, expected)
    product = first * second
    return product if measure == "product" else np.sqrt(product)


def weighted_measure(
    tight: np.ndarray, loose: np.ndarray, beta_tight: np.ndarray, beta_loose: np.ndarray
) -> np.ndarray:
    """MMR = (beta_1 M_tight + beta_2 M_loose) / (beta_1 + beta_2)."""
    return (beta_tight * tight + beta_loose * loose) / (beta_tight + beta_loose)
