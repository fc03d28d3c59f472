"""RRT-Connect and shortcuts over all joints of a scene in compiled code, with certified edges.

J. J. Kuffner and S. M. LaValle, RRT-Connect: an efficient approach to single-query path planning,
ICRA 2000. What OMPL does for :func:`.rrt_connect.plan_rrt_connect` with a checker in Python, and
edges that are proved free instead of looked at every 0.02 rad.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ...scene import Scene, certified_minimum
from ...scene.edge_model import edge_model
from ...scene.hull_pairs import hull_pairs
from ...scene.pair_kernels import capsules_capsules
from ...scene.placement import place
from .rrt_connect import SampledPlan
from .tree_kernels import MET, SPENT, Trees, search

#: Longest edge of a tree, as a share of the diagonal of the joint limits.
_STEP = 0.2
#: Samples of one compiled call, after which an interruption is heard.
_SAMPLES = 128
#: Shortcuts that are tried at most, and how many in turn may save nothing.
_SHORTCUTS, _PATIENCE = 200, 40
#: Share of the configurations that is left for making a path shorter.
_SHORTENING = 0.25
#: Nodes of one tree.
_NODES = 20_000


def plan_rrt_connect_compiled(
    scene: Scene,
    start: ArrayLike,
    goal: ArrayLike,
    rng: np.random.Generator,
    margin: float = 0.0,
    max_checks: int = 20_000,
    limits: tuple[np.ndarray, np.ndarray] | None = None,
) -> SampledPlan:
    """Path from ``start`` to ``goal`` (nq,) [rad, m] along which all pairs keep more than
    ``margin`` [m], proved between its rows too.

    Capsules of one arm are compared as they are; where they come nearer than the margin at an end,
    and hulls within them do not, the pair is judged when a path is found.

    Parameters
    ----------
    max_checks : int
        Configurations that may be looked at.
    limits : (nq,), (nq,)
        Box in which the arms may move, by default the limits of the joints; a joint whose limits
        coincide stands.

    Raises
    ------
    ConfigurationError, InputError
        Start or goal of the wrong shape, with NaN or infinity; a body that moves by itself.
    """
    ends = np.array([scene.configurations(end) for end in (start, goal)])
    lower, upper = scene.limits if limits is None else limits
    hulled = _hulled(scene, ends, margin)
    model = edge_model(scene, hulled)
    step = _STEP * float(np.linalg.norm(upper - lower))
    places = rng.random((_SHORTCUTS, 2))
    trees = Trees(
        np.empty((2, min(max_checks, _NODES) + 2, scene.nq)),
        np.empty((2, min(max_checks, _NODES) + 2), dtype=np.int64),
        np.array([1, 1, 0, 0]),
    )
    trees.nodes[:, 0], trees.parent[:, 0] = ends, -1
    most = (int((1.0 - _SHORTENING) * max_checks), max_checks)
    while True:
        samples = lower + rng.random((_SAMPLES, scene.nq)) * (upper - lower)
        outcome, path = search(model, trees, samples, places, step, margin, most, _PATIENCE)
        if outcome in (MET, SPENT):
            break
    checks = int(trees.counts[3])
    if outcome == SPENT or (hulled and certified_minimum(scene, path, enough=0.0).lower <= 0.0):
        return SampledPlan(None, checks)
    return SampledPlan(path, checks)


def _hulled(scene: Scene, ends: np.ndarray, margin: float) -> frozenset[int]:
    """Pairs of one arm that hulls tell apart and capsules, at one of the ends, do not."""
    columns = [pair.column for pairs in hull_pairs(scene).values() for pair in pairs]
    if not columns:
        return frozenset()
    bodies = scene.pairs.bodies
    rows = np.array([[body.row for body in bodies[k]] for k in columns], dtype=np.int64)
    cores = place(scene, ends, np.zeros(len(ends))).cores
    gaps = np.empty((len(ends), len(rows)))
    capsules_capsules(cores, scene.bodies.radius, rows, gaps, np.empty((0, 0, 3, 3)), 0)
    near = np.any(gaps <= margin, axis=0).tolist()
    return frozenset(k for k, one in zip(columns, near, strict=True) if one)
