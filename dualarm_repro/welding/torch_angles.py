"""How a torch meets the fillet: work angle, travel angle, and the way in and out of a weld."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import NamedTuple

import numpy as np

from .cell import WELDER, Cell
from .motion import flange_poses, held_poses
from .objective import Objective
from .placement import Jobs, Placement
from .seam import Seam

_STEPS = 12
_STILL, _QUARTER = 1e-6, 0.5 * np.pi  # [rad], how far joints at rest and those of the welder may go


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


@dataclass(frozen=True, eq=False, kw_only=True)
class _FromPosture(Cell):
    """A cell whose joints stay near those of a posture (3, 6), so on its branch [rad]."""

    posture: np.ndarray

    def limits(self, robot: int) -> tuple[np.ndarray, np.ndarray]:
        low, high = super().limits(robot)
        start, way = self.posture[robot], _QUARTER if robot == WELDER else _STILL
        return np.maximum(low, start - way), np.minimum(high, start + way)


def retract(cell: Cell, jobs: Jobs, point: int, length: float) -> Jobs:
    """The way out along the torch from a seam point and back in, the workpiece at rest.

    It begins with the joints that the first job has at that point. Its status says whether the
    welder can go on from there within limits and a quarter turn of every joint, away from
    singularities and free of contact; the seam points of the result are those of the way.

    Parameters
    ----------
    jobs : Jobs
        The weld, every robot of which has a path.
    length : float
        How far the tip is drawn back [m].
    """
    far = length * np.concatenate([np.linspace(0, 1, _STEPS), np.linspace(1, 0, _STEPS)[1:-1]])

    def held(values: np.ndarray) -> np.ndarray:
        return np.repeat(values[point : point + 1], len(far), axis=0)

    still = np.stack([held(flanges) for flanges in cell.flanges])
    still[WELDER][:, :3, 3] -= far[:, np.newaxis] * cell.torch_axis[point]
    there = replace(
        cell,
        rotations=held(cell.rotations),
        flanges=still,
        references=np.stack([held(points) for points in cell.references]),
        torch_axis=held(cell.torch_axis),
        seam=held(cell.seam),
    )
    given = {one.name: getattr(there, one.name) for one in fields(Cell) if one.init}
    way = _FromPosture(**given, posture=jobs.q[0, :, point])
    return Placement(way, Objective(weights="equal")).jobs(jobs.centres[:1])
