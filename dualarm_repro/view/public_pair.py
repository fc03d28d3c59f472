"""Two of one arm beside each other: whether they can be planned, and whether the report is true."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice
from typing import Any

import numpy as np
import pinocchio as pin

from ..arms.arm import Arm
from ..arms.fit.postures import home_pose
from ..baselines.sampling import rrt_connect
from ..planning import FoundPath, PathProblem, PlannerSettings
from ..planning.checks.mesh_replay import mesh_distance
from ..scene import PlacedArm, Scene, certified_minimum, distances, links_of

OF_PAIR = ("pair_reached", "pair_reason", "pair_lower", "pair_meshes", "pair_apart")
SHARE = 0.9  # of the reach, between the bases
WIDER = (1.0, 1.25, 1.5)  # times that, tried in turn until postures of both are clear
ROOM = 0.002  # distance at start and goal [m]
ALONE, DRAWS = 200, 400  # postures of one arm, and of both, among which ends are sought
GOALS = 4  # that are tried one after the other
EVALUATIONS = 2000  # of all of them together
ROWS = 60  # of the path, in which the meshes are looked at
_TOLERANCE, _BUDGET = 5e-3, 1500  # of the report [m], and configurations it may compute
_FINER = 3000  # of these, where the report has to be finer to tell

FOUND, NOT_FOUND = "found", "none found"
FIXED = "its joints cannot move"
SELF, OTHER = "touches itself", "touches the other"


def planned_pair(arm: Arm, rng: np.random.Generator) -> dict[str, Any]:
    """Plan from one clear posture of both arms to another, and replay the motion on the meshes.

    Returns
    -------
    dict
        ``pair_apart`` [m] between the bases; ``pair_reached``, whether a plan was found to one of
        :data:`GOALS` goals, none where no two postures of both are clear; ``pair_reason``, in words
        why; ``pair_lower`` [m], the certified distance of the motion: of the straight one where no
        plan was found; ``pair_meshes`` [m], the distance of the exact shapes in its samples.
    """
    apart = distance_of_bases(arm, rng)
    row = dict.fromkeys(OF_PAIR) | {"pair_apart": apart}
    if not np.any(arm.upper > arm.lower):
        return row | {"pair_reason": FIXED}
    single = clear_alone(arm, rng)
    if len(single) < 2:
        return row | {"pair_reason": SELF}
    for wider in WIDER:
        row["pair_apart"] = wider * apart
        scene = two_of(arm, wider * apart)
        ends = list(islice(clear_postures(scene, single, rng), 1 + GOALS))
        if len(ends) > 1:
            break
    else:
        return row | {"pair_reason": OTHER}
    start, *goals = ends
    most = EVALUATIONS // len(goals)
    for goal in goals:
        settings = PlannerSettings(seed=int(rng.integers(2**31 - 2)), evaluations=most)
        found = rrt_connect(PathProblem(scene, start, goal, settings))
        if found.claimed:
            return row | {"pair_reason": FOUND} | judged(scene, found)
    straight = FoundPath(np.array([start, goals[-1]]), found.reason)
    return row | {"pair_reason": NOT_FOUND} | judged(scene, straight)


def two_of(arm: Arm, apart: float) -> Scene:
    """Two of an arm whose bases are so far apart along y [m]."""
    half = np.array([0.0, 0.5 * apart, 0.0])
    bases = (pin.SE3(np.eye(3), half), pin.SE3(np.eye(3), -half))
    return Scene([PlacedArm(f"arm{k}", arm, base) for k, base in enumerate(bases)])


def judged(scene: Scene, found: FoundPath) -> dict[str, Any]:
    """The columns of a path that follow from the path."""
    bracket = certified_minimum(scene, found.path, tolerance=_TOLERANCE, budget=_BUDGET)
    if bracket.lower <= 0.0 < bracket.upper:
        half = 0.5 * bracket.upper
        bracket = certified_minimum(scene, found.path, None, half, half, budget=_FINER)
    at = np.linspace(0.0, len(found.path) - 1.0, ROWS)
    index = np.arange(len(found.path), dtype=float)
    rows = np.column_stack([np.interp(at, index, column) for column in found.path.T])
    return {
        "pair_reached": found.claimed,
        "pair_lower": bracket.lower,
        "pair_meshes": mesh_distance(scene, np.vstack([rows, bracket.q])),
    }


def distance_of_bases(arm: Arm, rng: np.random.Generator) -> float:
    """:data:`SHARE` of the reach, or so far that all that stands with one base is beside all that
    stands with the other [m]."""
    links = links_of(arm)
    sides = links.local[links.joint == 0, :, 1], links.radius[links.joint == 0, np.newaxis]
    if not len(sides[1]):
        return SHARE * flange_reach(arm, rng)
    width = float((sides[0] + sides[1]).max() - (sides[0] - sides[1]).min())
    return max(SHARE * flange_reach(arm, rng), width + ROOM)


def flange_reach(arm: Arm, rng: np.random.Generator) -> float:
    """Farthest that a joint origin or the flange comes from the axis of the base in 2000 postures
    within the limits [m]."""
    origins = arm.joint_positions(arm.random_configurations(2000, rng))
    return float(np.linalg.norm(origins[..., :2], axis=-1).max())


def clear_alone(arm: Arm, rng: np.random.Generator) -> np.ndarray:
    """Postures (K, nq) in which nothing of one arm is nearer to itself than :data:`ROOM`, first
    that of home if it is one."""
    drawn = np.vstack([home_pose(arm.model), arm.random_configurations(ALONE, rng)])
    scene = Scene([PlacedArm("arm", arm)])
    found: np.ndarray = drawn[distances(scene, drawn).min(axis=1, initial=np.inf) > ROOM]
    return found


def clear_postures(
    scene: Scene, single: np.ndarray, rng: np.random.Generator
) -> Iterator[np.ndarray]:
    """Postures of both arms in which nothing is nearer than :data:`ROOM`, of the first of those of
    one arm (K, nq) in both, and of pairs drawn from them."""
    first = np.zeros((1, 2), dtype=int)
    for both in np.vstack([first, rng.integers(len(single), size=(DRAWS, 2))]):
        q = single[both].ravel()
        if distances(scene, q).min(initial=np.inf) > ROOM:
            yield q
