"""How a torch meets the fillet: work angle, travel angle, and the way in and out of a weld."""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from .cell import WELDER, Cell
from .motion import flange_poses, held_poses
from .objective import Objective
from .placement import Jobs, Placement
from .seam import Seam

_STEPS = 12


class TorchAngles(NamedTuple):
    """Angles of the torch along a job (N,) [rad]; both 0: in the middle of the fillet.

    ``work``: from the bisector of the fillet, in the plane across the seam, positive towards the
    main pipe. ``travel``: lean along the seam, positive where the torch points ahead.
    """

    work: np.ndarray
    travel: np.ndarray


def torch_angles(cell: Cell, jobs: Jobs, seam: Seam) -> TorchAngles:
    """Angles of the torch against the fillet, both from the joint angles of the first job.

    Parameters
    ----------
    seam : Seam
        The seam of the cell with its normals.
    """
    local = cell.flanges[WELDER][0][:3, :3].T @ cell.torch_axis[0]
    axis = flange_poses(cell, jobs, WELDER)[:, :3, :3] @ local
    held = held_poses(cell, jobs, 0)[:, :3, :3]
    a = np.einsum("nji,nj->ni", held, axis)  # out of the tip, in the frame of the workpiece
    b, t = -seam.bisector, seam.tangent
    across = np.cross(t, b)
    towards_main = np.sign(np.sum(across * -seam.normal_main, axis=1, keepdims=True))
    x, y, z = (np.sum(a * part, axis=1) for part in (b, across * towards_main, t))
    return TorchAngles(np.arctan2(y, x), np.arcsin(np.clip(z, -1.0, 1.0)))


def retract(cell: Cell, centre: np.ndarray, point: int, length: float) -> Jobs:
    """The way out along the torch from a seam point and back in, the workpiece at rest.

    Its status says whether the arms reach it within limits, away from singularities and free of
    contact; the seam points of the result are those of the way.

    Parameters
    ----------
    centre : ndarray (3,)
        Position of the workpiece [m].
    length : float
        How far the tip is drawn back [m].
    """
    far = length * np.concatenate([np.linspace(0, 1, _STEPS), np.linspace(1, 0, _STEPS)[1:-1]])
    still = [np.repeat(cell.flanges[k, point : point + 1], len(far), axis=0) for k in range(3)]
    still[WELDER][:, :3, 3] -= far[:, np.newaxis] * cell.torch_axis[point]
    way = replace(
        cell,
        rotations=np.repeat(cell.rotations[point : point + 1], len(far), axis=0),
        flanges=np.stack(still),
        references=np.repeat(cell.references[:, point : point + 1], len(far), axis=1),
        torch_axis=np.repeat(cell.torch_axis[point : point + 1], len(far), axis=0),
        seam=np.repeat(cell.seam[point : point + 1], len(far), axis=0),
    )
    return Placement(way, Objective(weights="equal")).jobs([centre])
