"""Signed distances of all watched pairs of a scene, for one or many configurations."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..arguments import checked
from .pair_kernels import capsules_boxes, capsules_capsules, capsules_hull, capsules_planes
from .placement import place
from .quantities import array_of
from .scene import Scene
from .shape_pairs import refine

_NO_WITNESS = np.empty((0, 0, 3, 3))
# Configurations handled at once, so that their cores stay in the cache of the processor.
_BLOCK = 512


@dataclass(frozen=True, eq=False)
class Clearance:
    """Distances of the pairs of a scene at one configuration, or at N with a leading axis.

    Attributes
    ----------
    names : tuple of (str, str)
        The two bodies of each pair.
    distance : ndarray (P,) or (N, P)
        Signed, negative in penetration [m].
    point_a, point_b, normal : ndarray (..., P, 3)
        Nearest points in the world and the unit normal from the first body to the second,
        ``point_b = point_a + distance * normal``.
    """

    names: tuple[tuple[str, str], ...]
    distance: np.ndarray
    point_a: np.ndarray
    point_b: np.ndarray
    normal: np.ndarray

    @property
    def minimum(self) -> float | np.ndarray:
        """Smallest distance, float or (N,); infinite if no pair is watched.

        It is continuous in q, and differentiable only where one pair attains it: where the nearest
        pair switches, its one-sided derivatives are those of the pairs that attain it.
        """
        smallest = self.distance.min(axis=-1, initial=np.inf)
        return float(smallest) if smallest.ndim == 0 else smallest

    @property
    def nearest(self) -> int | np.ndarray:
        """Which pair attains the minimum, int or (N,); of several the first. Needs a pair."""
        pair = self.distance.argmin(axis=-1)
        return int(pair) if pair.ndim == 0 else pair


@checked
def clearance(scene: Scene, q: ArrayLike, time: ArrayLike = 0.0) -> Clearance:
    """d_k(q, t) of every watched pair, with nearest points and normals.

    Parameters
    ----------
    q : (nq,) or (N, nq)
        Joint vectors of the controlled arms one after the other [rad].
    time : float or (N,)
        Index at which moving obstacles are taken.

    Raises
    ------
    ConfigurationError, InputError
        Wrong shape, NaN or infinity in ``q`` or ``time``.
    """
    rows = scene.configurations(q)
    single = rows.ndim == 1
    rows = np.atleast_2d(rows)
    distance = np.empty((len(rows), len(scene.pairs)))
    witness = np.empty((len(rows), len(scene.pairs), 3, 3))
    _fill(scene, rows, time, distance, witness)
    if single:
        distance, witness = distance[0], witness[0]
    return Clearance(scene.pairs.names, distance, *np.moveaxis(witness, -2, 0))


@checked
def distances(scene: Scene, q: ArrayLike, time: ArrayLike = 0.0) -> np.ndarray:
    """The distances of :func:`clearance` alone, (P,) or (N, P); several times faster for many q."""
    rows = scene.configurations(q)
    distance = np.empty((*rows.shape[:-1], len(scene.pairs)))
    _fill(scene, np.atleast_2d(rows), time, np.atleast_2d(distance), _NO_WITNESS)
    return distance


def _fill(
    scene: Scene, q: np.ndarray, time: ArrayLike, distance: np.ndarray, witness: np.ndarray
) -> None:
    time = _times(time, len(q))
    bodies, rows = scene.bodies, scene.pairs.rows
    for block in blocks(len(q), _BLOCK):
        placed = place(scene, q[block], time[block])
        cores, start = (placed.cores, bodies.radius), 0
        for sort, pairs in rows.items():
            if not len(pairs):
                continue
            columns = slice(start, start + len(pairs))
            start = columns.stop
            into = (pairs, distance[block], witness[block], columns.start)
            match sort:
                case "capsule":
                    capsules_capsules(*cores, *into)
                    refine(scene, q[block], distance[block, columns], witness[block, columns])
                case "box":
                    capsules_boxes(*cores, placed.boxes, bodies.half, *into)
                case "plane":
                    capsules_planes(*cores, bodies.planes, *into)
                case "hull":
                    for j, hull in enumerate(bodies.hulls):
                        at = (placed.hulls, hull.polytope, j)
                        capsules_hull(*cores, *at, *into)


def blocks(count: int, size: int) -> Iterator[slice]:
    """Portions of so many rows that are handled at once."""
    return (slice(start, start + size) for start in range(0, count, size))


def _times(time: ArrayLike, count: int) -> np.ndarray:
    single = isinstance(time, int | float)
    expected = f"a finite number, or {count} of them"
    if not single and getattr(time, "shape", None) == ():
        single = True
    time = array_of("scene", "time", time, () if single else (count,), expected)
    return np.broadcast_to(time, count)
