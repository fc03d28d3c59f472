"""The same arm with other capsules, or with another frame as its flange."""

from __future__ import annotations

from collections.abc import Callable
from copy import copy

import numpy as np
import pinocchio as pin

from ..arms.arm import Arm
from ..arms.chain import chain_of


def reshaped(
    arm: Arm,
    geometry: Callable[[], pin.GeometryModel],
    name: str | None = None,
    flange: tuple[str, pin.SE3] | None = None,
) -> Arm:
    """The joints of an arm with other capsules; all else that is known of it stays.

    Parameters
    ----------
    geometry : callable
        Makes the capsules, fixed to the joints of the model.
    flange : (str, pinocchio.SE3), optional
        Name and pose, in the frame of the flange, of the frame that becomes the flange.
    """
    made = copy(arm)
    made.__dict__.pop("geometry", None)
    made._build_geometry, made.name = geometry, name or arm.name
    if flange is not None:
        made.model = arm.model.copy()
        at, (frame, pose) = arm.model.frames[arm.flange_id], flange
        kind = pin.FrameType.OP_FRAME
        made._flange = made.model.addFrame(
            pin.Frame(frame, at.parentJoint, arm.flange_id, at.placement * pose, kind)
        )
        made.__dict__.pop("_wrist_geometry", None)
        made.chain = chain_of(made.name, made.model, made.flange_id)
    made._data = made.model.createData()
    return made


def stretched(arm: Arm) -> float:
    """Length of the way from the base over all joint origins to the flange [m]."""
    model = arm.model
    steps = [*model.jointPlacements[1:], model.frames[arm.flange_id].placement]
    return float(sum(np.linalg.norm(step.translation) for step in steps))
