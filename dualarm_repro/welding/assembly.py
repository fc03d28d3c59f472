"""From arms, a workpiece of two pipes and tools to the cell whose placement is sought."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated

import numpy as np

from ..arguments import Shape, checked
from ..arms import Arm
from ..arms.poses import homogeneous
from ..errors import InputError, UnknownNameError
from .cell import ROBOTS, WELDER, Cell
from .posture import flat_rotations
from .seam import Seam, saddle_seam
from .tooling import Torch, grasp_pose, torch_axes, torch_flanges, with_tool

BASE_READINGS = ("inverted", "literal")
#: Points of the carriers whose velocities their ellipsoids describe: the origin of the workpiece,
#: common to both, the end of the pipe that each holds, or its own flange.
CARRIER_REFERENCES = ("workpiece_origin", "pipe_end", "own_flange")


@checked
@dataclass(frozen=True)
class Workpiece:
    """Main pipe along x, branch along z from its middle, lengths in metres."""

    radius_main: float
    radius_branch: float
    length: float
    branch_length: float
    seam_points: int

    def __post_init__(self) -> None:
        for name in ("length", "branch_length"):
            if not getattr(self, name) > 0:
                raise InputError("workpiece", name, getattr(self, name), "a positive length [m]")

    @property
    def seam(self) -> Seam:
        """Where the pipes meet."""
        return saddle_seam(self.radius_main, self.radius_branch, self.seam_points)

    @property
    def axes(self) -> np.ndarray:
        """Ends of the axes of main pipe and branch (2, 2, 3) [m]."""
        half, top = 0.5 * self.length, self.radius_main + self.branch_length
        return np.array([[[-half, 0, 0], [half, 0, 0]], [[0, 0, 0], [0, 0, top]]])

    @property
    def cores(self) -> np.ndarray:
        """Cores (4, 2, 3) of capsules that contain the pipes, flat ends included [m].

        The main pipe is a capsule of its radius R that ends with it and, at c = (l - R) / 2 on both
        sides, a ball through the rim and the circle where that capsule begins to narrow, of radius
        sqrt(R^2 + (l/2 - c)^2); the branch is a capsule as long as its axis.
        """
        half = max(0.5 * self.length - self.radius_main, 0.0)
        ball = max(0.5 * (self.length - self.radius_main), 0.0)
        axis = np.array([[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]])
        return np.stack([half * axis, self.axes[1], ball * axis[[0, 0]], ball * axis[[1, 1]]])

    @property
    def radii(self) -> np.ndarray:
        """Their radii (4,) [m]."""
        rim = float(np.hypot(self.radius_main, 0.5 * self.length - self.cores[3, 0, 0]))
        return np.array([self.radius_main, self.radius_branch, rim, rim])


@checked
@dataclass(frozen=True)
class Tools:
    """How the carriers grip and the welder reaches; names as in :mod:`.tooling`."""

    grasp: str
    gripper_length: float
    gripper_radius: float
    torch: Torch
    torch_axis: str

    def __post_init__(self) -> None:
        if not self.gripper_length > 0:
            raise InputError(
                "tools", "gripper_length", self.gripper_length, "a positive length [m]"
            )


@checked
def base_poses(matrices: Annotated[np.ndarray, Shape("K", 4, 4)], reading: str) -> np.ndarray:
    """Poses of the bases in the world from the matrices M that a document gives them.

    The product ^B_c T = ^B_w T ^w_c T needs ^B_w T: M^-1 if M is the pose of the base in the world
    (``inverted``), M if it maps world to base coordinates (``literal``); the pose is the inverse.

    Parameters
    ----------
    matrices : ndarray (K, 4, 4)

    Raises
    ------
    UnknownNameError
        No such reading.
    """
    if reading not in BASE_READINGS:
        expected = f"one of {', '.join(BASE_READINGS)}"
        raise UnknownNameError("base_poses", "reading", reading, expected)
    if reading == "inverted":
        return matrices
    try:
        found = np.linalg.inv(matrices)
    except np.linalg.LinAlgError:
        found = np.full_like(matrices, np.nan)
    if not np.isfinite(found).all():  # entries so large that their products are infinite as well
        expected = "matrices that have an inverse"
        raise InputError("base_poses", "matrices", matrices, expected)
    return found


@checked
def assemble(
    arms: Sequence[Arm],
    bases: Annotated[np.ndarray, Shape(3, 4, 4)],
    workpiece: Workpiece,
    posture: str,
    tools: Tools,
    *,
    floor: float | None,
    threshold: float,
    reference: str = CARRIER_REFERENCES[0],
) -> Cell:
    """The cell of two carriers and a welder.

    Each carrier holds the end of the main pipe on its own side; the workpiece turns about its
    origin so that the current seam point is flat, and the tip of the torch stays on that point.
    The velocity ellipsoid of the welder is that of the tip of the torch.

    Parameters
    ----------
    arms : three arms
        Two carriers, then the welder.
    bases : ndarray (3, 4, 4)
        Poses of their bases in the world [m].
    posture : str
        A key of :data:`.posture.POSTURES`.
    floor : float or None
        Height of the floor [m].
    threshold : float
        Manipulability [m^3] at or below which a configuration counts as singular.
    reference : str
        One of :data:`CARRIER_REFERENCES`; it matters to the volumes of their ellipsoids only.

    Raises
    ------
    UnknownNameError
        No such posture, grasp, torch axis or reference.
    InputError
        Another number of arms or bases than three.
    """
    if len(arms) != len(ROBOTS):
        raise InputError("assemble", "number of arms", len(arms), f"3: {', '.join(ROBOTS)}")
    if reference not in CARRIER_REFERENCES:
        expected = f"one of {', '.join(CARRIER_REFERENCES)}"
        raise UnknownNameError("assemble", "reference", reference, expected)
    seam = workpiece.seam
    rotations = flat_rotations(seam, posture)
    torch = tools.torch
    towards = bases[WELDER, :2, 3]
    tips = np.einsum("nij,nj->ni", rotations, seam.points)
    bisector = np.einsum("nij,nj->ni", rotations, seam.bisector)
    turned = homogeneous(rotations, np.zeros(3))
    size = 0.5 * workpiece.length, workpiece.radius_main
    sides = [tuple(base[:2, 3]) for base in bases[:WELDER]]
    grasps = [grasp_pose(tools.grasp, side, *size, tools.gripper_length) for side in sides]
    axes = torch_axes(tools.torch_axis, bisector, towards)
    flanges = [*(turned @ grasp for grasp in grasps), torch_flanges(tips, axes, towards, torch)]
    gripper = np.array([[[0.0, 0.0, 0.0], [0.0, 0.0, tools.gripper_length]]])
    first, second = (with_tool(arm, gripper, tools.gripper_radius) for arm in arms[:WELDER])
    match reference:
        case "workpiece_origin":
            points = [np.zeros_like(tips)] * 2
        case "pipe_end":
            points = [np.sign(x) * turned[:, :3, 0] * size[0] for x, _ in sides]
        case _:
            points = [flange[:, :3, 3] for flange in flanges[:WELDER]]
    return Cell(
        arms=(first, second, with_tool(arms[WELDER], torch.cores, torch.radius)),
        bases=bases,
        rotations=rotations,
        flanges=np.stack(flanges),
        references=np.stack([*points, tips]),
        torch_axis=np.array(axes),
        seam=seam.points,
        pipe_axes=workpiece.axes,
        pipe_cores=workpiece.cores,
        pipe_radii=workpiece.radii,
        floor=floor,
        threshold=threshold,
    )
