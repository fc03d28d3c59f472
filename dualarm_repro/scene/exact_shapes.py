"""Certified distances of the exact shapes of an arm from each other, where capsules do not tell.

Capsules around two links of one arm overlap long before the links touch, so that some are not
watched (``never`` of :class:`..arms.exclusions.Evidence`). What the others say is then no lower
bound.
Here the shapes of the URDF themselves are measured by coal along a motion. A point of a shape lies
in a capsule of its joint and moves no further than the core of one by more than its radius allows:
the bound of :mod:`.certificate` holds with levers that are longer by the radius.
"""

from __future__ import annotations

import numpy as np
import pinocchio as pin

from ..arms.arm import Arm
from ..arms.exclusions import Evidence, shape_of
from .bodies import PlacedArm
from .certificate import Bracket, bracketed, reach
from .moving import JointPath
from .pairs import names_of
from .posing import links_of
from .scene import Scene

#: Evidence of pairs whose capsules overlap though the shapes are apart.
_FALSE_ALARM = Evidence.NEVER
#: Samples along a motion from which it is halved where that is needed.
_LOOKS = 17
_BUDGET = 20_000


def exact_minimum(
    scene: Scene, placed: PlacedArm, path: JointPath, tolerance: float, enough: float
) -> tuple[Bracket, tuple[str, str]] | None:
    """Bounds on the distance of exact shapes of one arm along its path, and the nearest two.

    Parameters
    ----------
    tolerance, enough : float
        As in :func:`.certificate.certified_minimum` [m].

    Returns
    -------
    Bracket and names, or None if capsules tell everything
    """
    if not scene.self_collision or not (pairs := _half_watched(scene, placed)):
        return None
    arm = placed.arm
    geometry = arm.solids.copy()  # type: ignore[union-attr]  # evidence is of exact shapes
    for first, second in pairs:
        geometry.addCollisionPair(pin.CollisionPair(first, second))
    data, found = arm.model.createData(), geometry.createData()

    def measured(q: np.ndarray, time: np.ndarray) -> np.ndarray:
        rows = np.empty((len(q), len(pairs)))
        for row, posture in zip(rows, q, strict=True):
            pin.computeDistances(arm.model, data, geometry, found, posture)
            row[:] = [one.min_distance for one in found.distanceResults]
        return rows

    looks = np.unique(np.linspace(float(path.index[0]), float(path.index[-1]), _LOOKS))
    rate = _rates(arm, geometry, pairs, np.abs(path.configurations).max(axis=0))
    bracket = bracketed(
        path, measured, lambda t: path.travel(t) @ rate.T, looks, tolerance, enough, _BUDGET
    )
    nearest = int(measured(bracket.q[np.newaxis], looks[:1])[0].argmin())
    first, second = (geometry.geometryObjects[k].name for k in pairs[nearest])
    return bracket, (f"{placed.name}/{first}", f"{placed.name}/{second}")


def _half_watched(scene: Scene, placed: PlacedArm) -> list[tuple[int, int]]:
    """Pairs of exact shapes of which capsules are not watched against each other."""
    silent = [e for e in placed.arm.exclusions or () if e.evidence is _FALSE_ALARM]
    if not silent or placed.arm.solids is None:
        return []
    numbers = {one.name: k for k, one in enumerate(placed.arm.solids.geometryObjects)}
    names = {(shape_of(one.first), shape_of(one.second)) for one in silent}
    known = {n: names_of(f"{placed.name}/{n}", placed.name) for pair in names for n in pair}
    return sorted(
        (numbers[first], numbers[second])
        for first, second in names
        if not any(
            (one in known[first] and other in known[second])
            or (other in known[first] and one in known[second])
            for one, other in scene.exempt
        )
    )


def _rates(
    arm: Arm, geometry: pin.GeometryModel, pairs: list[tuple[int, int]], slide: np.ndarray
) -> np.ndarray:
    """Largest way of the two shapes of each pair relative to each other by each joint (P, nq)."""
    links, lever = links_of(arm), reach(arm, slide)
    lever += np.where((lever > 0.0) & ~arm.slides, links.radius[:, np.newaxis], 0.0)
    rates = np.zeros((len(pairs), arm.nq))
    for row, pair in zip(rates, pairs, strict=True):
        low, high = sorted(geometry.geometryObjects[k].parentJoint for k in pair)
        row[low:high] = lever[links.joint == high, low:high].max(axis=0)
    return rates
