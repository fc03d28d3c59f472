"""The velocity problem of a system at one configuration, written into arrays that are reused.

J x = dr/dt + K (r - f(q)),  J_N x <= beta,  merged joint bounds,  target -lambda (q - q_0).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..kernel import kernel
from .avoidance import fill_rows, select_pairs
from .damper import joint_bounds
from .kinematics import core_distances, joint_frames, near_distances, tip_jacobian
from .parts import ProgramParts
from .problem import QuadraticProgram


class Buffers(NamedTuple):
    """Reused arrays: kinematics, distances and the parts of the problem.

    ``distance`` is what the controller goes by, ``surface`` the distance of the link surfaces;
    ``chosen`` lists the pairs that give rows. ``half`` are half lengths of capsule cores. Only the
    first rows of ``program`` are in use.
    """

    frames: np.ndarray
    tips: np.ndarray
    distance: np.ndarray
    surface: np.ndarray
    witness: np.ndarray
    chosen: np.ndarray
    cores: np.ndarray
    half: np.ndarray
    program: ProgramParts


@kernel
def make_buffers(arrays, numbers):
    """Buffers for a system."""
    n, arms, pairs = arrays.start[-1], len(arrays.base), len(arrays.pairs)
    rows = numbers.rows_per_pair * pairs
    half = np.empty(len(arrays.radius))
    for c in range(len(half)):
        square = 0.0
        for r in range(3):
            square += (arrays.local[c, 1, r] - arrays.local[c, 0, r]) ** 2
        half[c] = 0.5 * np.sqrt(square)
    return Buffers(
        np.empty((n + arms, 3, 4)),
        np.empty((arms, 3)),
        np.empty(pairs),
        np.empty(pairs),
        np.empty((pairs, 3, 3)),
        np.empty(pairs, np.int64),
        np.empty((len(half), 2, 3)),
        half,
        ProgramParts(
            np.empty(n),
            np.empty((3 * arms, n)),
            np.empty(3 * arms),
            np.empty((rows, n)),
            np.empty(rows),
            np.empty(n),
            np.empty(n),
        ),
    )


@kernel
def sense(arrays, numbers, q, noise, buffers):
    """Kinematics, distances and the pairs that give rows; returns how many.

    Parameters
    ----------
    noise : (P,) or (0,)
        Added to the distances that the controller goes by [m].
    """
    B = buffers
    joint_frames(arrays, q, B.frames, B.tips)
    tip_jacobian(arrays, B.frames, B.tips, B.program.A)
    core_distances(arrays, B.frames, B.distance, B.witness)
    for k in range(len(B.distance)):
        i, j = arrays.pairs[k]
        thickness = arrays.radius[i] + arrays.radius[j]
        B.surface[k] = B.distance[k] - thickness
        B.distance[k] -= numbers.thickness * thickness
        if len(noise):
            B.distance[k] += noise[k]
    if not numbers.avoid or not len(B.distance):
        return 0
    return select_pairs(arrays, numbers.selection, numbers.outer, B.distance, B.chosen)


@kernel
def sense_near(arrays, numbers, q, noise, buffers):
    """As :func:`sense`, with distances only where they can matter at this configuration.

    Returns
    -------
    count : int
        How many pairs give rows.
    smallest : float
        Smallest distance of the link surfaces [m].
    """
    B = buffers
    joint_frames(arrays, q, B.frames, B.tips)
    tip_jacobian(arrays, B.frames, B.tips, B.program.A)
    outer = numbers.outer if numbers.avoid else -np.inf
    near = B.cores, B.half, noise, numbers.thickness, outer, B.distance, B.witness
    smallest = near_distances(arrays, B.frames, *near)
    if not numbers.avoid or not len(B.distance):
        return 0, smallest
    for k in range(len(B.distance)):
        thickness = arrays.radius[arrays.pairs[k, 0]] + arrays.radius[arrays.pairs[k, 1]]
        B.distance[k] -= numbers.thickness * thickness
        if len(noise):
            B.distance[k] += noise[k]
    return select_pairs(arrays, numbers.selection, numbers.outer, B.distance, B.chosen), smallest


@kernel
def state(arrays, numbers, q, home, position, velocity, count, buffers):
    """Write the program after :func:`sense`; returns it with the rows in use.

    Parameters
    ----------
    home : (n,)
        Configuration that the repetitive term pulls to [rad].
    position, velocity : (A, 3)
        Where the tips shall be and how fast they shall move [m], [m/s].
    count : int
        How many of ``buffers.chosen`` give rows.
    """
    B, p = buffers, buffers.program
    for i in range(len(q)):
        p.target[i] = -numbers.repetition * (q[i] - home[i])
    for arm in range(len(B.tips)):
        for r in range(3):
            p.b[3 * arm + r] = velocity[arm, r] + numbers.feedback * (
                position[arm, r] - B.tips[arm, r]
            )
    joint_bounds(arrays, numbers, q, p.lower, p.upper)
    k = fill_rows(arrays, numbers, B.frames, B.distance, B.witness, B.chosen, count, p.G, p.h)
    return ProgramParts(p.target, p.A, p.b, p.G[:k], p.h[:k], p.lower, p.upper)


def stated_in(buffers: Buffers, rows: int) -> QuadraticProgram:
    """The problem that :func:`state` has left in the buffers, with so many rows in use."""
    p = buffers.program
    parts = p._replace(G=p.G[:rows], h=p.h[:rows])
    return QuadraticProgram(*(part.copy() for part in parts))
