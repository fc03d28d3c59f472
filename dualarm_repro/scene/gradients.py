"""Derivative of the distances of a scene by its joints.

d d / d q = n^T (J_b(p_b) - J_a(p_a)) with the unit normal n from a to b and the Jacobians of the
points fixed to either body that are nearest now (the witness points may slide along the surfaces;
by the envelope theorem that does not enter). Both points lie on one line along n, so one row
[n, p x n] times the joint screws at the world origin serves both bodies.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from .clearance import Clearance, clearance
from .placement import place
from .posing import joint_screws
from .scene import Scene


def clearance_gradient(
    scene: Scene, q: ArrayLike, time: ArrayLike = 0.0
) -> tuple[Clearance, np.ndarray]:
    """Distances of all watched pairs and their gradients, ``time`` held fixed.

    The gradient is exact in separation, contact and penetration. It does not exist, and one of the
    possible limits is given, where the nearest points of a pair are not unique: parallel links,
    crossing core segments, equally near faces of a box. The minimum over the pairs has in addition
    a crease wherever the nearest pair switches.

    Parameters
    ----------
    q : (nq,) or (N, nq) [rad]
    time : float or (N,)

    Returns
    -------
    clearance : Clearance
    gradient : ndarray (P, nq) or (N, P, nq)
        [m/rad]
    """
    found = clearance(scene, q, time)
    rows = np.atleast_2d(scene.configurations(q))
    frames = place(scene, rows, np.broadcast_to(time, len(rows))).frames
    screws = np.concatenate([joint_screws(frames[placed.name]) for placed in scene.arms], axis=2)
    wrench = np.concatenate([found.normal, np.cross(found.point_a, found.normal)], axis=-1)
    gradient = (wrench.reshape(len(rows), -1, 6) @ screws) * _support(scene)
    return found, gradient.reshape(*found.distance.shape, scene.nq)


def _support(scene: Scene) -> np.ndarray:
    """+1 where a joint moves the second body of a pair only, -1 the first only, else 0; (P, nq)."""
    sign = np.zeros((len(scene.pairs), scene.nq))
    for row, (a, b) in zip(sign, scene.pairs.bodies, strict=True):
        for body, value in ((a, -1.0), (b, 1.0)):
            if body.joint is not None:
                start = scene.columns[body.owner].start
                row[start : start + body.joint] += value
    return sign
