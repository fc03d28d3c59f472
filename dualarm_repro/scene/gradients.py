"""Derivative of the distances of a scene by its joints.

d d / d q_j = n . (J_b - J_a)_j = +-n . (z_j x (p - o_j)), with the unit normal n from a to b, axis
z_j and origin o_j of the joint, + if it moves only b, - if only a. J_a and J_b belong to the points
fixed to the bodies that are nearest now: that these slide along the surfaces does not enter
(envelope theorem). Both lie on one line along n, so that either serves as p. A prismatic joint has
z_j in the place of the cross product.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..arguments import checked
from ..kernel import kernel
from .clearance import Clearance, clearance
from .placement import arm_frames
from .scene import Scene
from .vectors import cross, dot, minus, vector


@kernel
def _gradients(frames, sign, point, normal, gradient):
    for n in range(gradient.shape[0]):
        for k in range(gradient.shape[1]):
            p, towards_b = vector(point[n, k]), vector(normal[n, k])
            for j in range(gradient.shape[2]):
                axis, origin = vector(frames[n, j, :, 2]), vector(frames[n, j, :, 3])
                gradient[n, k, j] = sign[k, j] * dot(towards_b, cross(axis, minus(p, origin)))


@checked
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
        [m/rad], of a prismatic joint without unit
    """
    found = clearance(scene, q, time)
    gradient = np.empty((*found.distance.shape, scene.nq))
    frames = arm_frames(scene, np.atleast_2d(scene.configurations(q)))
    joints = np.concatenate([arm[:, 1:] for arm in frames], axis=1)
    rows = (a.reshape(len(joints), *a.shape[-2:]) for a in (found.point_a, found.normal, gradient))
    _gradients(joints, scene.support, *rows)
    slides = np.concatenate([placed.arm.slides for placed in scene.arms])
    for j in np.flatnonzero(slides):
        along = found.normal @ joints[:, j, :, 2].reshape(*found.normal.shape[:-2], 3, 1)
        gradient[..., j] = scene.support[:, j] * along[..., 0]
    return found, gradient
