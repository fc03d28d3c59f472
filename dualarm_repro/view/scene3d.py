"""Static 3-D scenes: arms drawn from their capsules, obstacles, point clouds, paths, motion."""

from __future__ import annotations

from html import escape

import meshcat.geometry as mg
import meshcat.transformations as mt
import numpy as np
import pinocchio as pin
from meshcat.animation import Animation

from ..arms import Arm
from .static_meshcat import page_iframe, standalone_html, static_visualizer

#: Meshcat's cylinders point along y, coal's capsules along z.
_Y_TO_Z = mt.rotation_matrix(np.pi / 2, np.array([1.0, 0.0, 0.0]))


class Scene3D:
    """A scene that the reader can turn, built from primitives so that it stays small.

    Parameters
    ----------
    title
        Shown below the scene and to screen readers: what is to be seen.
    camera
        Position of the camera in the world frame, metres.
    grid
        Whether the floor grid is drawn; its cells of half a metre suit large arms.
    """

    def __init__(
        self,
        title: str,
        camera: tuple[float, float, float],
        height: int = 420,
        grid: bool = True,
    ) -> None:
        self.title, self._height = title, height
        self._vis = static_visualizer()
        self._vis["/Background"].set_property("top_color", [1.0, 1.0, 1.0])
        self._vis["/Background"].set_property("bottom_color", [0.93, 0.94, 0.96])
        self._vis["/Grid"].set_property("visible", grid)
        x, y, z = camera
        # Inside the camera's node y points up.
        self._vis["/Cameras/default/rotated/<object>"].set_property("position", [x, z, -y])

    def add_arm(
        self,
        name: str,
        arm: Arm,
        q: np.ndarray,
        placement: pin.SE3 | None = None,
        color: str = "#0072B2",
        opacity: float = 1.0,
    ) -> None:
        """Draw an arm at a configuration: a node per joint, a capsule per collision geometry."""
        material = _material(color, opacity)
        node = self._vis[name]
        node.set_transform((placement or pin.SE3.Identity()).homogeneous)
        for geometry in arm.geometry.geometryObjects:
            capsule = geometry.geometry
            part = node[f"joint{geometry.parentJoint}"][geometry.name]
            part.set_transform(geometry.placement.homogeneous)
            length = 2.0 * capsule.halfLength
            part["tube"].set_object(mg.Cylinder(length, capsule.radius), material)
            part["tube"].set_transform(_Y_TO_Z)
            for side, offset in (("lower", -0.5), ("upper", 0.5)):
                part[side].set_object(mg.Sphere(capsule.radius), material)
                part[side].set_transform(
                    mt.translation_matrix(np.array([0.0, 0.0, offset * length]))
                )
        for joint, pose in _joint_poses(arm, q).items():
            node[f"joint{joint}"].set_transform(pose)

    def animate(
        self, arms: dict[str, tuple[Arm, np.ndarray]], fps: int = 20, every: int = 3
    ) -> None:
        """Move arms drawn before along their paths, played in a loop with a time slider.

        Parameters
        ----------
        arms
            Name of the arm in the scene to the arm and its path (N, nq).
        every
            Only each ``every``-th configuration becomes a key frame.
        """
        animation = Animation(default_framerate=fps)
        for name, (arm, path) in arms.items():
            for frame in sorted({*range(0, len(path), every), len(path) - 1}):
                view = animation.at_frame(self._vis, frame)
                for joint, pose in _joint_poses(arm, path[frame]).items():
                    view[f"{name}/joint{joint}"].set_transform(pose)
        self._vis.set_animation(animation, repetitions=1000)

    def add_points(self, name: str, points: np.ndarray, color: str, size: float = 0.02) -> None:
        """Draw a cloud of points (N, 3)."""
        colors = np.tile(np.array(_rgb(color), dtype=np.float32)[:, None], len(points))
        positions = np.ascontiguousarray(points.T, dtype=np.float32)
        self._vis[name].set_object(mg.PointCloud(positions, colors, size=size))

    def add_path(self, name: str, points: np.ndarray, color: str) -> None:
        """Draw a polyline through points (N, 3)."""
        positions = np.ascontiguousarray(points.T, dtype=np.float32)
        material = mg.LineBasicMaterial(color=_number(color), linewidth=3)
        self._vis[name].set_object(mg.Line(mg.PointsGeometry(positions), material))

    def add_box(self, name: str, size: np.ndarray, pose: np.ndarray, color: str) -> None:
        """Draw a box of edge lengths ``size`` at a homogeneous ``pose``."""
        lengths = [float(length) for length in size]
        self._vis[name].set_object(mg.Box(lengths), _material(color, 1.0))
        self._vis[name].set_transform(np.asarray(pose, dtype=float))

    def add_mesh(
        self, name: str, vertices: np.ndarray, faces: np.ndarray, color: str, opacity: float = 1.0
    ) -> None:
        """Draw a surface of triangles ``faces`` (F, 3), rows of ``vertices`` (V, 3)."""
        mesh = mg.TriangularMeshGeometry(np.asarray(vertices), np.asarray(faces))
        self._vis[name].set_object(mesh, _material(color, opacity))

    def add_sphere(self, name: str, center: np.ndarray, radius: float, color: str) -> None:
        """Draw a sphere."""
        self._vis[name].set_object(mg.Sphere(float(radius)), _material(color, 0.8))
        self._vis[name].set_transform(mt.translation_matrix(np.asarray(center, dtype=float)))

    def html(self) -> str:
        """The scene as one file that needs no network."""
        return standalone_html(self._vis, self.title)

    def page_html(self) -> str:
        """The scene for a page of the book, with its title as a caption."""
        frame = page_iframe(self._vis, self.title, self._height)
        caption = f"{escape(self.title)} Drag to turn, scroll to zoom."
        return f'<figure class="ledger-figure">{frame}<figcaption>{caption}</figcaption></figure>'


def _rgb(color: str) -> tuple[float, float, float]:
    """Red, green and blue in [0, 1] of a ``#rrggbb`` colour."""
    number = _number(color)
    red, green, blue = (((number >> shift) & 255) / 255 for shift in (16, 8, 0))
    return red, green, blue


def _number(color: str) -> int:
    return int(color.removeprefix("#"), 16)


def _material(color: str, opacity: float) -> mg.MeshLambertMaterial:
    return mg.MeshLambertMaterial(color=_number(color), opacity=opacity, transparent=opacity < 1.0)


def _joint_poses(arm: Arm, q: np.ndarray) -> dict[int, np.ndarray]:
    """Poses of the joints that carry geometry, in the base frame."""
    data = arm.model.createData()
    pin.forwardKinematics(arm.model, data, np.asarray(q, dtype=float))
    joints = {geometry.parentJoint for geometry in arm.geometry.geometryObjects}
    return {joint: data.oMi[joint].homogeneous for joint in sorted(joints)}
