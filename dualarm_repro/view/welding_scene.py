"""3-D scene of a welding cell: the whole job as an animation with live manipulability."""

from __future__ import annotations

import numpy as np
import pinocchio as pin

from ..scene.pair_kernels import capsules_capsules
from ..welding import ROBOTS, Cell
from ..welding.separation import Separation
from .ellipsoids import ROBOT_COLORS
from .scene3d import Scene3D
from .scenes.contents import Part
from .scenes.nearest import Nearest, nearest_of
from .style import ORANGE

_GREY = "#888888"
_BAR = 0.08  # width of a bar of manipulability [m]
_FULL = 0.6  # its height at full scale [m]


def job_scene(
    title: str,
    cell: Cell,
    q: np.ndarray,
    centre: np.ndarray,
    w: np.ndarray,
    full_scale: float,
    every: int = 3,
) -> Scene3D:
    """The robots follow the seam; the bar beside each base has the height of its manipulability.

    Parameters
    ----------
    q : ndarray (3, N, 6) [rad]
    w : ndarray (3, N)
        Manipulabilities [m^3].
    full_scale : float
        Manipulability drawn as the full height of a bar [m^3].
    """
    made = Scene3D(title, camera=(0.7, -3.2, 2.0))
    made.contents.floor = cell.floor
    made.contents.note = "Bars beside the bases: manipulability."
    closed = np.concatenate([q, q[:, :1]], axis=1)
    arms = {}
    for k, (name, color) in enumerate(zip(ROBOTS, ROBOT_COLORS, strict=True)):
        made.add_arm(name, cell.arms[k], q[k, 0], pin.SE3(cell.bases[k]), color)
        arms[name] = (cell.arms[k], closed[k])
    made.animate(arms, fps=12, every=every)
    made.contents.tips.clear()  # the seam says more than the ways of the flanges
    motion = made.contents.motion
    frames = (motion.frames if motion else np.array([0])) % cell.count
    _add_workpiece(made, cell)
    made.move("workpiece", cell.piece_pose(centre)[frames])
    for k, (name, color) in enumerate(zip(ROBOTS, ROBOT_COLORS, strict=True)):
        bar = f"{name} bar"
        heights = (w[k] / full_scale)[frames]
        made.move(bar, np.array([_bar_pose(cell.bases[k], share) for share in heights]))
        made.contents.parts.append(Part(bar, "box", (_BAR, _BAR, _FULL), color))
    made.contents.nearest = _nearest(cell, q, centre, frames)
    return made


def _add_workpiece(made: Scene3D, cell: Cell) -> None:
    parts = made.contents.parts
    for (start, end), radius in zip(cell.pipe_axes, cell.pipe_radii[:2], strict=True):
        length = float(np.linalg.norm(end - start))
        z = np.array([0.0, 0.0, 1.0])
        turn = pin.Quaternion.FromTwoVectors(z, (end - start) / np.linalg.norm(end - start))
        pose = pin.SE3(turn.matrix(), 0.5 * (start + end)).homogeneous
        parts.append(Part("workpiece", "rod", (float(radius), length), _GREY, pose, 0.7))
    line = np.vstack([cell.seam, cell.seam[:1]])
    parts.append(Part("workpiece", "line", (1.0,), ORANGE, vertices=line))


def _nearest(cell: Cell, q: np.ndarray, centre: np.ndarray, frames: np.ndarray) -> Nearest:
    """The pairs that the checks of the cell watch, the floor apart."""
    watched = Separation(cell)
    ends = watched.cores(q[np.newaxis], centre[np.newaxis])[frames]
    rows, bodies = watched.pairs.rows["capsule"], watched.bodies
    distance = np.empty((len(ends), len(rows)))
    witness = np.empty((*distance.shape, 3, 3))
    capsules_capsules(ends, bodies.radius, rows, distance, witness, 0)
    return nearest_of(distance, witness[..., 0, :], witness[..., 1, :], watched.pairs.bodies)


def _bar_pose(base: np.ndarray, share: float) -> np.ndarray:
    """The bar rises out of the floor as far as its share of the full height."""
    pose = np.eye(4)
    outward = base[:2, 3] / np.linalg.norm(base[:2, 3])
    pose[:3, 3] = [*(base[:2, 3] + 0.35 * outward), (share - 0.5) * _FULL]
    return pose
