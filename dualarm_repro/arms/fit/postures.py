"""Postures of an arm, and which of its shapes touch in them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pinocchio as pin


def usual_range(model: pin.Model) -> tuple[np.ndarray, np.ndarray]:
    """Limits of the joints, a turn about 0 where there are none."""
    lower, upper = model.lowerPositionLimit, model.upperPositionLimit
    return np.where(np.isinf(lower), -np.pi, lower), np.where(np.isinf(upper), np.pi, upper)


def postures(model: pin.Model, count: int, seed: int = 0) -> np.ndarray:
    """Postures (N, nq) drawn uniformly within the limits."""
    lower, upper = usual_range(model)
    return lower + np.random.default_rng(seed).random((count, model.nq)) * (upper - lower)


def home_pose(model: pin.Model) -> np.ndarray:
    """All joints zero, or as near to it as their limits allow."""
    found: np.ndarray = np.clip(np.zeros(model.nq), *usual_range(model))
    return found


def contacts(
    model: pin.Model,
    shapes: pin.GeometryModel,
    pairs: Sequence[tuple[int, int]],
    q: np.ndarray,
    near: float = 0.0,
) -> np.ndarray:
    """Whether shapes come nearer than ``near`` [m], for every posture (N, nq) and pair: (N, P)."""
    shapes.removeAllCollisionPairs()
    for i, j in pairs:
        shapes.addCollisionPair(pin.CollisionPair(i, j))
    data, geometry = model.createData(), shapes.createData()
    results = geometry.collisionResults
    for request in geometry.collisionRequests:
        request.security_margin = near
    found = np.zeros((len(q), len(shapes.collisionPairs)), dtype=bool)
    for row, posture in zip(found, q, strict=True):
        if pin.computeCollisions(model, data, shapes, geometry, posture, False):
            for k in range(len(row)):
                row[k] = results[k].isCollision()
    shapes.removeAllCollisionPairs()
    return found
