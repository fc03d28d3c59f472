"""Workspace of one arm as a rotation body of cells in radius, height and azimuth.

About axis 1 the position is (r, z, phi) with r and z free of q1 and phi = q1 + psi, where psi is
the azimuth at q1 = 0. A dense sample of the other joints marks the cells (r, z, psi); the range of
q1 then sweeps each of them over the azimuth. With a full turn of joint 1 the azimuth plays no
role.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..arguments import Count, Positive, Rows3, Seed, checked
from ..errors import InputError
from ..kernel import kernel
from .arm import Arm

SAMPLES = 2_000_000
AZIMUTHS = 180  # bins of 2 degrees
_CHUNK = 100_000
_LARGEST = 200_000_000  # cells, a byte each
_FULL_TURN = 2.0 * math.pi - 1e-9


class RotationVolume(NamedTuple):
    """Volume [m^3] with cells of edge ``cell`` [m], and the probability mass perhaps missed."""

    cell: float
    cells: int
    volume: float
    unseen: float


@dataclass(frozen=True)
class Occupancy:
    """Reachable cells of one arm.

    Attributes
    ----------
    cell : float
        Edge of the cells in r and z [m].
    bottom : float
        Height of the lowest row of cells above the origin of joint 1 [m].
    counts : ndarray (R, Z)
        Samples in every cell.
    covered : ndarray (R, Z, A) of bool
        Reachable azimuths, bins of 2 pi / A from -pi; A = 1 if joint 1 covers the full turn.
    rotation, origin : ndarray (3, 3), (3,)
        Frame of joint 1 in the base frame; z is its axis.
    """

    cell: float
    bottom: float
    counts: np.ndarray
    covered: np.ndarray
    rotation: np.ndarray
    origin: np.ndarray

    @checked
    def contains(self, points: Rows3) -> np.ndarray:
        """Whether points (n, 3) of the base frame [m] lie in reachable cells, (n,) of bool."""
        local = np.ascontiguousarray(points - self.origin) @ self.rotation
        return _lookup(local, self.cell, self.bottom, self.covered)

    def volume(self) -> RotationVolume:
        """V = sum of 2 pi r dr dz over the reached cells, times the covered share of the azimuth.

        ``unseen`` is the number of cells hit once over the number of samples, an estimate of the
        probability that a further sample opens a new cell (I. J. Good, Biometrika 40, 1953).
        """
        ring = math.pi * self.cell**3 * (2.0 * np.arange(len(self.counts)) + 1.0)
        share = self.covered.mean(axis=2)
        cells, single = np.count_nonzero(self.counts), np.count_nonzero(self.counts == 1)
        unseen = float(single / self.counts.sum())
        return RotationVolume(self.cell, int(cells), float(ring @ share.sum(axis=1)), unseen)

    def corners(self) -> np.ndarray:
        """Corners (8, 3) of a box around the reached cells, in the base frame [m]."""
        rows, columns = np.nonzero(self.counts)
        radius = (rows.max() + 1) * self.cell
        heights = self.bottom + self.cell * np.array([columns.min(), columns.max() + 1])
        box = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in heights], dtype=float)
        box[:, :2] *= radius
        return box @ self.rotation.T + self.origin


@checked
def occupancy(
    arm: Arm, cell: Positive, rng: np.random.Generator, samples: Count = SAMPLES
) -> Occupancy:
    """Mark the cells that a uniform sample of the joints reaches.

    Parameters
    ----------
    arm : Arm
    cell : float
        Edge of the cells in r and z [m].
    rng : numpy Generator
    samples : int

    Raises
    ------
    InputError
        ``cell`` or ``samples`` is not positive.
    """
    turn = arm.upper[0] - arm.lower[0]
    azimuths = 1 if turn >= _FULL_TURN else AZIMUTHS
    length = float(np.linalg.norm(arm.chain.translation[1:], axis=1).sum())
    if 2 * (length / cell + 1) ** 2 * azimuths > _LARGEST:
        expected = f"cells of the {length:g} m of the arm, {_LARGEST} at most"
        raise InputError("occupancy", "cell", cell, expected)
    size = math.ceil(length / cell) + 1
    rotation, origin = arm.chain.rotation[0], arm.chain.translation[0]
    counts = np.zeros((size, 2 * size), dtype=np.uint32)
    marked = np.zeros((size, 2 * size, azimuths), dtype=np.bool_)
    for start in range(0, samples, _CHUNK):
        q = arm.random_configurations(min(_CHUNK, samples - start), rng)
        q[:, 0] = 0.0
        _mark((arm.positions(q) - origin) @ rotation, cell, -size * cell, counts, marked)
    covered = marked if azimuths == 1 else _sweep(marked, arm.lower[0], arm.upper[0])
    return Occupancy(cell, -size * cell, counts, covered, rotation, origin)


@checked
def rotation_volumes(
    arm: Arm, cells: Sequence[Positive], seed: Seed, samples: Count = SAMPLES
) -> list[RotationVolume]:
    """Volume of the workspace for several cell sizes [m] on one sample: a convergence table.

    Cells that the boundary cuts count whole, an error of the first order in the cell size; cells
    too small for the sample stay empty, which ``unseen`` shows.
    """
    return [occupancy(arm, h, np.random.default_rng(seed), samples).volume() for h in cells]


@kernel
def _cell_of(points, k, cell, bottom, azimuths):
    x, y = points[k, 0], points[k, 1]
    row = int(math.sqrt(x * x + y * y) / cell)
    column = math.floor((points[k, 2] - bottom) / cell)
    azimuth = 0
    if azimuths > 1:
        azimuth = int((math.atan2(y, x) / (2.0 * math.pi) + 0.5) * azimuths) % azimuths
    return row, column, azimuth


@kernel
def _mark(points, cell, bottom, counts, marked):
    for k in range(len(points)):
        row, column, azimuth = _cell_of(points, k, cell, bottom, marked.shape[2])
        counts[row, column] += 1
        marked[row, column, azimuth] = True


@kernel
def _lookup(points, cell, bottom, covered):
    inside = np.zeros(len(points), dtype=np.bool_)
    for k in range(len(points)):
        row, column, azimuth = _cell_of(points, k, cell, bottom, covered.shape[2])
        if row < covered.shape[0] and 0 <= column < covered.shape[1]:
            inside[k] = covered[row, column, azimuth]
    return inside


@kernel
def _sweep(marked, lower, upper):
    """Every marked azimuth psi covers lower + psi ... upper + psi, to the nearest bin."""
    azimuths = marked.shape[2]
    first = round(lower / (2.0 * math.pi) * azimuths)
    last = min(round(upper / (2.0 * math.pi) * azimuths), first + azimuths)
    covered = np.zeros_like(marked)
    for row in range(marked.shape[0]):
        for column in range(marked.shape[1]):
            free = 0  # bins until the sweep of the last marked one ends
            for step in range(2 * azimuths):
                if marked[row, column, (step - first) % azimuths]:
                    free = last - first
                if free > 0 and step >= azimuths:
                    covered[row, column, step % azimuths] = True
                free -= 1
    return covered
