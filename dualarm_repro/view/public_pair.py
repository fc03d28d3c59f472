"""Two of one arm, 0.9 reach apart: whether they can be planned, and whether the report is true."""

from __future__ import annotations

from typing import Any

import numpy as np
import pinocchio as pin

from ..arms.arm import Arm
from ..arms.fit.evidence import home_pose
from ..baselines.sampling import rrt_connect
from ..planning import FoundPath, PathProblem, PlannerSettings
from ..planning.checks.mesh_replay import mesh_distance
from ..scene import PlacedArm, Scene, certified_minimum, distances

OF_PAIR = ("pair_reached", "pair_lower", "pair_meshes", "pair_apart")
SHARE = 0.9  # of the reach, between the bases
ROOM = 0.01  # distance at start and goal [m]
DRAWS = 400  # postures among which start and goal are sought
EVALUATIONS = 2000
ROWS = 60  # of the path, in which the meshes are looked at
_TOLERANCE, _BUDGET = 5e-3, 1500  # of the report [m], and configurations it may compute


def planned_pair(arm: Arm, rng: np.random.Generator) -> dict[str, Any]:
    """Plan from one clear posture of both arms to another, and replay the motion on the meshes.

    Returns
    -------
    dict
        ``pair_apart`` [m] between the bases; ``pair_reached``, whether a plan was found, none where
        no posture of both is clear; ``pair_lower`` [m], the certified distance of the motion: of
        the straight one where no plan was found; ``pair_meshes`` [m], the distance of the exact
        shapes in its samples.
    """
    apart = SHARE * flange_reach(arm, rng)
    half = np.array([0.0, 0.5 * apart, 0.0])
    bases = (pin.SE3(np.eye(3), half), pin.SE3(np.eye(3), -half))
    scene = Scene([PlacedArm(f"arm{k}", arm, base) for k, base in enumerate(bases)])
    ends = clear_postures(scene, arm, rng)
    row = dict.fromkeys(OF_PAIR) | {"pair_apart": apart}
    if ends is None:
        return row
    settings = PlannerSettings(seed=int(rng.integers(2**31 - 2)), evaluations=EVALUATIONS)
    found = rrt_connect(PathProblem(scene, *ends, settings))
    path = found.path if found.claimed else np.array(ends)
    return row | judged(scene, FoundPath(path, found.reason))


def judged(scene: Scene, found: FoundPath) -> dict[str, Any]:
    """The columns of a path that follow from the path."""
    bracket = certified_minimum(scene, found.path, tolerance=_TOLERANCE, budget=_BUDGET)
    at = np.linspace(0.0, len(found.path) - 1.0, ROWS)
    index = np.arange(len(found.path), dtype=float)
    rows = np.column_stack([np.interp(at, index, column) for column in found.path.T])
    return {
        "pair_reached": found.claimed,
        "pair_lower": bracket.lower,
        "pair_meshes": mesh_distance(scene, np.vstack([rows, bracket.q])),
    }


def flange_reach(arm: Arm, rng: np.random.Generator) -> float:
    """Farthest that a joint origin or the flange comes from the axis of the base in 2000 postures
    within the limits [m]."""
    origins = arm.joint_positions(arm.random_configurations(2000, rng))
    return float(np.linalg.norm(origins[..., :2], axis=-1).max())


def clear_postures(
    scene: Scene, arm: Arm, rng: np.random.Generator
) -> tuple[np.ndarray, np.ndarray] | None:
    """Two postures of both arms in which nothing is nearer than :data:`ROOM`, the first that of
    home where it is clear; None if there are no two among those drawn."""
    drawn = arm.random_configurations(2 * DRAWS, rng).reshape(DRAWS, 2 * arm.nq)
    home = np.tile(home_pose(arm.model), 2)
    found = []
    for q in (home, *drawn):
        if distances(scene, q).min(initial=np.inf) > ROOM:
            found.append(q)
        if len(found) == 2:
            return found[0], found[1]
    return None
