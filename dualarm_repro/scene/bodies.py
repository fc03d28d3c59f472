"""The bodies of a scene, sorted into the arrays that the distance kernels read."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Annotated, Any, Literal, NamedTuple

import numpy as np
import pinocchio as pin
from numpy.typing import ArrayLike

from ..arguments import LATER, checked
from ..arms.arm import Arm
from ..errors import InputError
from .hull import ConvexHull
from .moving import MovingArm, MovingShape
from .posing import links_of
from .quantities import finite_pose
from .shapes import Box, Capsule, HalfSpace, Shape, Sphere, not_a_shape

Sort = Literal["capsule", "box", "plane", "hull"]


@checked
@dataclass(frozen=True, eq=False)
class PlacedArm:
    """A controlled arm, the pose of its base in the world and a planner's start and goal [rad]."""

    name: str
    arm: Arm
    placement: Annotated[pin.SE3, LATER] = field(default_factory=pin.SE3.Identity)
    start: Annotated[np.ndarray, LATER] | None = None
    goal: Annotated[np.ndarray, LATER] | None = None

    if TYPE_CHECKING:  # anything that makes an array is taken

        def __init__(
            self,
            name: str,
            arm: Arm,
            placement: pin.SE3 = ...,
            start: ArrayLike | None = None,
            goal: ArrayLike | None = None,
        ) -> None: ...

    def __post_init__(self) -> None:
        if not isinstance(self.name, str):
            raise InputError("PlacedArm", "name", self.name, "text")
        if not isinstance(self.arm, Arm):
            raise InputError("PlacedArm", "arm", self.arm, "an Arm, as load_arm gives it")
        finite_pose(f"arm {self.name}", "placement", self.placement)
        for field_name in ("start", "goal"):
            if (q := getattr(self, field_name)) is not None:
                object.__setattr__(self, field_name, self.arm.configurations(q))


class Body(NamedTuple):
    """One link or obstacle.

    ``owner`` is the arm or obstacle it belongs to, ``row`` its place in the arrays of its sort,
    ``still``: it never moves. ``link`` counts the capsules of an arm (else 0), ``joint`` is the
    joint of a controlled arm that carries it (else None).
    """

    name: str
    owner: str
    sort: Sort
    row: int
    still: bool
    link: int = 0
    joint: int | None = None


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

    @cached_property
    def _rows(self) -> dict[tuple[str, Sort], list[int]]:
        rows = defaultdict(list)
        for body in self.all:
            rows[body.owner, body.sort].append(body.row)
        return dict(rows)

    def rows(self, owner: str, sort: Sort) -> list[int]:
        """Rows of one owner among the bodies of one sort, consecutive."""
        return self._rows.get((owner, sort), [])


def collect(
    arms: Iterable[PlacedArm],
    solids: Mapping[str, Sequence[Shape]],
    moving: Mapping[str, MovingShape | MovingArm],
) -> Bodies:
    """Bodies of controlled arms, moving arms and shapes, and standing obstacles."""
    bodies: list[Body] = []
    data: dict[Sort, list] = {"capsule": [], "box": [], "plane": [], "hull": []}

    def add(item: object, name: str, owner: str, sort: Sort, *rest: Any) -> None:
        bodies.append(Body(name, owner, sort, len(data[sort]), *rest))
        data[sort].append(item)

    def add_arm(owner: str, arm: Arm, controlled: bool) -> None:
        for link, (name, joint, *core) in enumerate(zip(*links_of(arm), strict=True)):
            carrier = int(joint) if controlled else None
            add(core, f"{owner}/{name}", owner, "capsule", bool(joint == 0), link, carrier)

    def add_shape(name: str, owner: str, shape: Shape, still: bool) -> None:
        match shape:
            case Sphere() | Capsule():
                add((shape.core, shape.radius), name, owner, "capsule", still)
            case Box():
                add((shape.pose, shape.half), name, owner, "box", still)
            case HalfSpace():
                add(shape.plane, name, owner, "plane", still)
            case ConvexHull():
                add(shape, name, owner, "hull", still)
            case _:
                raise not_a_shape(f"obstacle {name}", shape)

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
