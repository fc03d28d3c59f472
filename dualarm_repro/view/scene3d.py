"""3-D scenes: arms with shaped links, obstacles, clouds, paths and motion, as a picture that can be
turned and played.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pinocchio as pin

from ..arms import Arm
from ..planning.field.control_points import end_effector
from ..scene import Box, PlacedArm, Shape, Sphere
from .scenes.arm_parts import arm_parts, checked_parts
from .scenes.contents import WORLD, Contents, Mark, Motion, Part
from .scenes.finished import finished
from .scenes.markup import alone, figure
from .scenes.nearest import nearest_pairs
from .scenes.solid_parts import solid_part
from .scenes.urdf_meshes import visual_parts


class Scene3D:
    """A scene that the reader can turn; small, since shapes are sent as their sizes.

    Parameters
    ----------
    title
        Shown below the scene and to screen readers: what is to be seen.
    camera
        Direction from which it is seen, in the world frame; the distance follows from the action.
    height
        Not used any more: a scene is as high as its width asks for.
    grid
        Whether the floor is drawn.
    """

    def __init__(
        self,
        title: str,
        camera: tuple[float, float, float],
        height: int = 420,
        grid: bool = True,
    ) -> None:
        self.title = title
        self.contents = Contents(title, np.asarray(camera, dtype=float), grid)
        self._arms: dict[str, tuple[PlacedArm, np.ndarray]] = {}
        self._paths: dict[str, np.ndarray] = {}
        self._solids: dict[str, Shape] = {}

    def add_arm(
        self,
        name: str,
        arm: Arm,
        q: np.ndarray,
        placement: pin.SE3 | None = None,
        color: str = "#0072B2",
        opacity: float = 1.0,
    ) -> None:
        """Draw an arm at a configuration; a translucent one is not watched for contacts.

        Links are drawn within the capsules that are checked, an arm of the catalogue with the
        meshes of its description if their licence allows it.
        """
        made, placed = self.contents, PlacedArm(name, arm, placement or pin.SE3.Identity())
        base, q = f"{name}/0", arm.configurations(q)
        made.nodes[base] = placed.placement.homogeneous
        for node, pose in _joint_poses(placed, q).items():
            made.nodes[node] = pose
        meshes = visual_parts(name, arm, color, base) if opacity == 1.0 else []
        made.parts += meshes or arm_parts(name, arm, color, opacity, base)
        if opacity == 1.0:
            made.checked += checked_parts(name, arm, color, base)
            made.marks.append(Mark(name, base, np.zeros(3)))
            self._arms[name] = (placed, q)

    def animate(
        self, arms: dict[str, tuple[Arm, np.ndarray]], fps: int = 20, every: int = 3
    ) -> None:
        """Move arms drawn before along their paths, with a slider for the time.

        Parameters
        ----------
        arms
            Name of the arm in the scene to the arm and its path (N, nq).
        every
            Only each ``every``-th configuration becomes a key frame.
        """
        count = max((len(path) for _, path in arms.values()), default=0)
        if count < 2:
            return
        frames = np.array(sorted({*range(0, count, every), count - 1}))
        motion = self.contents.motion = Motion(frames, fps)
        for name, (_, path) in arms.items():
            placed, _ = self._arms[name]
            rows = np.asarray(path, dtype=float)[np.minimum(frames, len(path) - 1)]
            self._paths[name] = rows
            poses = [_joint_poses(placed, q) for q in rows]
            for node in poses[0]:
                motion.poses[node] = np.array([pose[node] for pose in poses])
            self.contents.tips[name] = end_effector(placed, path)

    def move(self, node: str, poses: np.ndarray) -> None:
        """Move a node of one's own along poses (F, 4, 4), one for each key frame."""
        self.contents.nodes.setdefault(node, poses[0])
        if self.contents.motion:
            self.contents.motion.poses[node] = poses

    def add_points(self, name: str, points: np.ndarray, color: str, size: float = 0.02) -> None:
        """Draw a cloud of points (N, 3)."""
        self._add("points", (float(size),), color, vertices=np.asarray(points, dtype=float))

    def add_path(self, name: str, points: np.ndarray, color: str) -> None:
        """Draw a polyline through points (N, 3)."""
        self._add("line", (1.0,), color, vertices=np.asarray(points, dtype=float))

    def add_box(
        self, name: str, size: np.ndarray, pose: np.ndarray, color: str, solid: bool = False
    ) -> None:
        """Draw a box of edge lengths ``size`` at a homogeneous ``pose``.

        ``solid``: an obstacle, to which distances are shown.
        """
        lengths, pose = np.asarray(size, dtype=float), np.asarray(pose, dtype=float)
        if solid:
            self._solids[name] = Box(pose[:3, 3], lengths, pose[:3, :3])
        self._add("box", tuple(lengths), color, pose=pose, body=name if solid else None)

    def add_mesh(
        self, name: str, vertices: np.ndarray, faces: np.ndarray, color: str, opacity: float = 1.0
    ) -> None:
        """Draw a surface of triangles ``faces`` (F, 3), rows of ``vertices`` (V, 3)."""
        at = np.asarray(vertices, dtype=float)
        self._add("mesh", (), color, opacity=opacity, vertices=at, faces=np.asarray(faces))

    def add_sphere(
        self, name: str, center: np.ndarray, radius: float, color: str, solid: bool = False
    ) -> None:
        """Draw a sphere; one that is no obstacle marks a place and is named if it has no number."""
        pose, center = np.eye(4), np.asarray(center, dtype=float)
        pose[:3, 3] = center
        if solid:
            self._solids[name] = Sphere(center, float(radius))
        elif not any(letter.isdigit() for letter in name):
            self.contents.marks.append(Mark(name, WORLD, center))
        size = (float(radius), float(radius), 0.0)
        body = name if solid else None
        self._add("tapered", size, color, pose=pose, opacity=0.8 if solid else 1.0, body=body)

    def add_solid(self, name: str, shape: Shape, color: str) -> None:
        """Draw an obstacle, to which distances are shown."""
        self.contents.parts.append(solid_part(name, shape, color))
        self._solids[name] = shape

    def html(self) -> str:
        """The scene as one file that needs no network."""
        return str(alone(self.title, self._figure()))

    def page_html(self) -> str:
        """The scene for a page of the book, with its title as a caption."""
        return str(self._figure())

    def _add(self, kind: Any, size: tuple[float, ...], color: str, **how: Any) -> None:
        self.contents.parts.append(Part(WORLD, kind, size, color, **how))

    def _figure(self) -> Any:
        made = self.contents
        if made.nearest is None and self._arms and (made.motion or self._solids):
            motion = made.motion
            count = len(motion.frames) if motion else 1
            paths = {
                name: (placed, self._paths.get(name, np.tile(q, (count, 1))))
                for name, (placed, q) in self._arms.items()
            }
            made.nearest = nearest_pairs(paths, self._solids)
        return figure(*finished(made, list(self._arms.values())))


def _joint_poses(placed: PlacedArm, q: np.ndarray) -> dict[str, np.ndarray]:
    """World poses of the joints of an arm by the name of their node."""
    data = placed.arm.model.createData()
    pin.forwardKinematics(placed.arm.model, data, np.asarray(q, dtype=float))
    return {
        f"{placed.name}/{joint}": (placed.placement * data.oMi[joint]).homogeneous
        for joint in range(1, placed.arm.model.njoints)
    }
