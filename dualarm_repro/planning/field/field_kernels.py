"""The potentials of a problem and their gradient for one configuration, compiled.

The same numbers as :mod:`.potentials`, over plain arrays and buffers that are used again.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...arms.chain import Chain
from ...kernel import kernel
from ...scene.posing import set_frames
from ...scene.vectors import dot, minus, out_of_frame, scaled, vector
from ..descent.problem import PlanningProblem
from ..settings import Combination
from .control_points import base_of
from .nearest_kernels import nearest_shapes, witness
from .repulsive_force import add_torque


class Field(NamedTuple):
    """Constants of the potentials, see :class:`.control_points.ControlPoints`,
    :class:`.obstacles.Obstacles` and the settings; joint j carries the control points
    ``first[j]`` ... ``first[j + 1] - 1``."""

    chain: Chain
    base: np.ndarray
    first: np.ndarray
    joint: np.ndarray
    local: np.ndarray
    radius: np.ndarray
    weight: np.ndarray
    group: np.ndarray
    cores: np.ndarray
    core_radius: np.ndarray
    boxes: np.ndarray
    half: np.ndarray
    planes: np.ndarray
    gain: float
    influence: float
    contact: float
    goal: np.ndarray
    goal_point: np.ndarray
    position_gain: float
    joint_gain: float
    virtual_joints: np.ndarray
    virtual_point: np.ndarray
    virtual_position_gain: float
    virtual_joint_gain: float


class Terms(NamedTuple):
    """Potentials of one configuration, and its flange position X."""

    attractive: float
    repulsive: float
    virtual: float
    flange: tuple[float, float, float]


class Workspace(NamedTuple):
    """What :func:`evaluate` leaves for :func:`gradient`, and the ``gradient`` (nq,) itself.

    ``frames`` of base and joints (nq + 1, 3, 4); of every control point and obstacle the
    ``distance`` (K, G) of the nearest shape and the number of that ``shape``; ``repulsive``
    potential and ``clearance`` (K,) of the control points.
    """

    frames: np.ndarray
    distance: np.ndarray
    shape: np.ndarray
    repulsive: np.ndarray
    clearance: np.ndarray
    gradient: np.ndarray


def field_of(made: PlanningProblem) -> Field:
    """Arrays of a problem."""
    obstacles, repulsion = made.obstacles, made.repulsion
    summed = repulsion.combination is Combination.SUM
    position, joints = made.attraction.parts
    virtual_position, virtual_joints = made.virtual.parts
    return Field(
        made.placed.arm.chain,
        base_of(made.placed),
        np.searchsorted(made.points.joint, np.arange(len(made.start) + 2)),
        *made.points[1:],
        np.arange(len(obstacles.group)) if summed else obstacles.group,
        obstacles.cores,
        obstacles.radius,
        obstacles.boxes,
        obstacles.half,
        obstacles.planes,
        repulsion.gain,
        repulsion.influence,
        repulsion.contact,
        joints.target,
        position.target,
        position.gain,
        joints.gain,
        virtual_joints.target,
        virtual_position.target,
        virtual_position.gain,
        virtual_joints.gain,
    )


@kernel
def workspace(field):
    """Buffers for one run."""
    points, joints = len(field.joint), len(field.goal)
    groups = field.group.max() + 1 if len(field.group) else 0
    return Workspace(
        np.empty((joints + 1, 3, 4)),
        np.empty((points, groups)),
        np.empty((points, groups), dtype=np.int64),
        np.empty(points),
        np.empty(points),
        np.empty(joints),
    )


@kernel
def barrier(gain, influence, contact, d):
    """u(d) and u'(d), see :class:`.potentials.PointRepulsion`."""
    near = min(max(d, contact), influence)
    excess = 1.0 / near - 1.0 / influence
    slope = -gain * excess / (near * near)
    return 0.5 * gain * excess * excess + slope * min(d - contact, 0.0), slope


@kernel
def repulsion(field, first, last, step, work):
    """Potential of control points ``first`` ... ``last - 1`` with the frames in ``work``."""
    row = min(step, len(field.cores) - 1)
    gain, influence, contact, weight = field.gain, field.influence, field.contact, field.weight
    distance = work.distance
    nearest_shapes(
        field.joint[first:last],
        field.local[first:last],
        field.radius[first:last],
        work.frames,
        field.cores[row],
        field.core_radius,
        field.boxes[row],
        field.half,
        field.planes,
        field.group,
        distance[first:last],
        work.shape[first:last],
    )
    total = 0.0
    for k in range(first, last):
        energy, clearance = 0.0, np.inf
        for g in range(distance.shape[1]):
            d = distance[k, g]
            clearance = min(clearance, d)
            if d < influence:
                energy += barrier(gain, influence, contact, d)[0]
        work.clearance[k], work.repulsive[k] = clearance, weight[k] * energy
        total += weight[k] * energy
    return total


@kernel
def flange(field, frame):
    """X, from the frame of the last joint."""
    return out_of_frame(frame, vector(field.chain.translation[-1]))


@kernel
def squared_error(q, target):
    """|q - target|^2."""
    total = 0.0
    for j in range(len(q)):
        total += (q[j] - target[j]) ** 2
    return total


@kernel
def attractions(field, X, joint_square, virtual_square):
    """U_att and U_v for a flange position and squared distances of the joints to both targets."""
    to_goal = minus(X, vector(field.goal_point))
    to_virtual = minus(X, vector(field.virtual_point))
    goal = field.position_gain * dot(to_goal, to_goal) + field.joint_gain * joint_square
    virtual = field.virtual_position_gain * dot(to_virtual, to_virtual)
    return 0.5 * goal, 0.5 * (virtual + field.virtual_joint_gain * virtual_square)


@kernel
def evaluate(field, q, step, work):
    """All terms at one configuration."""
    set_frames(field.chain, field.base, q, work.frames)
    repulsive = repulsion(field, 0, len(field.joint), step, work)
    X = flange(field, work.frames[-1])
    joint_square = squared_error(q, field.goal)
    virtual_square = squared_error(q, field.virtual_joints)
    attractive, virtual = attractions(field, X, joint_square, virtual_square)
    return Terms(attractive, repulsive, virtual, X)


@kernel
def total_of(terms, attracts):
    """What the arm descends; ``attracts``: whether the goal and whether the virtual point do."""
    total = terms.repulsive
    if attracts[0]:
        total += terms.attractive
    if attracts[1]:
        total += terms.virtual
    return total


@kernel
def gradient(field, q, step, attracts, work):
    """dU/dq of the acting terms into ``work``, at the configuration evaluated last."""
    row = min(step, len(field.cores) - 1)
    gain, influence, contact = field.gain, field.influence, field.contact
    cores, core_radius, boxes, half = field.cores, field.core_radius, field.boxes, field.half
    frames, distance, out = work.frames, work.distance, work.gradient
    out[:] = 0.0
    for k in range(distance.shape[0]):
        joint = field.joint[k]
        for g in range(distance.shape[1]):
            if distance[k, g] < influence:
                number = work.shape[k, g]
                shapes = (cores[row], core_radius, boxes[row], half, field.planes)
                point, outward = witness(field.local[k], frames[joint], *shapes, number)
                slope = barrier(gain, influence, contact, distance[k, g])[1]
                add_torque(frames, joint, point, scaled(field.weight[k] * slope, outward), out)
    X = flange(field, frames[-1])
    if attracts[0]:
        pull = scaled(field.position_gain, minus(X, vector(field.goal_point)))
        add_torque(frames, len(q), X, pull, out)
        out += field.joint_gain * (q - field.goal)
    if attracts[1]:
        pull = scaled(field.virtual_position_gain, minus(X, vector(field.virtual_point)))
        add_torque(frames, len(q), X, pull, out)
        out += field.virtual_joint_gain * (q - field.virtual_joints)
