"""Loop of :mod:`.cartesian_ik`: a point moves down its potential, and the arm is made to follow."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...arms.wrist_geometry import WristGeometry
from ...arms.wrist_ik import inverse_kinematics
from ...copies import copy_row, copy_rows
from ...kernel import kernel
from ...scene.vectors import along, dot, minus, rotated_back, scaled, vector
from ...settings import code
from ..field.field_kernels import Field, barrier, evaluate, repulsion, workspace
from ..field.nearest_kernels import witness
from ..settings import UpdateRule
from .compiled import REACHED, STEP_LIMIT, TRAPPED, End, distance
from .follow_reason import REASONS, FollowReason
from .termination import is_stuck, within
from .updates import ROUNDING

NO_POSTURE = REASONS.index(FollowReason.NO_POSTURE)
COLLIDES = REASONS.index(FollowReason.COLLIDES)
_GRADIENT, _SEARCH = code(UpdateRule.GRADIENT), code(UpdateRule.NEIGHBOUR_SEARCH)
#: Change of a joint from one point to the next [rad] beyond which a posture is not a continuation.
JUMP = 0.5


class Follower(NamedTuple):
    """What makes the arm follow the point.

    ``point`` is the field of a free point, whose place is written into its only control point;
    ``checked`` has the control points that are looked at for collisions. ``goal_rotation`` and
    ``turn``, R_goal^T R_start as a rotation vector, give the orientation of the tool.
    """

    point: Field
    checked: Field
    geometry: WristGeometry
    goal_rotation: np.ndarray


@kernel
def follow(follower, field, rules, start, turn, rows):
    """One run from ``start`` (nq,); fills ``rows`` and returns an :class:`.compiled.End`.

    ``field`` is that of the flange. Ends too where no posture continues the motion to the next
    point, and where all that do collide.
    """
    work, free = workspace(field), workspace(follower.point)
    for j in range(len(free.frames)):
        copy_rows(follower.point.base, free.frames[j])
    look = workspace(follower.checked)
    copy_row(start, rows.path[0])
    terms = evaluate(field, start, 0, work)
    X, whole = terms.flange, distance(terms.flange, field.goal_point)
    for step in range(rules.step_limit + 1):
        q = rows.path[step]
        here = potential(follower.point, X, step, free)
        rows.potential[step] = here
        rows.repulsive[step] = free.repulsive
        rows.clearance[step] = free.clearance
        rows.attractive[step] = here - free.repulsive[0]
        rows.virtual[step] = 0.0
        rows.active[step] = False
        reason = -1
        if within(
            np.abs(q - field.goal).max(),
            distance(X, field.goal_point),
            rules.joint_tolerance,
            rules.position_tolerance,
        ):
            reason = REACHED
        elif step == rules.step_limit:
            reason = STEP_LIMIT
        elif not (rules.after_obstacles_rest and step < len(field.cores) - 1) and is_stuck(
            rules.stuck_rule,
            rules.stuck_steps,
            rules.stuck_threshold,
            rows.path,
            rows.potential,
            0,
            step,
        ):
            reason = TRAPPED
        if reason < 0:
            bound = rules.max_step * distance(X, field.base[:, 3])
            X = next_point(follower.point, rules, X, step, here, bound, free)
            left = min(distance(X, field.goal_point) / whole, 1.0) if whole > 0.0 else 0.0
            R = follower.goal_rotation @ rotation(left * turn)
            reason = posture(follower, field.base, R, X, q, step, rules, look, rows.path[step + 1])
        if reason >= 0:
            return End(reason, step, 0, 0)
    return End(STEP_LIMIT, rules.step_limit, 0, 0)


@kernel
def potential(field, X, step, work):
    """U(X) of the free point."""
    copy_row(X, field.local[0, 0])
    copy_row(X, field.local[0, 1])
    gap = minus(X, vector(field.goal_point))
    return repulsion(field, 0, 1, step, work) + 0.5 * field.position_gain * dot(gap, gap)


@kernel
def slope_at(field, X, step, work):
    """dU/dX at the point whose potential was evaluated last."""
    row = min(step, len(field.cores) - 1)
    total = scaled(field.position_gain, minus(X, vector(field.goal_point)))
    shapes = (field.cores[row], field.core_radius, field.boxes[row], field.half, field.planes)
    for g in range(work.distance.shape[1]):
        if work.distance[0, g] < field.influence:
            outward = witness(field.local[0], work.frames[0], *shapes, work.shape[0, g])[1]
            d = work.distance[0, g]
            steep = barrier(field.gain, field.influence, field.contact, d)[1]
            total = along(total, field.weight[0] * steep, outward)
    return total


@kernel
def next_point(field, rules, X, step, here, bound, work):
    """The point one step on: down the gradient, or the best of 26 neighbours and the point itself.

    A step is at most ``bound`` long [m]; without a gain it has that length.
    """
    if rules.update == _SEARCH:
        edge, best, found = bound / np.sqrt(3.0), here, X
        for k in range(27):
            change = (float(k // 9 - 1), float(k // 3 % 3 - 1), float(k % 3 - 1))
            trial = along(X, edge, change)
            value = potential(field, trial, step, work)
            if value < best:
                best, found = value, trial
        return found
    slope = slope_at(field, X, step, work)
    square = dot(slope, slope)
    if square == 0.0:
        return X
    if rules.update != _GRADIENT:
        return along(X, -bound / np.sqrt(square), slope)
    t = min(rules.gain, bound / np.sqrt(square))
    for _ in range(rules.max_halvings + 1):
        if t * square <= ROUNDING * here:
            break
        trial = along(X, -t, slope)
        decrease = rules.sufficient_decrease * t * square
        if potential(field, trial, step, work) <= here - decrease:
            return trial
        t *= 0.5
    return X


@kernel
def posture(follower, base, R, X, q, step, rules, look, out):
    """The nearest posture at the next point that does not collide, into ``out``; a reason to end
    where there is none, else -1."""
    pose = np.zeros((1, 4, 4))
    for c in range(3):
        copy_row(rotated_back(base, (R[0, c], R[1, c], R[2, c])), pose[0, :3, c])
    away = minus(X, (base[0, 3], base[1, 3], base[2, 3]))
    copy_row(rotated_back(base, away), pose[0, :3, 3])
    pose[0, 3, 3] = 1.0
    branches = inverse_kinematics(follower.geometry, pose, q, rules.lower, rules.upper)[0]
    reason, nearest = NO_POSTURE, JUMP
    for k in range(len(branches)):
        change = np.abs(branches[k] - q).max()
        if change <= nearest:  # no branch: NaN
            evaluate(follower.checked, branches[k], step + 1, look)
            if look.clearance.min() > 0.0:
                nearest, reason = change, -1
                copy_row(branches[k], out)
            elif reason >= 0:
                reason = COLLIDES
    return reason


@kernel
def rotation(v):
    """exp of a rotation vector (3,), by the formula of Rodrigues."""
    angle = np.sqrt((v * v).sum())
    K = np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])
    a, b = 1.0, 0.5
    if angle > 1e-8:
        a, b = np.sin(angle) / angle, (1.0 - np.cos(angle)) / (angle * angle)
    return np.eye(3) + a * K + b * (K @ K)
