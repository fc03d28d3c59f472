"""Search from both ends by potential fields, in readable form; :mod:`.bidirectional_compiled` runs
it fast.

Each half moves along its resultant, q' = q + alpha F/|F|, F = F_att + F_rep, and is attracted by
where the other half is. The search ends when the halves are within a tolerance of each other. With
one side only it is the classic descent towards a goal that stands still.
"""

from __future__ import annotations

from dataclasses import dataclass
from time import perf_counter

import numpy as np
from numpy.typing import ArrayLike

from ...scene.bodies import PlacedArm
from ...scene.posing import cores_in
from ...settings import code
from ..descent.adaptive_step import step_length
from ..descent.termination import StopReason
from ..field.control_points import frames_of
from ..field.hull_obstacle import HullTrack, hull_distance
from ..field.joint_attraction import conic_force
from ..field.obstacles import Obstacles
from ..field.repulsive_force import inverse_distance_force, joint_torques
from ..field.variable_gain import gain_factor, is_flip
from ..settings import Combination
from .bidirectional_settings import BidirectionalSettings, UpdateOrder
from .search_plan import SearchPlan, SearchRecord
from .search_problem import SearchProblem, search_problem


def plan_bidirectional(
    placed: PlacedArm,
    start: ArrayLike,
    goal: ArrayLike,
    obstacles: Obstacles,
    settings: BidirectionalSettings,
    hulls: tuple[HullTrack, HullTrack] | None = None,
) -> SearchPlan:
    """Plan from ``start`` to ``goal`` [rad].

    Parameters
    ----------
    start, goal : (nq,)
    obstacles : Obstacles
        Standing obstacles.
    hulls : (HullTrack, HullTrack), optional
        The moving hull that the forward and the backward half meet, one row per search; the last
        row is held.

    Raises
    ------
    ConfigurationError, InputError
        See :func:`.search_problem.search_problem`.
    """
    made = search_problem(placed, start, goal, obstacles, settings, hulls)
    return SearchPlan(made, search(made))


def search(made: SearchProblem) -> SearchRecord:
    """The loop of :func:`plan_bidirectional`."""
    began = perf_counter()
    settings, ending = made.settings, made.settings.ending
    halves = [_Half(made, side) for side in range(2 if settings.two_sided else 1)]
    closest, since, turn = np.inf, 0, 0
    while True:
        reason: StopReason | None = None
        ends = [half.path[-1] for half in halves]
        target = ends[1] if settings.two_sided else made.goal
        gap = float(np.linalg.norm(ends[0] - target))
        if gap < closest - ending.stuck_progress:
            closest, since = gap, turn
        if gap <= ending.tolerance:
            reason = StopReason.REACHED
        elif turn == ending.search_limit:
            reason = StopReason.STEP_LIMIT
        elif turn - since >= ending.stuck_searches:
            reason = StopReason.TRAPPED
        forces = [halves[0].resultant(target, turn)]
        if reason is not None:
            if settings.two_sided:
                halves[1].resultant(ends[0], turn)
            break
        halves[0].move(forces[0])
        if settings.two_sided:
            before = settings.order is UpdateOrder.BEFORE
            halves[1].move(halves[1].resultant(ends[0] if before else halves[0].path[-1], turn))
        turn += 1
    return SearchRecord(
        tuple(np.array(half.path) for half in halves),
        tuple(np.array(half.clearance) for half in halves),
        tuple(np.array(half.factor) for half in halves),
        tuple(half.flips for half in halves),
        reason,
        perf_counter() - began,
    )


class _Half:
    """One half: its path, and what the variable gain remembers."""

    def __init__(self, made: SearchProblem, side: int) -> None:
        self._made, self._side = made, side
        self.path = [made.start if side == 0 else made.goal]
        self.clearance: list[np.ndarray] = []
        self.factor: list[np.ndarray] = []
        self.flips = 0
        self._flip_distance = np.full(len(made.points.joint), np.inf)
        self._direction: np.ndarray | None = None

    def resultant(self, target: np.ndarray, turn: int) -> np.ndarray:
        """F_att + F_rep at the end of the half, whose distances and gain factors are noted."""
        made, gain = self._made, self._made.settings.variable_gain
        found = surroundings_at(made, self._side, self.path[-1], turn)
        rho = found.distance.min(axis=1, initial=np.inf)
        rule = code(gain.rule), gain.kappa, gain.band
        known = zip(rho, self._flip_distance, strict=True)
        factor = np.array([gain_factor(*rule, r, at, self.flips) for r, at in known])
        self.clearance.append(rho)
        self.factor.append(factor)
        gains = factor * made.settings.repulsion.gain
        return resultant_at(made, found, self.path[-1], target, gains)

    def move(self, force: np.ndarray) -> None:
        """One step along the resultant, after a look for a flip."""
        made, step = self._made, self._made.settings.step
        size = np.linalg.norm(force)
        direction = force / size if size > 0.0 else np.zeros_like(force)
        if self._direction is not None and is_flip(
            code(made.settings.variable_gain.flip), direction @ self._direction
        ):
            self.flips += 1
            self._flip_distance = self.clearance[-1]
        self._direction = direction
        rule, influence = (code(step.rule), step.length), made.settings.repulsion.influence
        length = step_length(
            *rule, step.floor, step.cap, made.weights, self.clearance[-1], influence
        )
        self.path.append(np.clip(self.path[-1] + length * direction, *made.limits))


@dataclass(frozen=True, eq=False)
class Surroundings:
    """Distances of K control points to M shapes (K, M) [m] and their gradients (K, M, 3), the
    control points (K, 3) in the world, and the frames of the joints."""

    distance: np.ndarray
    outward: np.ndarray
    points: np.ndarray
    frames: np.ndarray

    def acting(self, sources: Combination) -> np.ndarray:
        """Mask (K, M) of the shapes that repel: all, or the nearest one of each control point."""
        if sources is Combination.SUM or not self.distance.size:
            return np.ones(self.distance.shape, dtype=bool)
        nearest = self.distance.argmin(axis=1)
        return np.arange(self.distance.shape[1]) == nearest[:, np.newaxis]


def surroundings_at(made: SearchProblem, side: int, q: np.ndarray, turn: int) -> Surroundings:
    """What is around the control points of one half at a search."""
    frames = frames_of(made.placed, q[np.newaxis])
    ends = cores_in(frames, made.points.joint, made.points.local)
    seen = made.obstacles.distances(ends, made.points.radius, 0)
    distance, _, outward = (part[0] for part in seen)
    points, hulls = ends[0, :, 0], made.hulls[side]
    if len(hulls.planes):
        row = min(turn, len(hulls.planes) - 1)
        found = [hull_distance(point, hulls.planes[row], hulls.triangles[row]) for point in points]
        gap = np.array([d for d, _ in found]) - made.points.radius
        away = np.array([direction for _, direction in found])
        distance = np.column_stack([distance, gap])
        outward = np.concatenate([outward, away[:, np.newaxis]], axis=1)
    return Surroundings(distance, outward, points, frames[0])


def resultant_at(
    made: SearchProblem, found: Surroundings, q: np.ndarray, target: np.ndarray, gains: np.ndarray
) -> np.ndarray:
    """F_att + F_rep (nq,) towards ``target``, with the gain eta_i of each control point (K,)."""
    pull = made.settings.attraction
    force = conic_force(q, target, pull.gain, pull.threshold, pull.measure)
    return force + repulsive_torque(made, found, gains)


def repulsive_torque(made: SearchProblem, found: Surroundings, gains: np.ndarray) -> np.ndarray:
    """F_rep(q) = sum_i J_v,i^T F_i (nq,) with the gain eta_i of each control point (K,)."""
    repulsion = made.settings.repulsion
    push = np.zeros_like(found.points)
    for k, m in zip(*np.nonzero(found.acting(repulsion.sources)), strict=True):
        strength = inverse_distance_force(
            found.distance[k, m], gains[k], repulsion.influence, repulsion.contact
        )
        push[k] += strength * found.outward[k, m]
    return joint_torques(found.frames, made.points.joint, found.points, push)
