"""What the flanges carry: the grasps of two carriers and the torch of a welder."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, pi, sin

import numpy as np
import pinocchio as pin

from ..arguments import checked
from ..arms import Arm
from ..arms.capsules import segment_capsule
from ..arms.poses import homogeneous
from ..errors import InputError, UnknownNameError
from ..scene.tool import name_of_tool
from .posture import smallest_rotations

#: Grasp to the angle between the approach of the flange and the axis of the pipe [rad].
GRASPS = {"axial": 0.0, "diagonal": 0.25 * pi, "side": 0.5 * pi}
#: Axis of the torch in the world: against the bisector, or at 45 deg, leaning to the welder.
TORCH_AXES = ("along_bisector", "work_angle_45")
_DOWN = np.array([0.0, 0.0, -1.0])


@checked
@dataclass(frozen=True)
class Torch:
    """A torch bent in its middle.

    Attributes
    ----------
    length : float
        From the flange along the bent centre line to the tip [m].
    crank : float
        Angle of the bend [rad]; 0: straight.
    radius : float
        [m]
    exempt : float
        Length at the tip that is left out of its collision capsules [m].
    """

    length: float
    crank: float
    radius: float
    exempt: float

    def __post_init__(self) -> None:
        if not self.length > 0:
            raise InputError("torch", "length", self.length, "a positive length [m]")
        if not 0 <= self.exempt < self.length:
            raise InputError("torch", "exempt", self.exempt, "from 0 to less than its length")

    @property
    def rotation(self) -> np.ndarray:
        """Axes of the tip in the flange frame, Ry(crank); z points out of the torch."""
        c, s = cos(self.crank), sin(self.crank)
        return np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]])

    @property
    def centre_line(self) -> np.ndarray:
        """Flange, bend and tip in the flange frame (3, 3) [m]."""
        bend = np.array([0.0, 0.0, 0.5 * self.length])
        return np.array([np.zeros(3), bend, bend + 0.5 * self.length * self.rotation[:, 2]])

    @property
    def cores(self) -> np.ndarray:
        """Cores of its capsules along the bent line, without the exempt length (K, 2, 3) [m]."""
        flange, bend, _ = self.centre_line
        kept = self.length - self.exempt
        beyond = kept - 0.5 * self.length
        if beyond <= 0:
            return np.array([[flange, [0.0, 0.0, kept]]])
        return np.array([[flange, bend], [bend, bend + beyond * self.rotation[:, 2]]])


def torch_flanges(
    tips: np.ndarray, axes: np.ndarray, towards: np.ndarray, torch: Torch
) -> np.ndarray:
    """Poses of the welder's flange that put the tip at p with the torch along a.

    A torch that points down has its bend turned so that the flange leans towards the welder; from
    there the smallest rotation brings it to a, so that it never winds up.

    Parameters
    ----------
    tips, axes : ndarray (N, 3)
        p [m] and the unit vector a, in the world.
    towards : ndarray (2,)
        Horizontal direction from the workpiece to the welder.

    Returns
    -------
    ndarray (N, 4, 4)
    """
    x = np.append(towards, 0.0) / np.linalg.norm(towards)
    down = np.column_stack([x, np.cross(_DOWN, x), _DOWN])
    rotation = smallest_rotations(_DOWN, axes) @ down @ torch.rotation.T
    return homogeneous(rotation, tips - rotation @ torch.centre_line[2])


def torch_axes(name: str, bisector: np.ndarray, towards: np.ndarray) -> np.ndarray:
    """Axes a (N, 3) of the torch in the world, out of its tip.

    Parameters
    ----------
    name : str
        One of :data:`TORCH_AXES`.
    bisector : ndarray (N, 3)
        Bisector of the fillet in the world.

    Raises
    ------
    UnknownNameError
        No such axis.
    """
    if name == "along_bisector":
        return -bisector
    if name == "work_angle_45":
        lean = np.append(towards / np.linalg.norm(towards), 1.0) / np.sqrt(2.0)
        return np.broadcast_to(-lean, bisector.shape)
    raise UnknownNameError("torch_axes", "name", name, f"one of {', '.join(TORCH_AXES)}")


def grasp_pose(
    name: str, side: tuple[float, float], half_length: float, radius: float, gripper: float
) -> np.ndarray:
    """Pose of a carrier's flange in the workpiece frame, at one end of a pipe along x.

    The flange axis a points to the pipe end, at the angle of the grasp from the pipe's axis and in
    its horizontal plane; the flange is the gripper's length, and for a grasp on the mantle the
    radius, away from it.

    Parameters
    ----------
    name : str
        A key of :data:`GRASPS`.
    side : (float, float)
        Signs of the x and y of the carrier seen from the workpiece.
    half_length, radius, gripper : float
        [m]

    Returns
    -------
    ndarray (4, 4)

    Raises
    ------
    UnknownNameError
        No such grasp.
    """
    if name not in GRASPS:
        raise UnknownNameError("grasp_pose", "name", name, f"one of {', '.join(GRASPS)}")
    angle = GRASPS[name]
    x, y = np.sign(side)
    approach = np.array([-x * cos(angle), -y * sin(angle), 0.0])
    end = np.array([x * half_length, 0.0, 0.0])
    up = np.array([0.0, 0.0, 1.0])
    rotation = np.column_stack([up, np.cross(approach, up), approach])
    return homogeneous(rotation, end - (gripper + radius * sin(angle)) * approach)


def with_tool(arm: Arm, cores: np.ndarray, radius: float) -> Arm:
    """The arm with capsules fixed to its flange.

    Parameters
    ----------
    cores : ndarray (K, 2, 3)
        Core segments in the flange frame [m].
    """
    frame = arm.model.frames[arm.flange_id]

    def geometry() -> pin.GeometryModel:
        extended, name = arm.geometry.copy(), name_of_tool(arm)
        for k, (start, end) in enumerate(cores):
            placement, shape = segment_capsule(start, end, radius)
            placed = f"{name}_{k}", frame.parentJoint, frame.placement * placement, shape
            extended.addGeometryObject(pin.GeometryObject(*placed))
        return extended

    return arm.reshaped(geometry)
