"""3-D scene of a welding cell: the whole job as an animation with live manipulability."""

from __future__ import annotations

from collections.abc import Sequence

import meshcat.geometry as mg
import meshcat.transformations as mt
import numpy as np
import pinocchio as pin
from meshcat.animation import Animation

from ..welding import ROBOTS, Cell
from .ellipsoids import ROBOT_COLORS
from .scene3d import Scene3D
from .style import ORANGE

_GREY = 0x888888
_BAR = 0.08  # width of a bar of manipulability [m]
_FULL = 0.6  # its height at full scale [m]
#: Meshcat's cylinders point along y.
_ALONG = {0: mt.rotation_matrix(np.pi / 2, [0, 0, 1]), 2: mt.rotation_matrix(np.pi / 2, [1, 0, 0])}


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
    return _JobScene(title, cell, q, centre, w / full_scale, every)


class _JobScene(Scene3D):
    def __init__(
        self,
        title: str,
        cell: Cell,
        q: np.ndarray,
        centre: np.ndarray,
        heights: np.ndarray,
        every: int,
    ) -> None:
        super().__init__(title, camera=(0.7, -3.2, 2.0))
        for k, (name, color) in enumerate(zip(ROBOTS, ROBOT_COLORS, strict=True)):
            self.add_arm(name, cell.arms[k], q[k, 0], pin.SE3(cell.bases[k]), color)
            bar = self._vis[f"{name} bar"]
            material = mg.MeshLambertMaterial(color=int(color.removeprefix("#"), 16))
            bar.set_object(mg.Box([_BAR, _BAR, _FULL]), material)
        floor = mt.translation_matrix([0.0, 0.0, -0.01])
        self.add_box("floor", np.array([3.4, 3.4, 0.02]), floor, "#dddddd")
        self._add_workpiece(cell)
        self._animate(cell, q, centre, heights, every)

    def _add_workpiece(self, cell: Cell) -> None:
        node = self._vis["workpiece"]
        material = mg.MeshLambertMaterial(color=_GREY, opacity=0.7, transparent=True)
        shapes = zip(cell.pipe_cores, cell.pipe_radii, strict=True)
        for k, ((start, end), radius) in enumerate(shapes):
            axis = int(np.argmax(abs(end - start)))
            length = float(np.linalg.norm(end - start)) + 2 * radius * (axis == 0)
            node[f"pipe{k}"].set_object(mg.Cylinder(length, radius), material)
            middle = mt.translation_matrix(0.5 * (start + end))
            node[f"pipe{k}"].set_transform(middle @ _ALONG[axis])
        closed = np.vstack([cell.seam, cell.seam[:1]]).T.astype(np.float32)
        line = mg.LineBasicMaterial(color=int(ORANGE.removeprefix("#"), 16), linewidth=3)
        node["seam"].set_object(mg.Line(mg.PointsGeometry(np.ascontiguousarray(closed)), line))

    def _animate(
        self, cell: Cell, q: np.ndarray, centre: np.ndarray, heights: np.ndarray, every: int
    ) -> None:
        animation = Animation(default_framerate=12)
        pieces = cell.piece_pose(centre)
        self._vis["workpiece"].set_transform(pieces[0])
        for frame in range(0, cell.count + 1, every):
            n = frame % cell.count
            view = animation.at_frame(self._vis, frame)
            view["workpiece"].set_transform(pieces[n])
            for k, name in enumerate(ROBOTS):
                for joint, pose in _joint_poses(cell, k, q[k, n]):
                    view[f"{name}/joint{joint}"].set_transform(pose)
                view[f"{name} bar"].set_transform(_bar_pose(cell.bases[k], heights[k, n]))
        for k, name in enumerate(ROBOTS):
            self._vis[f"{name} bar"].set_transform(_bar_pose(cell.bases[k], heights[k, 0]))
        self._vis.set_animation(animation, repetitions=1000)


def _bar_pose(base: np.ndarray, share: float) -> np.ndarray:
    """The bar rises out of the floor as far as its share of the full height."""
    outward = base[:2, 3] / np.linalg.norm(base[:2, 3])
    return mt.translation_matrix([*(base[:2, 3] + 0.35 * outward), (share - 0.5) * _FULL])


def _joint_poses(cell: Cell, robot: int, q: np.ndarray) -> Sequence[tuple[int, np.ndarray]]:
    model = cell.arms[robot].model
    data = model.createData()
    pin.forwardKinematics(model, data, q)
    return [(joint, data.oMi[joint].homogeneous) for joint in range(1, model.njoints)]
