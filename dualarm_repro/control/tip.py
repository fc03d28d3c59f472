"""An arm whose tip is not its flange: a point further along the axis of the flange."""

from __future__ import annotations

import numpy as np
import pinocchio as pin

from ..arms.arm import Arm
from ..errors import InputError


def with_tip(arm: Arm, ahead: float) -> Arm:
    """r(q) = p(q) + ahead z(q), with p and z the flange and its axis; links and capsules stay.

    Parameters
    ----------
    ahead : float
        Distance of the tip from the flange [m], as of the fingertips of a hand.

    Raises
    ------
    InputError
        NaN, infinity or a negative distance.
    """
    if not (np.isfinite(ahead) and ahead >= 0.0):
        raise InputError("with_tip", "ahead", ahead, "a distance in metres, zero or more")
    forward = pin.SE3(np.eye(3), np.array([0.0, 0.0, ahead]))
    return arm.reshaped(lambda: arm.geometry, flange=("tip", forward))
