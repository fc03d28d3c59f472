"""The same arm with other capsules, or with another frame as its flange."""

from __future__ import annotations

from collections.abc import Callable

import pinocchio as pin

from ..arms.arm import Arm


def reshaped(
    arm: Arm,
    geometry: Callable[[], pin.GeometryModel],
    name: str | None = None,
    flange: tuple[str, pin.SE3] | None = None,
) -> Arm:
    """The joints of an arm with other capsules.

    Parameters
    ----------
    geometry : callable
        Makes the capsules, fixed to the joints of the model.
    flange : (str, pinocchio.SE3), optional
        Name and pose, in the frame of the flange, of the frame that becomes the flange.
    """
    model, at = arm.model, arm.model.frames[arm.flange_id]
    frame = at.name
    if flange is not None:
        model, (frame, pose) = model.copy(), flange
        kind = pin.FrameType.OP_FRAME
        model.addFrame(pin.Frame(frame, at.parentJoint, arm.flange_id, at.placement * pose, kind))
    return Arm(name or arm.name, arm.title, model, frame, geometry)
