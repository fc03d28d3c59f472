"""Separation distances of a cell: arm to arm, arm to workpiece, torch, floor."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from itertools import combinations
from typing import NamedTuple

import numpy as np

from ..scene.pair_kernels import capsules_capsules, capsules_planes
from ..scene.posing import link_frames, links_of, place_cores
from .cell import ROBOTS, WELDER, Cell
from .nearest import smallest_distances

WORKPIECE, FLOOR = "workpiece", "floor"
HELD = 0  # row of the pipe that the carriers hold
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


class Part(NamedTuple):
    """One capsule: owner, name, and the joint of the arm that carries it (None: the workpiece)."""

    owner: str
    name: str
    joint: int | None


@dataclass(frozen=True, eq=False)
class Separation:
    """The watched pairs of a cell.

    Attributes
    ----------
    parts : tuple of Part
    pairs, floor_pairs : ndarray (K, 2), (F, 2)
        Rows of the parts; the second of a floor pair is 0.
    """

    cell: Cell
    parts: tuple[Part, ...] = field(init=False)
    pairs: np.ndarray = field(init=False)
    floor_pairs: np.ndarray = field(init=False)

    def __post_init__(self) -> None:
        parts = tuple(_parts(self.cell))
        rows = [
            (i, j) for i, j in combinations(range(len(parts)), 2) if _watched(parts[i], parts[j])
        ]
        above = [(i, 0) for i, part in enumerate(parts) if part.joint is None or part.joint > 1]
        object.__setattr__(self, "parts", parts)
        object.__setattr__(self, "pairs", np.array(rows))
        floor = above if self.cell.floor is not None else []
        object.__setattr__(self, "floor_pairs", np.array(floor, dtype=int).reshape(-1, 2))

    @property
    def names(self) -> list[tuple[str, str]]:
        """Both parts of every pair, floor pairs last."""
        label = [f"{part.owner} {part.name}" for part in self.parts]
        inside = [(label[i], label[j]) for i, j in self.pairs]
        return inside + [(label[i], FLOOR) for i, _ in self.floor_pairs]

    @property
    def owners(self) -> list[tuple[str, str]]:
        """Both owners of every pair, the torch apart from the welder; floor pairs last."""
        owner = [
            "torch" if part.owner == ROBOTS[WELDER] and part.name.startswith("tool") else part.owner
            for part in self.parts
        ]
        inside = [(owner[i], owner[j]) for i, j in self.pairs]
        return inside + [(owner[i], FLOOR) for i, _ in self.floor_pairs]

    def cores(self, q: np.ndarray, centres: np.ndarray) -> np.ndarray:
        """Cores of all parts in the world, (P, 3, N, 6) and (P, 3) -> (P N, C, 2, 3) [m]."""
        cell = self.cell
        ends = np.empty((len(centres) * cell.count, len(self.parts), 2, 3))
        start = 0
        for k, arm in enumerate(cell.arms):
            links = links_of(arm)
            stop = start + len(links.radius)
            path = np.ascontiguousarray(q[:, k].reshape(-1, arm.nq))
            frames = link_frames(arm.chain, np.ascontiguousarray(cell.bases[k][:3]), path)
            place_cores(frames, links.joint, links.local, ends[:, start:stop])
            start = stop
        turned = np.einsum("nij,kej->nkei", cell.rotations, cell.pipe_cores)
        placed = centres[:, np.newaxis, np.newaxis, np.newaxis] + turned
        ends[:, start:] = placed.reshape(-1, *cell.pipe_cores.shape)
        return ends

    @cached_property
    def radii(self) -> np.ndarray:
        """Radii of all parts (C,) [m]."""
        links = [links_of(arm).radius for arm in self.cell.arms]
        return np.concatenate([*links, self.cell.pipe_radii])

    def smallest(self, q: np.ndarray, centres: np.ndarray) -> np.ndarray:
        """Smallest distance of all pairs along the seam, (P, 3, N, 6) and (P, 3) -> (P,) [m]."""
        out, above = np.empty(len(centres)), self.floor_pairs[:, 0].copy()
        height = self.cell.floor or 0.0
        for block in _blocks(len(centres)):
            ends = self.cores(q[block], centres[block])
            out[block] = smallest_distances(
                ends, self.radii, self.pairs, above, height, self.cell.count
            )
        return out

    def per_pair(self, q: np.ndarray, centres: np.ndarray) -> np.ndarray:
        """Smallest signed distance of every pair along the seam.

        Parameters
        ----------
        q : ndarray (P, 3, N, 6) [rad]
        centres : ndarray (P, 3) [m]

        Returns
        -------
        ndarray (P, K + F) [m]
            In the order of :attr:`names`.
        """
        out = np.empty((len(centres), len(self.pairs) + len(self.floor_pairs)))
        plane = np.array([[0.0, 0.0, 1.0, self.cell.floor or 0.0]])
        for block in _blocks(len(centres)):
            ends = self.cores(q[block], centres[block])
            distance = np.empty((len(ends), out.shape[1]))
            between, above = np.split(distance, [len(self.pairs)], axis=1)
            capsules_capsules(ends, self.radii, self.pairs, between, _NO_WITNESS)
            capsules_planes(ends, self.radii, plane, self.floor_pairs, above, _NO_WITNESS)
            shape = (-1, self.cell.count, out.shape[1])
            out[block] = distance.reshape(shape).min(axis=1)
        return out


def _blocks(count: int) -> Iterator[slice]:
    return (slice(first, first + _BLOCK) for first in range(0, count, _BLOCK))


def _parts(cell: Cell) -> Iterator[Part]:
    for robot, arm in zip(ROBOTS, cell.arms, strict=True):
        for name, joint in zip(*links_of(arm)[:2], strict=True):
            yield Part(robot, str(name), int(joint))
    for k in range(len(cell.pipe_radii)):
        yield Part(WORKPIECE, f"pipe_{k}", None)


def _watched(a: Part, b: Part) -> bool:
    if a.owner == b.owner:
        return a.joint is not None and min(a.joint, b.joint) <= 2 and max(a.joint, b.joint) == 6
    if b.owner == WORKPIECE and b.name == f"pipe_{HELD}":
        return a.owner == ROBOTS[WELDER] or a.joint < 6
    return True
