"""Overlap of the workspaces of two placed arms, with confidence intervals."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
import pinocchio as pin
import scipy

from ..errors import InputError
from .arm import Arm
from .occupancy import SAMPLES, Occupancy, occupancy
from .workspace import sample_workspace

CONFIDENCE = 0.95
Placement: TypeAlias = pin.SE3 | tuple[np.ndarray, np.ndarray]
_Placed = tuple[Arm, np.ndarray, np.ndarray]


@dataclass(frozen=True)
class Estimate:
    """An estimate and its 95 % interval (Wilson), which holds the sampling error only."""

    value: float
    low: float
    high: float


@dataclass(frozen=True)
class Overlap:
    """Common workspace of two arms.

    Attributes
    ----------
    volume : Estimate
        [m^3]
    first_in_second, second_in_first : Estimate
        Share of the cloud of one arm, uniform in its joints, that lies in the workspace of the
        other.
    """

    volume: Estimate
    first_in_second: Estimate
    second_in_first: Estimate


def overlap(
    first: tuple[Arm, Placement],
    second: tuple[Arm, Placement],
    *,
    seed: int,
    cell: float = 0.02,
    points: int = 200_000,
    samples: int = SAMPLES,
    maps: tuple[Occupancy, Occupancy] | None = None,
) -> Overlap:
    """Monte-Carlo volume of the intersection, V = V_box k / n.

    ``points`` uniform points of the common part of the boxes around both workspaces are tested
    against the :class:`~.occupancy.Occupancy` of each arm; as many flange positions of each arm
    are tested against the other. Swapping the arms gives the same volume for the same seed.

    Parameters
    ----------
    first, second : (Arm, placement of its base in the world)
        The placement is a pinocchio.SE3 or (rotation (3, 3), translation (3,) [m]).
    seed : int
    cell : float
        Edge of the cells of the occupancy [m]; its effect is not part of the intervals.
    points, samples : int
        Test points, and samples for each occupancy.
    maps : two Occupancy, optional
        Occupancies at hand, e.g. when only the placements vary; then ``cell`` and ``samples``
        are not used.

    Raises
    ------
    InputError
        A placement is no rigid motion, or a number is not positive.
    """
    if points < 1:
        raise InputError("overlap", "points", points, "a positive number")
    arms = [(arm, *_rigid(placement)) for arm, placement in (first, second)]
    reached = maps or [
        occupancy(arm, cell, np.random.default_rng((seed, 0)), samples) for arm, _, _ in arms
    ]
    clouds = [
        sample_workspace(arm, points, np.random.default_rng((seed, 1))) @ R.T + t
        for arm, R, t in arms
    ]
    volume = _common_volume(arms, reached, points, np.random.default_rng((seed, 2)))
    shares = [
        _proportion(int(_inside(clouds[k], reached[1 - k], arms[1 - k]).sum()), points)
        for k in (0, 1)
    ]
    return Overlap(volume, *shares)


def _common_volume(
    arms: list[_Placed], maps: Sequence[Occupancy], points: int, rng: np.random.Generator
) -> Estimate:
    boxes = [m.corners() @ R.T + t for m, (_, R, t) in zip(maps, arms, strict=True)]
    lower = np.max([box.min(axis=0) for box in boxes], axis=0)
    upper = np.min([box.max(axis=0) for box in boxes], axis=0)
    if (lower >= upper).any():
        return Estimate(0.0, 0.0, 0.0)
    trial = lower + (upper - lower) * rng.random((points, 3))
    both = _inside(trial, maps[0], arms[0]) & _inside(trial, maps[1], arms[1])
    return _proportion(int(both.sum()), points, float(np.prod(upper - lower)))


def _inside(points: np.ndarray, reached: Occupancy, placed: _Placed) -> np.ndarray:
    _, R, t = placed
    return reached.contains((points - t) @ R)


def _proportion(hits: int, trials: int, scale: float = 1.0) -> Estimate:
    test = scipy.stats.binomtest(hits, trials)
    interval = test.proportion_ci(CONFIDENCE, method="wilson")
    return Estimate(*(scale * float(p) for p in (test.statistic, interval.low, interval.high)))


def _rigid(placement: Placement) -> tuple[np.ndarray, np.ndarray]:
    if isinstance(placement, pin.SE3):
        return placement.rotation, placement.translation
    expected = "a pinocchio.SE3 or (rotation (3, 3), translation (3,))"
    try:
        rotation, translation = (np.asarray(part, dtype=float) for part in placement)
    except (TypeError, ValueError):
        raise InputError("overlap", "placement", placement, expected) from None
    if rotation.shape != (3, 3) or translation.shape != (3,) or not np.isfinite(translation).all():
        raise InputError("overlap", "placement", placement, expected)
    if not (np.allclose(rotation.T @ rotation, np.eye(3)) and np.linalg.det(rotation) > 0):
        raise InputError("overlap", "placement", rotation.tolist(), "a rotation matrix")
    return rotation, translation
