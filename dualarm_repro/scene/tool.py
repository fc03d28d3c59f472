"""An arm with something at its flange: a tool or a part it carries, as capsules that collide."""

from __future__ import annotations

from collections.abc import Sequence

import pinocchio as pin

from ..arms.arm import Arm
from ..arms.capsules import enclosing_capsules
from ..errors import InputError
from .shapes import HalfSpace, Shape

TIP = "tool tip"


def with_tool(arm: Arm, shapes: Sequence[Shape], tip: pin.SE3 | None = None) -> Arm:
    """The arm with capsules around ``shapes``, which are given in the frame of its flange.

    Parameters
    ----------
    tip : pinocchio.SE3, optional
        Pose of the tool centre point in the frame of the flange; it becomes the flange of the arm,
        to which positions and poses of goals refer.

    Raises
    ------
    InputError
        A half-space, which has no end.
    """
    flange, bodies = arm.model.frames[arm.flange_id], pin.GeometryModel()
    for k, shape in enumerate(shapes):
        if isinstance(shape, HalfSpace):
            raise InputError(f"arm {arm.name}", "tool", "halfspace", "a shape with an end")
        geometry, at = shape.coal()
        pose = flange.placement * pin.SE3(at.getRotation(), at.getTranslation())
        one = pin.GeometryObject(f"tool_{k}", flange.parentJoint, pose, geometry)
        bodies.addGeometryObject(one)

    def carried() -> pin.GeometryModel:
        made = arm.geometry.copy()
        for one in enclosing_capsules(bodies).geometryObjects:
            made.addGeometryObject(one)
        return made

    return arm.reshaped(carried, f"{arm.name} with tool", None if tip is None else (TIP, tip))
