"""Obstacles of a planner: all shapes of a scene as arrays over the steps of the plan."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, replace
from typing import Annotated

import numpy as np

from ...arguments import Number, Shape, checked
from ...errors import InputError, UnknownNameError
from ...scene import JointPath, PlacedArm, Scene
from ...scene.pair_kernels import capsules_boxes, capsules_capsules, capsules_planes
from ...scene.pairs import SORTS
from ...scene.placement import place
from .control_points import ControlPoints, ends_of


@dataclass(frozen=True, eq=False)
class Obstacles:
    """M shapes; those that move are given at steps 0 ... T-1 and stay as they are at the last.

    Attributes
    ----------
    names : tuple of str
        Capsules first, then boxes, then half-spaces.
    group : ndarray (M,) of int
        Which shapes form one obstacle, such as the bars of a window.
    cores : ndarray (T, C, 2, 3)
        Ends of the cores of capsules and spheres in the world [m].
    radius : ndarray (C,)
    boxes : ndarray (T, B, 3, 4)
        Upper parts of the poses of boxes.
    half : ndarray (B, 3)
        Half edge lengths.
    planes : ndarray (P, 4)
        Outward normal and offset of half-spaces.
    """

    names: tuple[str, ...]
    group: np.ndarray
    cores: np.ndarray
    radius: np.ndarray
    boxes: np.ndarray
    half: np.ndarray
    planes: np.ndarray

    @checked
    def at(self, step: Number) -> int:
        """Row of the arrays that holds at a step."""
        return min(step, len(self.cores) - 1)

    @checked
    def moving(self, step: Number) -> bool:
        """Whether some shape is yet to move."""
        return step < len(self.cores) - 1

    @checked
    def with_arm(self, placed: PlacedArm, points: ControlPoints, path: JointPath) -> Obstacles:
        """These obstacles and the control points of an arm that follows a path over the steps.

        Each point is an obstacle of its own, named ``arm/point``. Before and after its path the arm
        waits at the ends.
        """
        rows = max(len(self.cores), 1 + int(np.ceil(path.index[-1])))
        track = ends_of(placed, points, path.at(np.arange(float(rows))))
        names = [f"{placed.name}/{point}" for point in points.names]
        found, first = len(self.radius), 1 + self.group.max(initial=-1)
        return replace(
            self,
            names=(*self.names[:found], *names, *self.names[found:]),
            group=np.insert(self.group, found, np.arange(first, first + len(names))),
            cores=np.concatenate([_held(self.cores, rows), track], axis=1),
            radius=np.append(self.radius, points.radius),
            boxes=_held(self.boxes, rows),
        )

    @checked
    def distances(
        self,
        ends: Annotated[np.ndarray, Shape("N", "K", 2, 3)],
        radius: Annotated[np.ndarray, Shape("K")],
        step: Number,
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """d, the nearest point of each control point, and grad d there.

        Parameters
        ----------
        ends : (N, K, 2, 3)
            Control points in the world.
        radius : (K,)

        Returns
        -------
        distance : ndarray (N, K, M)
            Signed, negative in penetration [m].
        point, outward : ndarray (N, K, M, 3)
            Nearest point of the control point, and the direction in which its motion lengthens d.
        """
        count, points = ends.shape[:2]
        row = self.at(step)
        cores = np.broadcast_to(self.cores[row], (count, *self.cores.shape[1:]))
        boxes = np.broadcast_to(self.boxes[row], (count, *self.boxes.shape[1:]))
        everything = np.concatenate([ends, cores], axis=1), np.concatenate([radius, self.radius])
        parts = (
            (len(self.radius), points, capsules_capsules, everything),
            (len(self.half), 0, capsules_boxes, (ends, radius, boxes, self.half)),
            (len(self.planes), 0, capsules_planes, (ends, radius, self.planes)),
        )
        distances, witnesses = [], []
        for shapes, offset, kernel, bodies in parts:
            pairs = _pairs(points, shapes, offset)
            distance = np.empty((count, len(pairs)))
            witness = np.empty((count, len(pairs), 3, 3))
            kernel(*bodies, pairs, distance, witness, 0)
            distances.append(distance.reshape(count, points, shapes))
            witnesses.append(witness.reshape(count, points, shapes, 3, 3))
        witness = np.concatenate(witnesses, axis=2)
        return np.concatenate(distances, axis=2), witness[..., 0, :], -witness[..., 2, :]


@checked
def obstacles_of(scene: Scene, leave_out: Collection[str] = ()) -> Obstacles:
    """Everything in a scene that stands or moves by itself; its controlled arms are no obstacles.

    The bars of a window, or the capsules of a moving arm, form one obstacle each. All are taken
    over the steps until the last has come to rest.

    Parameters
    ----------
    leave_out : names
        Obstacles the planner is not told about, e.g. ``floor``.

    Raises
    ------
    UnknownNameError
        A name that no obstacle of the scene has.
    InputError
        A convex hull.
    """
    known = list(dict.fromkeys(body.owner for body in scene.bodies.all))
    known = [owner for owner in known if owner not in scene.columns]
    for name in leave_out:
        if name not in known:
            expected = f"one of {', '.join(known) or 'none there are'}"
            raise UnknownNameError("obstacles_of", "leave_out", name, expected)
    owners = [owner for owner in known if owner not in leave_out]
    bodies = [body for body in scene.bodies.all if body.owner in owners]
    sorted_by = {sort: [body for body in bodies if body.sort == sort] for sort in SORTS}
    for body in sorted_by.pop("hull"):
        expected = "spheres, capsules, boxes, half-spaces or arms"
        raise InputError("obstacles_of", "obstacle", body.name, expected)
    last = max((np.ceil(mover.path.index[-1]) for mover in scene.moving.values()), default=0.0)
    times = np.arange(1.0 + last)
    placed = place(scene, np.zeros((len(times), scene.nq)), times)
    cores, boxes, planes = ([body.row for body in group] for group in sorted_by.values())
    ordered = [body for group in sorted_by.values() for body in group]
    return Obstacles(
        tuple(body.name for body in ordered),
        np.array([owners.index(body.owner) for body in ordered], dtype=np.int64),
        np.ascontiguousarray(placed.cores[:, cores]),
        scene.bodies.radius[cores],
        np.ascontiguousarray(placed.boxes[:, boxes]),
        scene.bodies.half[boxes],
        scene.bodies.planes[planes],
    )


def _pairs(points: int, shapes: int, offset: int) -> np.ndarray:
    first, second = np.indices((points, shapes)).reshape(2, -1)
    return np.column_stack([first, second + offset])


def _held(track: np.ndarray, rows: int) -> np.ndarray:
    """The track with its last row repeated up to a number of rows."""
    return np.concatenate([track, np.repeat(track[-1:], rows - len(track), axis=0)])
