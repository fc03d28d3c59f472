"""The bodies of a scene, sorted into the arrays that the distance kernels read."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Literal, NamedTuple

import numpy as np
import pinocchio as pin

from ..arms.arm import Arm
from .hull import ConvexHull
from .moving import MovingArm, MovingShape
from .posing import links_of
from .shapes import Box, Capsule, HalfSpace, Shape, Sphere

Sort = Literal["capsule", "box", "plane", "hull"]


@dataclass(frozen=True, eq=False)
class PlacedArm:
    """A controlled arm, the pose of its base in the world and, for a planner, start and goal [rad]."""

    name: str
    arm: Arm
    placement: pin.SE3 = field(default_factory=pin.SE3.Identity)
    start: np.ndarray | None = None
    goal: np.ndarray | None = None


class Body(NamedTuple):
    """One link or obstacle.

    ``owner`` is the arm or obstacle it belongs to, ``row`` its place in the arrays of its sort,
    ``joint`` the joint of a controlled arm that carries it (else None); ``still``: it never moves.
    """

    name: str
    owner: str
    sort: Sort
    row: int
    joint: int | None
    still: bool


@dataclass(frozen=True, eq=False)
class Bodies:
    """All bodies and their constant data; the rows of what moves hold its local coordinates.

    Attributes
    ----------
    all : tuple of Body
        Controlled arms first.
    cores : ndarray (C, 2, 3)
    radius : ndarray (C,)
    boxes : ndarray (B, 3, 4)
    half : ndarray (B, 3)
    planes : ndarray (P, 4)
    hulls : tuple of ConvexHull
    """

    all: tuple[Body, ...]
    cores: np.ndarray
    radius: np.ndarray
    boxes: np.ndarray
    half: np.ndarray
    planes: np.ndarray
    hulls: tuple[ConvexHull, ...]

    def rows(self, owner: str, sort: Sort) -> list[int]:
        """Rows of one owner among the bodies of one sort."""
        return [body.row for body in self.all if body.owner == owner and body.sort == sort]


def collect(
    arms: Iterable[PlacedArm],
    solids: Mapping[str, Sequence[Shape]],
    moving: Mapping[str, MovingShape | MovingArm],
) -> Bodies:
    """Bodies of controlled arms, moving arms and shapes, and standing obstacles."""
    bodies: list[Body] = []
    data: dict[Sort, list] = {"capsule": [], "box": [], "plane": [], "hull": []}

    def add(name: str, owner: str, sort: Sort, item: object, joint: int | None, still: bool) -> None:
        bodies.append(Body(name, owner, sort, len(data[sort]), joint, still))
        data[sort].append(item)

    def add_arm(owner: str, arm: Arm, controlled: bool) -> None:
        links = links_of(arm)
        for name, joint, *core in zip(*links, strict=True):
            still = joint == 0
            add(f"{owner}/{name}", owner, "capsule", core, int(joint) if controlled else None, still)

    def add_shape(name: str, owner: str, shape: Shape, still: bool) -> None:
        match shape:
            case Sphere() | Capsule():
                add(name, owner, "capsule", (shape.core, shape.radius), None, still)
            case Box():
                add(name, owner, "box", (shape.pose, shape.half), None, still)
            case HalfSpace():
                add(name, owner, "plane", shape.plane, None, still)
            case ConvexHull():
                add(name, owner, "hull", shape, None, still)

    for placed in arms:
        add_arm(placed.name, placed.arm, controlled=True)
    for name, mover in moving.items():
        if isinstance(mover, MovingArm):
            add_arm(name, mover.arm, controlled=False)
        else:
            add_shape(name, name, mover.shape, still=False)
    for owner, shapes in solids.items():
        for k, shape in enumerate(shapes):
            add_shape(owner if len(shapes) == 1 else f"{owner}/{k}", owner, shape, still=True)
    return Bodies(
        tuple(bodies),
        np.array([core for core, _ in data["capsule"]]).reshape(-1, 2, 3),
        np.array([radius for _, radius in data["capsule"]]),
        np.array([pose for pose, _ in data["box"]]).reshape(-1, 3, 4),
        np.array([half for _, half in data["box"]]).reshape(-1, 3),
        np.array(data["plane"]).reshape(-1, 4),
        tuple(data["hull"]),
    )
