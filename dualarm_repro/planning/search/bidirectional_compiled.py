"""The loop of :mod:`.bidirectional`, compiled: the same path, hundreds of times faster."""

from __future__ import annotations

from time import perf_counter
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ...arms.chain import Chain
from ...kernel import inlined, kernel
from ...scene.bodies import PlacedArm
from ...scene.points import point_box, point_capsule
from ...scene.posing import set_frames
from ...scene.vectors import dot, minus, out_of_frame, scaled, vector
from ...settings import code
from ..descent.adaptive_step import step_length
from ..descent.termination import StopReason
from ..field.control_points import base_of
from ..field.hull_obstacle import HullTrack, point_hull
from ..field.joint_attraction import set_conic_force
from ..field.obstacles import Obstacles
from ..field.repulsive_force import add_torque, inverse_distance_force
from ..field.variable_gain import gain_factor, is_flip
from ..settings import Combination
from .bidirectional_settings import BidirectionalSettings, UpdateOrder
from .search_plan import SearchPlan, SearchRecord
from .search_problem import SearchProblem, search_problem

_REACHED, _TRAPPED, _STEP_LIMIT = map(
    code, (StopReason.REACHED, StopReason.TRAPPED, StopReason.STEP_LIMIT)
)


class SearchField(NamedTuple):
    """Constants of the search, see :class:`.control_points.ControlPoints`,
    :class:`.obstacles.Obstacles` (at their first step) and the settings."""

    chain: Chain
    base: np.ndarray
    joint: np.ndarray
    local: np.ndarray
    point_radius: np.ndarray
    cores: np.ndarray
    core_radius: np.ndarray
    boxes: np.ndarray
    half: np.ndarray
    planes: np.ndarray
    nearest_only: bool
    zeta: float
    threshold: float
    measure: int
    eta: float
    influence: float
    contact: float


class SearchRules(NamedTuple):
    """SearchRules of gain, step and end, see the settings."""

    gain_rule: int
    kappa: float
    band: float
    flip: int
    step_rule: int
    length: float
    floor: float
    cap: float
    weights: np.ndarray
    two_sided: bool
    aims_at_old_end: bool
    tolerance: float
    limit: int
    stuck_searches: int
    stuck_progress: float
    lower: np.ndarray
    upper: np.ndarray


class SearchRows(NamedTuple):
    """Where the loop writes: paths (2, L, nq), distances and gain factors (2, L, K)."""

    path: np.ndarray
    clearance: np.ndarray
    factor: np.ndarray


class Memory(NamedTuple):
    """Per half: last direction (2, nq), whether there is one, flips, their last distances (2,
    K).
    """

    direction: np.ndarray
    moved: np.ndarray
    flips: np.ndarray
    flip_distance: np.ndarray


def plan_bidirectional_compiled(
    placed: PlacedArm,
    start: ArrayLike,
    goal: ArrayLike,
    obstacles: Obstacles,
    settings: BidirectionalSettings,
    hulls: tuple[HullTrack, HullTrack] | None = None,
) -> SearchPlan:
    """As :func:`.bidirectional.plan_bidirectional`."""
    made = search_problem(placed, start, goal, obstacles, settings, hulls)
    return SearchPlan(made, search_compiled(made))


def search_compiled(made: SearchProblem) -> SearchRecord:
    """As :func:`.bidirectional.search`."""
    began = perf_counter()
    sides = 2 if made.settings.two_sided else 1
    count = made.settings.ending.search_limit + 1
    points, joints = len(made.points.joint), len(made.start)
    rows = SearchRows(
        np.empty((2, count, joints)), np.empty((2, count, points)), np.empty((2, count, points))
    )
    memory = Memory(
        np.zeros((2, joints)),
        np.zeros(2, dtype=np.bool_),
        np.zeros(2, dtype=np.int64),
        np.full((2, points), np.inf),
    )
    reason, last = run(
        search_field(made), search_rules(made), made.hulls, made.start, made.goal, rows, memory
    )
    paths, clearances, factors = (
        tuple(part[side, : last + 1].copy() for side in range(sides)) for part in rows
    )
    flips = tuple(int(n) for n in memory.flips[:sides])
    end = list(StopReason)[reason]
    return SearchRecord(paths, clearances, factors, flips, end, perf_counter() - began)


def search_field(made: SearchProblem) -> SearchField:
    """Arrays and numbers of a problem."""
    obstacles, settings = made.obstacles, made.settings
    return SearchField(
        made.placed.arm.chain,
        base_of(made.placed),
        made.points.joint,
        np.ascontiguousarray(made.points.local[:, 0]),
        made.points.radius,
        obstacles.cores[0],
        obstacles.radius,
        obstacles.boxes[0],
        obstacles.half,
        obstacles.planes,
        settings.repulsion.sources is Combination.NEAREST,
        settings.attraction.gain,
        settings.attraction.threshold,
        code(settings.attraction.measure),
        settings.repulsion.gain,
        settings.repulsion.influence,
        settings.repulsion.contact,
    )


def search_rules(made: SearchProblem) -> SearchRules:
    """Numbers of a problem's rules."""
    gain, step, ending = made.settings.variable_gain, made.settings.step, made.settings.ending
    return SearchRules(
        code(gain.rule),
        gain.kappa,
        gain.band,
        code(gain.flip),
        code(step.rule),
        step.length,
        step.floor,
        step.cap,
        made.weights,
        made.settings.two_sided,
        made.settings.order is UpdateOrder.BEFORE,
        ending.tolerance,
        ending.search_limit,
        ending.stuck_searches,
        ending.stuck_progress,
        *made.limits,
    )


@kernel
def run(field, rules, hulls, start, goal, rows, memory):
    """Search until a named end; returns its code and the number of searches."""
    force, frames = np.empty(len(start)), np.empty((len(start) + 1, 3, 4))
    shapes = len(field.core_radius) + len(field.half) + len(field.planes)
    around = np.empty((shapes + min(1, len(hulls[0].planes)), 4))
    for j in range(len(start)):
        rows.path[0, 0, j], rows.path[1, 0, j] = start[j], goal[j]
    closest, since = np.inf, 0
    for turn in range(rules.limit + 1):
        forward = rows.path[0, turn]
        target = rows.path[1, turn] if rules.two_sided else goal
        gap = 0.0
        for j in range(len(start)):
            gap += (forward[j] - target[j]) ** 2
        gap = np.sqrt(gap)
        if gap < closest - rules.stuck_progress:
            closest, since = gap, turn
        reason = -1
        if gap <= rules.tolerance:
            reason = _REACHED
        elif turn == rules.limit:
            reason = _STEP_LIMIT
        elif turn - since >= rules.stuck_searches:
            reason = _TRAPPED
        for side in range(2 if rules.two_sided else 1):  # a loop, so that each is compiled once
            aim = target
            if side == 1:
                late = reason < 0 and not rules.aims_at_old_end
                aim = rows.path[0, turn + 1] if late else forward
            resultant(
                field, rules, hulls[side], side, turn, aim, rows, memory, frames, around, force
            )
            if reason < 0:
                move(field, rules, side, turn, force, rows, memory)
        if reason >= 0:
            return reason, turn
    return _STEP_LIMIT, rules.limit


@inlined
def resultant(field, rules, hulls, side, turn, target, rows, memory, frames, around, force):
    """F_att + F_rep of one half into ``force``; notes distances and gain factors."""
    q = rows.path[side, turn]
    set_frames(field.chain, field.base, q, frames)
    set_conic_force(q, target, field.zeta, field.threshold, field.measure, force)
    row = min(turn, len(hulls.planes) - 1)
    for k in range(len(field.joint)):
        joint = field.joint[k]
        point = out_of_frame(frames[joint], vector(field.local[k]))
        nearest = distances(field, hulls, row, k, point, around)
        rho = around[nearest, 0] if nearest >= 0 else np.inf
        factor = gain_factor(
            rules.gain_rule,
            rules.kappa,
            rules.band,
            rho,
            memory.flip_distance[side, k],
            memory.flips[side],
        )
        rows.clearance[side, turn, k] = rho
        rows.factor[side, turn, k] = factor
        for m in range(len(around)):
            if around[m, 0] < field.influence and (m == nearest or not field.nearest_only):
                strength = inverse_distance_force(
                    around[m, 0], factor * field.eta, field.influence, field.contact
                )
                add_torque(frames, joint, point, scaled(strength, vector(around[m, 1:])), force)


@inlined
def distances(field, hulls, row, k, point, around):
    """Distance of control point k to every shape and its gradient, into ``around`` (M, 4); returns
    which shape is nearest, -1 without any."""
    m = 0
    for i in range(len(field.core_radius)):
        a = vector(field.cores[i, 0])
        axis = minus(vector(field.cores[i, 1]), a)
        _note(around, m, point_capsule(point, a, axis, field.core_radius[i]), field.point_radius[k])
        m += 1
    for i in range(len(field.half)):
        found = point_box(point, field.boxes[i], vector(field.half[i]))
        _note(around, m, found, field.point_radius[k])
        m += 1
    for i in range(len(field.planes)):
        up = vector(field.planes[i])
        _note(around, m, (dot(up, point) - field.planes[i, 3], up), field.point_radius[k])
        m += 1
    if row >= 0:
        found = point_hull(point, hulls.planes[row], hulls.triangles[row])
        _note(around, m, found, field.point_radius[k])
    nearest = -1
    for i in range(len(around)):
        if nearest < 0 or around[i, 0] < around[nearest, 0]:
            nearest = i
    return nearest


@inlined
def _note(around, m, found, radius):
    around[m, 0] = found[0] - radius
    around[m, 1], around[m, 2], around[m, 3] = found[1]


@inlined
def move(field, rules, side, turn, force, rows, memory):
    """One step of a half along ``force``, after a look for a flip."""
    size = 0.0
    for j in range(len(force)):
        size += force[j] * force[j]
    size = np.sqrt(size)
    cosine = 0.0
    for j in range(len(force)):
        direction = force[j] / size if size > 0.0 else 0.0
        cosine += direction * memory.direction[side, j]
        memory.direction[side, j] = direction
    if memory.moved[side] and is_flip(rules.flip, cosine):
        memory.flips[side] += 1
        for k in range(len(field.joint)):
            memory.flip_distance[side, k] = rows.clearance[side, turn, k]
    memory.moved[side] = True
    length = step_length(
        rules.step_rule,
        rules.length,
        rules.floor,
        rules.cap,
        rules.weights,
        rows.clearance[side, turn],
        field.influence,
    )
    for j in range(len(force)):
        moved = rows.path[side, turn, j] + length * memory.direction[side, j]
        rows.path[side, turn + 1, j] = min(max(moved, rules.lower[j]), rules.upper[j])
