"""Kinematics and distances of all arms of a system at one configuration, compiled.

Written for one configuration at a time, as a controller needs them; the yardstick of the tests is
:func:`..scene.gradients.clearance_gradient` and the arms' own Jacobian.
"""

from __future__ import annotations

import numpy as np

from ..arms.chain import Chain
from ..kernel import kernel
from ..scene.posing import set_frames
from ..scene.segments import segment_segment
from ..scene.vectors import cross, minus, vector

_ROUNDING = 1e-9  # [m]


@kernel
def joint_frames(arrays, q, frames, tips):
    """Frames of all arms as :func:`..scene.posing.set_frames` has them, and the flange positions.

    Parameters
    ----------
    q : (n,) [rad]
    frames : (n + A, 3, 4), output
        Base and joint frames arm by arm.
    tips : (A, 3), output [m]
    """
    for arm in range(len(arrays.base)):
        first, last = arrays.start[arm], arrays.start[arm + 1]
        row, flange = first + arm, last + arm
        chain = Chain(arrays.rotation[row:flange], arrays.translation[row:flange])
        set_frames(chain, arrays.base[arm], q[first:last], frames[row : flange + 1])
        F, t = frames[flange], arrays.translation[flange]
        for r in range(3):
            tips[arm, r] = F[r, 0] * t[0] + F[r, 1] * t[1] + F[r, 2] * t[2] + F[r, 3]


@kernel
def point_velocity(frames, arm, joint, p):
    """z_j x (p - o_j): velocity of a point per unit speed of a joint of an arm [m]."""
    F = frames[joint + arm + 1]
    return cross(vector(F[:, 2]), minus(p, vector(F[:, 3])))


@kernel
def tip_jacobian(arrays, frames, tips, J):
    """Block-diagonal J (3A, n) of the flange positions, v = J dq [m/rad]."""
    J[:] = 0.0
    for arm in range(len(tips)):
        p = vector(tips[arm])
        for joint in range(arrays.start[arm], arrays.start[arm + 1]):
            v = point_velocity(frames, arm, joint, p)
            for r in range(3):
                J[3 * arm + r, joint] = v[r]


@kernel
def core_distances(arrays, frames, distance, witness):
    """Distance of the capsule cores of every pair, nearest points and normal from a to b.

    Parameters
    ----------
    distance : (P,), output [m]
        Between the cores; the radii are left to the caller.
    witness : (P, 3, 3), output
        Point on core a, point on core b, unit normal.
    """
    cores = np.empty((len(arrays.radius), 2, 3))
    _place(arrays, frames, cores)
    for k in range(len(distance)):
        _core_distance(arrays, cores, k, distance, witness)


@kernel
def near_distances(arrays, frames, cores, half, noise, thickness, outer, distance, witness):
    """:func:`core_distances` where they can matter, elsewhere a bound from below; returns the
    smallest distance of the surfaces, which is exact.

    They matter within ``outer``, and of the nearest surfaces. The bound is the distance of the
    balls around two cores, which costs a tenth of the distance of the cores.

    Parameters
    ----------
    cores : (C, 2, 3), output [m]
    half : (C,)
        Half lengths of the cores [m].
    noise : (P,) or (0,)
        Added to what is compared with ``outer`` [m].
    thickness : float
        Share of the radii taken off what is compared with ``outer``.
    """
    _place(arrays, frames, cores)
    nearest, least = -1, np.inf
    for k in range(len(distance)):
        i, j = arrays.pairs[k, 0], arrays.pairs[k, 1]
        square = 0.0
        for r in range(3):
            apart = 0.5 * ((cores[i, 0, r] + cores[i, 1, r]) - (cores[j, 0, r] + cores[j, 1, r]))
            square += apart * apart
        distance[k] = square**0.5 - half[i] - half[j]
        surface = distance[k] - arrays.radius[i] - arrays.radius[j]
        if surface < least:
            nearest, least = k, surface
    if nearest < 0:
        return np.inf
    _core_distance(arrays, cores, nearest, distance, witness)
    radii = arrays.radius[arrays.pairs[nearest, 0]] + arrays.radius[arrays.pairs[nearest, 1]]
    smallest = distance[nearest] - radii
    for k in range(len(distance)):
        if k == nearest:
            continue
        radii = arrays.radius[arrays.pairs[k, 0]] + arrays.radius[arrays.pairs[k, 1]]
        read = distance[k] - thickness * radii
        if len(noise):
            read += noise[k]
        # A bound may exceed the distance by rounding.
        if read < outer + _ROUNDING or distance[k] - radii < smallest + _ROUNDING:
            _core_distance(arrays, cores, k, distance, witness)
            smallest = min(smallest, distance[k] - radii)
    return smallest


@kernel
def _place(arrays, frames, cores):
    """Ends of the cores in the world."""
    for c in range(len(cores)):
        frame = arrays.frame[c]
        for end in range(2):
            x, y, z = vector(arrays.local[c, end])
            for r in range(3):
                F = frames[frame, r]
                cores[c, end, r] = F[0] * x + F[1] * y + F[2] * z + F[3]


@kernel
def _core_distance(arrays, cores, k, distance, witness):
    i, j = arrays.pairs[k, 0], arrays.pairs[k, 1]
    a, b = vector(cores[i, 0]), vector(cores[j, 0])
    u, v = minus(vector(cores[i, 1]), a), minus(vector(cores[j, 1]), b)
    gap, p, q, normal = segment_segment(a, u, b, v)
    distance[k] = gap
    for r in range(3):
        witness[k, 0, r], witness[k, 1, r], witness[k, 2, r] = p[r], q[r], normal[r]


@kernel
def relative_velocity(arrays, frames, body, point, sign, columns):
    """Add sign times the velocity of a point of a body per joint speed to ``columns`` (3, n)."""
    p = vector(point)
    first = arrays.first[body]
    arm = arrays.frame[body] - arrays.last[body]
    for joint in range(first, arrays.last[body]):
        v = point_velocity(frames, arm, joint, p)
        for r in range(3):
            columns[r, joint] += sign * v[r]
