"""Edges proved free, and RRT-Connect upon them, beside Pinocchio's checks and OMPL on the same.

The peers look at the same capsules with the same margin by ``pin.computeCollisions`` (stop at the
first contact), at states 0.02 rad apart; answers are compared before anything is timed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from importlib.util import find_spec
from itertools import count

import numpy as np
import pinocchio as pin
from timing import OURS, Row, timed

from dualarm_repro.arms import load_arm
from dualarm_repro.baselines.pinocchio_scene import whole_model
from dualarm_repro.planning.search.rrt_connect_compiled import plan_rrt_connect_compiled
from dualarm_repro.scene import PlacedArm, Scene, Sphere, distances
from dualarm_repro.scene.edges import free_edges

_MARGIN, _RESOLUTION, _EDGES, _TASKS = 0.005, 0.02, 256, 8
_MOST = 20_000


def scenes() -> dict[str, Scene]:
    """One IRB 120 among two spheres, and two face to face."""
    arm = load_arm("irb120")
    turned = pin.SE3(pin.rpy.rpyToMatrix(0.0, 0.0, np.pi), np.array([0.4, 0.0, 0.0]))
    pair = [PlacedArm("a", arm, pin.SE3(np.eye(3), np.array([-0.4, 0.0, 0.0])))]
    pair.append(PlacedArm("b", arm, turned))
    balls = {"first": Sphere([0.35, 0.1, 0.5], 0.08), "second": Sphere([0.3, -0.25, 0.4], 0.07)}
    between = {"first": Sphere([0.0, 0.1, 0.6], 0.05), "second": Sphere([0.0, -0.25, 0.4], 0.06)}
    return {
        "one arm": Scene([PlacedArm("a", arm)], balls),
        "two arms, 12 joints": Scene(pair, between),
    }


def checker(scene: Scene, margin: float) -> Callable[[np.ndarray], bool]:
    """Whether a configuration keeps the margin, by Pinocchio and coal."""
    model, geometry = whole_model(scene)
    data, shapes = model.createData(), pin.GeometryData(geometry)
    for request in shapes.collisionRequests:
        request.security_margin = margin
    return lambda q: not pin.computeCollisions(model, data, geometry, shapes, q, True)


def measure() -> Iterator[Row]:
    """Time per edge and per path; a peer that is not installed is left out."""
    for name, scene in scenes().items():
        free, rng = checker(scene, _MARGIN), np.random.default_rng(0)
        starts = rng.uniform(*scene.limits, (_EDGES, scene.nq))
        ends = starts + rng.uniform(-0.4, 0.4, starts.shape)

        def sampled(
            starts: np.ndarray = starts, ends: np.ndarray = ends, free: Callable = free
        ) -> list[bool]:
            found = []
            for a, b in zip(starts, ends, strict=True):
                pieces = int(np.ceil(np.abs(b - a).max() / _RESOLUTION))
                found.append(all(free(a + s * (b - a)) for s in np.linspace(0.0, 1.0, pieces + 1)))
            return found

        ours = free_edges(scene, starts, ends, _MARGIN)
        if np.mean(ours == np.array(sampled())) < 0.98:
            raise SystemExit(f"{name}: the edges that are compared are not the same")
        task = f"edge validity, {name}"
        proved = lambda s=scene, a=starts, b=ends: free_edges(s, a, b, _MARGIN)  # noqa: E731
        yield timed(task, OURS, proved, _EDGES)
        yield timed(task, "pin.computeCollisions every 0.02 rad", sampled, _EDGES)
        yield from _paths(f"path, {name}", scene, free)


def _paths(task: str, scene: Scene, free: Callable[[np.ndarray], bool]) -> Iterator[Row]:
    tasks, seeds = blocked_tasks(scene), (count(), count())

    def ours() -> None:
        for a, b in tasks:
            rng = np.random.default_rng(next(seeds[0]))
            if not plan_rrt_connect_compiled(scene, a, b, rng, _MARGIN, _MOST).reached:
                raise SystemExit(f"{task}: no path")

    yield timed(task, OURS, ours, _TASKS)
    if find_spec("ompl"):
        call = lambda: [ompl_path(scene, a, b, free, next(seeds[1])) for a, b in tasks]  # noqa: E731
        yield timed(task, "RRT-Connect of OMPL, simplified", call, _TASKS)


def blocked_tasks(scene: Scene) -> list[np.ndarray]:
    """Pairs of free configurations whose straight line is barred."""
    rng, found = np.random.default_rng(1), []
    lower, upper = scene.limits
    while len(found) < _TASKS:
        ends = rng.uniform(0.6 * lower, 0.6 * upper, (2, scene.nq))
        apart = distances(scene, ends).min() > 0.02
        if apart and not free_edges(scene, ends[:1], ends[1:], _MARGIN)[0]:
            found.append(ends)
    return found


def ompl_path(
    scene: Scene, start: np.ndarray, goal: np.ndarray, free: Callable[[np.ndarray], bool], seed: int
) -> np.ndarray:
    """A path of OMPL's RRT-Connect, simplified (N, nq) [rad]."""
    from ompl import base, geometric, util

    util.setLogLevel(util.LOG_NONE)
    util.RNG.setSeed(seed + 1)
    joints, looked = range(scene.nq), count()
    space, bounds = base.RealVectorStateSpace(scene.nq), base.RealVectorBounds(scene.nq)
    for j, (low, high) in enumerate(zip(*scene.limits, strict=True)):
        bounds.setLow(j, float(low))
        bounds.setHigh(j, float(high))
    space.setBounds(bounds)
    setup = geometric.SimpleSetup(space)

    def valid(state: object) -> bool:
        next(looked)
        return free(np.array([state[j] for j in joints]))

    setup.setStateValidityChecker(valid)
    information = setup.getSpaceInformation()
    information.setStateValidityCheckingResolution(_RESOLUTION / space.getMaximumExtent())
    ends = []
    for q in (start, goal):
        state = space.allocState()
        for j in joints:
            state[j] = float(q[j])
        ends.append(state)
    setup.setStartAndGoalStates(*ends)
    setup.setPlanner(geometric.RRTConnect(information))
    setup.solve(base.PlannerTerminationCondition(lambda: next(looked) > 10 * _MOST))
    path = setup.getSolutionPath()
    most = next(looked) + _MOST // 3
    over = base.PlannerTerminationCondition(lambda: next(looked) > most)
    geometric.PathSimplifier(information).simplify(path, over)
    return np.array([[state[j] for j in joints] for state in path.getStates()])
