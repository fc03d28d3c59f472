"""Collision checks of Pinocchio and coal on a scene: the same bodies, pairs and margin."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise

import numpy as np
import pinocchio as pin

from dualarm_repro.baselines.pinocchio_scene import whole_model
from dualarm_repro.scene import Scene

RESOLUTION = 0.02  # between the states of a motion that are looked at [rad]
Free = Callable[[np.ndarray], bool]


def checker(scene: Scene, margin: float = 0.0) -> Free:
    """Whether every pair of a scene keeps more than ``margin`` [m] at a configuration (nq,), by
    ``pin.computeCollisions``, which stops at the first pair that does not."""
    model, geometry = whole_model(scene)
    data, shapes = model.createData(), pin.GeometryData(geometry)
    for request in shapes.collisionRequests:
        request.security_margin = margin
    return lambda q: not pin.computeCollisions(model, data, geometry, shapes, q, True)


def free_motion(free: Free, start: np.ndarray, end: np.ndarray) -> bool:
    """Whether all states of a straight motion are free, ``RESOLUTION`` apart, up to the first."""
    pieces = max(1, int(np.ceil(np.abs(end - start).max() / RESOLUTION)))
    states = start + np.linspace(0.0, 1.0, pieces + 1)[:, None] * (end - start)
    return all(map(free, states))


def free_path(free: Free, path: np.ndarray) -> bool:
    """Whether all straight motions between the rows of a path (N, nq) are free."""
    return all(free_motion(free, a, b) for a, b in pairwise(path))


def length(path: np.ndarray) -> float:
    """Sum over the rows of |q_{k+1} - q_k| [rad]."""
    return float(np.linalg.norm(np.diff(path, axis=0), axis=1).sum())
