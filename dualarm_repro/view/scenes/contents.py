"""Everything a scene shows, before it is drawn: parts on nodes, their motion, marks with names."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np

#: Tapered capsule (two radii, length), rod (radius, height), box (three edges), triangles, cloud
#: (diameter) and polyline (width); capsule and rod lie along z around their middle.
Kind = Literal["tapered", "rod", "box", "mesh", "points", "line"]
#: The node that never moves.
WORLD = "world"


@dataclass(frozen=True, eq=False)
class Part:
    """One coloured shape, fixed to a node.

    Attributes
    ----------
    size : tuple of float
        What :data:`Kind` says of the kind [m].
    pose : ndarray (4, 4)
        In the frame of the node.
    body : str or None
        The checked body that it draws; it turns red while that body is in contact.
    vertices, faces : ndarray (V, 3), (F, 3)
        Of triangles; a cloud and a polyline have vertices only.
    """

    node: str
    kind: Kind
    size: tuple[float, ...]
    color: str
    pose: np.ndarray = field(default_factory=lambda: np.eye(4))
    opacity: float = 1.0
    body: str | None = None
    vertices: np.ndarray | None = None
    faces: np.ndarray | None = None


@dataclass(frozen=True, eq=False)
class Mark:
    """A name shown beside a point of a node."""

    text: str
    node: str
    point: np.ndarray


@dataclass(eq=False)
class Motion:
    """Poses of nodes at key frames, which are indices of the paths they come from."""

    frames: np.ndarray
    fps: int
    poses: dict[str, np.ndarray] = field(default_factory=dict)


@dataclass(eq=False)
class Contents:
    """A scene as data.

    Attributes
    ----------
    nodes : dict of ndarray (4, 4)
        Pose in the world of each node when nothing has moved yet.
    checked : list of Part
        The capsules that distances are computed with, shown on demand.
    tips : dict of ndarray (N, 3)
        Way of the flange of each arm that moves [m].
    columns : bool
        Whether an arm stands on a column, of which nothing is known but that it reaches the floor.
    note : str
        What else a reader has to know to read the picture.
    """

    title: str
    direction: np.ndarray
    grid: bool
    nodes: dict[str, np.ndarray] = field(default_factory=lambda: {WORLD: np.eye(4)})
    parts: list[Part] = field(default_factory=list)
    checked: list[Part] = field(default_factory=list)
    marks: list[Mark] = field(default_factory=list)
    tips: dict[str, np.ndarray] = field(default_factory=dict)
    motion: Motion | None = None
    nearest: Any = None
    floor: float | None = None
    columns: bool = False
    note: str = ""

    def pose(self, node: str, frame: int | None = None) -> np.ndarray:
        """Pose (4, 4) of a node at a key frame, counted from zero; None: before any motion."""
        if frame is not None and self.motion and node in self.motion.poses:
            return self.motion.poses[node][frame]
        return self.nodes[node]

    def poses(self, node: str) -> np.ndarray:
        """All poses (F, 4, 4) that a node takes."""
        if self.motion and node in self.motion.poses:
            return self.motion.poses[node]
        return self.nodes[node][np.newaxis]
