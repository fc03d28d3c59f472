"""Starts and goals as a file writes them: joint angles, a position, a pose, a pose with a free
axis."""

from __future__ import annotations

from typing import Annotated, Any, Literal

import numpy as np
import pinocchio as pin
from pydantic import Discriminator, Field, Tag, model_validator

from ..datafiles import StrictModel
from .quantity_entries import Joints, Number, Point, Radians, Rpy

Tool = Literal["radial", "down"]
Elbow = Literal["up", "down"]
Axis = Literal["x", "y", "z"]
Quaternion = tuple[Number, Number, Number, Number]


class PostureEntry(StrictModel):
    """A position of the flange, or of the tip of its tool, and what else the posture is to fulfil.

    With ``rpy`` or ``quaternion`` it is a pose in the world; ``free`` names the axis of the flange
    about which it may turn. With ``tool`` the last joint points along a direction.
    """

    position: Point
    rpy: Rpy | None = Field(default=None, description="orientation of the flange in the world")
    quaternion: Quaternion | None = Field(default=None, description="the same as x, y, z, w")
    free: Axis | None = Field(
        default=None, description="axis of the flange about which the pose may turn"
    )
    tool: Tool | Point | None = Field(default=None, description="without: any direction will do")
    elbow: Elbow | None = Field(default=None, description="only with tool")
    last_joint: Radians = Field(default=0.0, description="only with tool")
    reference: Joints | None = Field(
        default=None, description="of several postures take the nearest"
    )
    best_effort: bool = Field(
        default=False, description="go as near as the arm can; only with a position alone"
    )

    @model_validator(mode="after")
    def _one_way(self) -> PostureEntry:
        if self.best_effort and self.tool is not None:
            raise ValueError("best_effort without tool")
        if [self.rpy, self.quaternion, self.tool].count(None) < 2:
            raise ValueError("one of rpy, quaternion and tool")
        if self.free is not None and self.rpy is None and self.quaternion is None:
            raise ValueError("free with rpy or quaternion")
        if self.best_effort and self.rotation is not None:
            raise ValueError("best_effort without rpy or quaternion")
        if self.quaternion and not 0.99 < np.linalg.norm(self.quaternion) < 1.01:
            raise ValueError("a quaternion of length one")
        return self

    @property
    def rotation(self) -> np.ndarray | None:
        """R of the pose (3, 3), if one is asked for."""
        if self.rpy is not None:
            return pin.rpy.rpyToMatrix(*self.rpy)
        if self.quaternion is None:
            return None
        given = np.array(self.quaternion)
        return pin.Quaternion(given / np.linalg.norm(given)).matrix()


def _kind(value: Any) -> str:
    return "joints" if isinstance(value, list | tuple) else "posture"


# Told apart beforehand, so that an error speaks of what was meant.
Configuration = Annotated[
    Annotated[Joints, Tag("joints")] | Annotated[PostureEntry, Tag("posture")],
    Discriminator(_kind),
]
