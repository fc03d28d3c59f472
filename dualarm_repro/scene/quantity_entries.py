"""The numbers of scene files: names, lengths, angles, points and poses as pydantic types."""

from __future__ import annotations

from typing import Annotated

import numpy as np
import pinocchio as pin
from pydantic import BeforeValidator, Field, StringConstraints

from ..arms.angle import EXPECTED, Angle

Name = Annotated[str, StringConstraints(pattern=r"^[A-Za-z][A-Za-z0-9_-]*$", max_length=60)]
BodyName = Annotated[str, StringConstraints(min_length=1)]
Number = Annotated[float, Field(strict=True, allow_inf_nan=False)]
Length = Annotated[float, Field(strict=True, gt=0, allow_inf_nan=False)]
Radians = Annotated[
    float,
    BeforeValidator(lambda value: float(Angle.parse(value))),
    Field(description=EXPECTED, json_schema_extra={"type": ["number", "string"]}),
]
Joints = list[Radians]
Point = tuple[Number, Number, Number]
Size = tuple[Length, Length, Length]
Rpy = tuple[Radians, Radians, Radians]
UPRIGHT = (0.0, 0.0, 0.0)


def pose_of(xyz: Point, rpy: Rpy) -> pin.SE3:
    """The pose of a position and the angles of R = Rz(yaw) Ry(pitch) Rx(roll)."""
    return pin.SE3(pin.rpy.rpyToMatrix(*rpy), np.array(xyz))
