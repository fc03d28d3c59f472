"""Separation distances of a cell: arm to arm, arm to workpiece, torch, floor."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import combinations
from typing import Annotated

import numpy as np

from ..annotation import Shape as Axes
from ..arguments import OPEN, checked
from ..errors import InputError
from ..scene.bodies import Bodies, Body, PlacedArm, collect
from ..scene.clearance import blocks
from ..scene.pair_kernels import capsules_capsules, capsules_planes
from ..scene.pairs import Pairs
from ..scene.posing import link_frames, links_of, place_cores
from ..scene.scene import FLOOR
from ..scene.shapes import Capsule, HalfSpace, Shape
from .cell import ROBOTS, WELDER, Cell
from .nearest import smallest_distances

WORKPIECE = "workpiece"
HELD = tuple(f"{WORKPIECE}/{k}" for k in (0, 2, 3))  # the pipe that the carriers hold
_BLOCK = 8  # placements handled at once, so that their cores stay in the cache of the processor
_NO_WITNESS = np.empty((0, 0, 3, 3))

#: Pairs that are left out, and why.
EXEMPTIONS = {
    "hand and gripper of a carrier, held pipe": "the gripper holds the pipe by its end",
    "tip of the torch, workpiece": "the tip touches the seam by purpose",
    "base and column, floor": "every base stands on it",
    "links of one arm, except its hand and tool against base, column and upper arm": (
        "neighbours overlap, and joint limits keep the others apart"
    ),
}


#: Joint paths and positions of jobs.
Paths = Annotated[np.ndarray, OPEN, Axes("P", 3, "N", 6)]
Places = Annotated[np.ndarray, Axes("P", 3)]


@checked
@dataclass(frozen=True, eq=False)
class Separation:
    """The watched pairs of a cell.

    Bodies and pairs are of the kind that a scene has, but chosen by another rule: a scene watches
    links of controlled arms only, here the workpiece that is carried must clear the floor as well.

    Attributes
    ----------
    bodies : Bodies
        Links of the arms, pipes of the workpiece, floor.
    pairs : Pairs
        Pairs with the floor last.
    """

    cell: Cell
    bodies: Bodies = field(init=False)
    pairs: Pairs = field(init=False)

    def __post_init__(self) -> None:
        bodies = _bodies(self.cell)
        watched = [pair for pair in combinations(bodies.all, 2) if _watched(*pair)]
        watched.sort(key=lambda pair: pair[1].owner == FLOOR)
        object.__setattr__(self, "bodies", bodies)
        object.__setattr__(self, "pairs", Pairs(tuple(watched)))

    @property
    def owners(self) -> list[tuple[str, str]]:
        """Both owners of every pair, the torch apart from the welder."""
        return [(_owner(a), _owner(b)) for a, b in self.pairs.bodies]

    @checked
    def cores(self, q: Paths, centres: Places) -> np.ndarray:
        """Cores of all capsules in the world, (P, 3, N, 6) and (P, 3) -> (P N, C, 2, 3) [m]."""
        if q.shape[2] != self.cell.count:
            raise InputError("separation", "shape of q", q.shape, f"{self.cell.count} seam points")
        postures = np.moveaxis(q, 1, 2).reshape(-1, *q.shape[1::2])
        turns = np.tile(self.cell.rotations, (len(q), 1, 1))
        return self.posed(postures, turns, np.repeat(centres, self.cell.count, axis=0))

    @checked
    def posed(
        self,
        q: Annotated[np.ndarray, OPEN, Axes("M", 3, 6)],
        rotations: Annotated[np.ndarray, Axes("M", 3, 3)],
        centres: Annotated[np.ndarray, Axes("M", 3)],
    ) -> np.ndarray:
        """Cores (M, C, 2, 3) [m] of single postures: (M, 3, 6), (M, 3, 3) and (M, 3)."""
        cell, start = self.cell, 0
        ends = np.empty((len(q), len(self.bodies.radius), 2, 3))
        for k, arm in enumerate(cell.arms):
            links = links_of(arm)
            base = np.ascontiguousarray(cell.bases[k][:3])
            frames = link_frames(arm.chain, base, np.ascontiguousarray(q[:, k]))
            place_cores(frames, links.joint, links.local, ends, start)
            start += len(links.radius)
        piece = np.empty((len(q), 1, 3, 4))
        piece[:, 0, :, :3], piece[:, 0, :, 3] = rotations, centres
        carried = np.zeros(len(cell.pipe_cores), dtype=int)
        place_cores(piece, carried, cell.pipe_cores, ends, start)
        return ends

    @checked
    def distances(self, ends: Annotated[np.ndarray, OPEN, Axes("M", "C", 2, 3)]) -> np.ndarray:
        """Signed distance of every pair in the order of ``pairs``, (M, C, 2, 3) -> (M, K) [m]."""
        bodies, rows = self.bodies, self.pairs.rows
        distance = np.empty((len(ends), len(self.pairs)))
        between, above = rows["capsule"], rows["plane"]
        capsules_capsules(ends, bodies.radius, between, distance, _NO_WITNESS, 0)
        at = (bodies.planes, above, distance, _NO_WITNESS, len(between))
        capsules_planes(ends, bodies.radius, *at)
        return distance

    @checked
    def smallest(self, q: Paths, centres: Places) -> np.ndarray:
        """Smallest distance of all pairs along the seam, (P, 3, N, 6) and (P, 3) -> (P,) [m]."""
        out, rows = np.empty(len(centres)), self.pairs.rows
        above, height = rows["plane"][:, 0].copy(), self.cell.floor or 0.0
        for block in blocks(len(centres), _BLOCK):
            ends = self.cores(q[block], centres[block])
            out[block] = smallest_distances(
                ends, self.bodies.radius, rows["capsule"], above, height, self.cell.count
            )
        return out

    @checked
    def per_pair(self, q: Paths, centres: Places) -> np.ndarray:
        """Smallest signed distance of every pair along the seam.

        Parameters
        ----------
        q : ndarray (P, 3, N, 6) [rad]
        centres : ndarray (P, 3) [m]

        Returns
        -------
        ndarray (P, K) [m]
            In the order of ``pairs``.
        """
        out = np.empty((len(centres), len(self.pairs)))
        for block in blocks(len(centres), _BLOCK):
            distance = self.distances(self.cores(q[block], centres[block]))
            out[block] = distance.reshape(-1, self.cell.count, out.shape[1]).min(axis=1)
        return out


def _bodies(cell: Cell) -> Bodies:
    pipes = zip(cell.pipe_cores, cell.pipe_radii, strict=True)
    solids: dict[str, tuple[Shape, ...]] = {
        WORKPIECE: tuple(Capsule(start, end, radius) for (start, end), radius in pipes)
    }
    if cell.floor is not None:
        solids[FLOOR] = (HalfSpace((0.0, 0.0, 1.0), cell.floor),)
    arms = [PlacedArm(robot, arm) for robot, arm in zip(ROBOTS, cell.arms, strict=True)]
    return collect(arms, solids, {})


def _watched(a: Body, b: Body) -> bool:
    """Whether a pair is measured; ``a`` comes first among the bodies."""
    if b.owner == FLOOR:
        return a.joint is None or a.joint > 1
    if a.joint is None:
        return False
    if a.owner == b.owner:
        return b.joint is not None and min(a.joint, b.joint) <= 2 and max(a.joint, b.joint) == 6
    return b.name not in HELD or a.owner == ROBOTS[WELDER] or a.joint < 6


def _owner(body: Body) -> str:
    is_torch = body.name.startswith(f"{ROBOTS[WELDER]}/tool")
    return "torch" if is_torch else body.owner
