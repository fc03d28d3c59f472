"""A welding cell: two carriers that hold a workpiece, a welder that follows its seam."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Annotated

import numpy as np
from pydantic import Field

from ..arguments import Rows3, Shape, Vector3, checked
from ..arms import Arm
from ..arms.poses import homogeneous
from ..arms.wrist_geometry import WristGeometry, wrist_geometry
from ..errors import InputError

ROBOTS = ("carrier 1", "carrier 2", "welder")
WELDER = 2
#: Index among :data:`ROBOTS`.
Robot = Annotated[int, Field(ge=0, le=2)]


@checked
@dataclass(frozen=True, eq=False)
class Cell:
    """Everything about the job except where it takes place.

    All poses of the job are given in world axes with the workpiece origin C at zero; a placement
    moves them to C.

    Attributes
    ----------
    arms : (Arm, Arm, Arm)
        Two carriers and the welder, with the capsules of their tools.
    bases : ndarray (3, 4, 4)
        Poses of the bases in the world [m].
    rotations : ndarray (N, 3, 3)
        Rotation of the workpiece at each seam point.
    flanges : ndarray (3, N, 4, 4)
        Poses of the flanges.
    references : ndarray (3, N, 3)
        The points whose velocities the ellipsoids describe [m].
    torch_axis : ndarray (N, 3)
        Unit vector out of the tip of the torch, in world axes.
    seam : ndarray (N, 3)
        Seam points in the frame of the workpiece [m].
    pipe_axes : ndarray (2, 2, 3)
        Ends of the axes of main pipe and branch in the frame of the workpiece [m].
    pipe_cores : ndarray (K, 2, 3)
        Cores of the capsules that contain the pipes, in the same frame [m]; those of both pipes
        come first.
    pipe_radii : ndarray (K,)
        [m]
    floor : float or None
        Height of the floor [m].
    threshold : float
        Manipulability [m^3] at or below which a configuration counts as singular.
    joint_limits : bool
        Whether the limits of the arms count.

    Raises
    ------
    InputError
        Arrays that do not fit each other.
    UnsupportedArmError
        An arm without spherical wrist.
    """

    arms: tuple[Arm, Arm, Arm]
    bases: Annotated[np.ndarray, Shape(3, 4, 4)]
    rotations: Annotated[np.ndarray, Shape("N", 3, 3)]
    flanges: Annotated[np.ndarray, Shape(3, "N", 4, 4)]
    references: Annotated[np.ndarray, Shape(3, "N", 3)]
    torch_axis: Rows3
    seam: Rows3
    pipe_axes: Annotated[np.ndarray, Shape(2, 2, 3)]
    pipe_cores: Annotated[np.ndarray, Shape("K", 2, 3)]
    pipe_radii: Annotated[np.ndarray, Shape("K")]
    floor: float | None
    threshold: float
    joint_limits: bool = True
    geometries: tuple[WristGeometry, ...] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        count = len(self.rotations)
        if count < 3:
            raise InputError("cell", "seam points", count, "at least 3")
        found = tuple(wrist_geometry(arm.name, arm.chain) for arm in self.arms)
        object.__setattr__(self, "geometries", found)

    @property
    def count(self) -> int:
        """Number of seam points N."""
        return len(self.rotations)

    @checked
    def limits(self, robot: Robot) -> tuple[np.ndarray, np.ndarray]:
        """Lower and upper joint limits of a robot (6,) [rad]."""
        return self.arms[robot].limits(self.joint_limits)

    def unlimited(self) -> Cell:
        """The same cell without joint limits and without a threshold of singularity."""
        return replace(self, joint_limits=False, threshold=0.0)

    @cached_property
    def lever_arms(self) -> np.ndarray:
        """From each flange to its reference point, in world axes (3, N, 3) [m]."""
        return self.references - self.flanges[..., :3, 3]

    @checked
    def seam_in_world(self, centre: Vector3) -> np.ndarray:
        """p_w = C + R(theta) p_c at each seam point (N, 3) [m]."""
        return centre + np.einsum("nij,nj->ni", self.rotations, self.seam)

    @checked
    def piece_pose(self, centre: Vector3) -> np.ndarray:
        """^w_c T = [R(theta), C; 0, 1] at each seam point (N, 4, 4) [m]."""
        return homogeneous(self.rotations, centre)
