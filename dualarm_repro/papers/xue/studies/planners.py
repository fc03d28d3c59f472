"""The same scene by other planners, and with several obstacles, judged by whole links.

The conclusion leaves several obstacles to later work. Here spheres are added near the tracks of
both arms; the method as printed, the same with whole links repelled, and RRT-Connect for one arm
after the other and for both at once plan the scene. A motion counts as free where its certified
clearance is positive: over all links, between the steps too.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from importlib.util import find_spec
from typing import Any

import numpy as np

from ....errors import InputError
from ....ledger import REGISTRY, Study
from ....ledger.assumptions import Chosen
from ....planning.checks.counted_field import counted_descent
from ....planning.checks.link_clearance import certified_clearance
from ....planning.descent.problem import problem
from ....planning.field.control_points import control_points, end_effector, ends_of
from ....planning.field.obstacles import obstacles_of
from ....planning.master_slave import CoordinatedPlan, Task, plan_master_slave
from ....planning.search.rrt_connect import SampledPlan, plan_rrt_connect
from ....planning.trials.yardstick import PACKAGE
from ....scene import JointPath, PlacedArm, Scene, Sphere, distances
from .. import motions
from ..document import (
    Layout,
    Posed,
    arm_in_use,
    assumption,
    gains,
    master_start,
    placed_master,
    placed_slave,
    scene_of,
)
from ..outcomes import DESCENTS
from ..reading import CASE, Case, improved, nominal

#: Scenes by number of spheres added; without any the starts alone vary.
SCENES = {0: 6, 1: 8, 2: 8, 4: 8}
#: Radius of a sphere, and how far its centre lies from a track at most [m].
RADIUS, NEAR = 0.1, 0.5
#: What start and goal of either arm keep from a sphere [m].
FREE = 0.05
#: Configurations that RRT-Connect may check in a scene.
CHECKS = 20_000
_DRAWS = 1000  # of a start whose links are clear, and of a sphere that leaves the ends free
#: Of a certified clearance [m].
_TOLERANCE = 2e-3
METHODS = {
    "points": "as printed: five points repelled",
    "links": "whole links repelled",
    "rrt_in_turn": "RRT-Connect, one arm after the other",
    "rrt_both": "RRT-Connect, both arms at once",
}


def planners_cell(settings: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """All planners in one scene; their columns are ``<method>_<what>``."""
    case = nominal()
    start = placed_slave_start(case, settings["trial_perturbation"], rng)
    scene = crowded(case, settings["spheres"], start, rng)
    row: dict[str, Any] = {}
    for name, points in (("points", case.planner.control_points), ("links", "capsules")):
        made = replace(case.planner, control_points=points)
        row |= _columns(name, *_by_field(scene, case._replace(planner=made), start))
    if find_spec(PACKAGE) is not None:
        seed = int(rng.integers(2**31 - 2))
        row |= _columns("rrt_in_turn", *_in_turn(scene, start, seed))
        row |= _columns("rrt_both", *_both(scene, start, seed))
    return row


def placed_slave_start(case: Case, half_width: float, rng: np.random.Generator) -> np.ndarray:
    """A start of the slave as the trials of Table 2 have it, its links clear (6,) [rad]."""
    slave, scene = motions.present(placed_slave(case.layout), "slave"), scene_of(case.layout)
    for _ in range(_DRAWS):
        start = slave.start + rng.uniform(-half_width, half_width, slave.arm.nq)
        if distances(scene, scene.stack(master=master_start(), slave=start)).min() > 0.0:
            return start
    raise InputError("arrangement", "start of the slave", slave.start.tolist(), "clear links")


def crowded(case: Case, count: int, start: np.ndarray, rng: np.random.Generator) -> Scene:
    """Both arms, window and further spheres near their tracks; all ends of the motions are free.

    Raises
    ------
    InputError
        Nearly every sphere near a track is in the way of an end.
    """
    layout, planner = case.layout, case.planner
    plans = (motions.master_plan(layout, planner), motions.slave_plan(case))
    tracks = np.vstack([motions.present(plan, "plan of an arm").tcp for plan in plans])
    spheres: list[Sphere] = []
    for _ in range(_DRAWS):
        if len(spheres) == count:
            break
        centre = tracks[rng.integers(len(tracks))] + rng.uniform(-NEAR, NEAR, 3)
        sphere = Sphere(centre, RADIUS)
        if _leaves_ends_free(layout, sphere, start):
            spheres.append(sphere)
    if len(spheres) < count:
        raise InputError(
            "arrangement", "spheres", len(spheres), f"{count} that leave the ends free"
        )
    extra = {"spheres": tuple(spheres)} if spheres else {}
    obstacles = {"window": layout.window(), **extra}
    return Scene(_arms(layout), obstacles, self_collision=False)


def _leaves_ends_free(layout: Layout, sphere: Sphere, start: np.ndarray) -> bool:
    """Whether links at start and goal keep :data:`FREE`, and the points of the goals are out of
    the range of its repulsion."""
    arms = _arms(layout)
    alone = Scene(arms, {"sphere": sphere}, self_collision=False)
    ends = [np.concatenate([arms[0].start, start]), np.concatenate([arm.goal for arm in arms])]
    watched = ["sphere" in {body.owner for body in pair} for pair in alone.pairs.bodies]
    if distances(alone, np.array(ends))[:, watched].min() <= FREE:
        return False
    goals = [ends_of(arm, control_points(arm.arm, "frames_2_6"), arm.goal[np.newaxis])[0, :, 0]
             for arm in arms]  # fmt: skip
    away = np.linalg.norm(np.vstack(goals) - sphere.center, axis=1)
    return bool(away.min() - RADIUS > gains()["d_0"])


def _arms(layout: Layout) -> list[Posed]:
    """Master and slave with joints that turn fully, since print starts beyond the real limits."""
    master, slave = placed_master(layout), motions.present(placed_slave(layout), "slave")
    wide = arm_in_use("full_turns", assumption("upper_arm"))
    return [replace(master, arm=wide), replace(slave, arm=wide.mirrored())]


def _by_field(
    scene: Scene, case: Case, start: np.ndarray
) -> tuple[dict[str, JointPath] | None, Scene, int]:
    """Master, then slave, by the improved method; its postures are those of both arms."""
    arms = {arm.name: arm for arm in scene.arms if isinstance(arm, Posed)}
    begins = {"master": arms["master"].start, "slave": start}
    tasks = {
        name: Task(
            begins[name], arm.goal, improved(case.planner, case.layout.window_centre, arm.goal)
        )
        for name, arm in arms.items()
    }
    try:
        made = plan_master_slave(scene, tasks)
    except InputError:  # a start in contact
        return None, scene, 0
    postures = _postures(scene, made, tasks)
    arrived = all(plan.reached for plan in made.plans.values())
    return (made.paths if arrived else None), scene, postures


def _postures(scene: Scene, made: CoordinatedPlan[Any], tasks: Mapping[str, Task[Any]]) -> int:
    """Postures at which the field was looked at, over both arms, where both arrive."""
    if not all(plan.reached for plan in made.plans.values()):
        return 0
    obstacles, total = obstacles_of(scene), 0
    for name, task in tasks.items():
        placed = made.plans[name].placed
        total += counted_descent(problem(placed, task.start, task.goal, obstacles, task.settings))[
            1
        ]
        points = control_points(placed.arm, task.settings.control_points)
        obstacles = obstacles.with_arm(placed, points, made.paths[name])
    return total


def _in_turn(
    scene: Scene, start: np.ndarray, seed: int
) -> tuple[dict[str, JointPath] | None, Scene, int]:
    """One arm while the other waits at its start, then the other past it at its goal; the slave
    goes first where the master cannot."""
    arms = {arm.name: arm for arm in scene.arms if isinstance(arm, Posed)}
    begins, checks = {"master": arms["master"].start, "slave": start}, 0
    for first, second in (("master", "slave"), ("slave", "master")):
        waiting = scene.replaying(second, _at_rest(begins[second]))
        one = plan_rrt_connect(waiting, begins[first], arms[first].goal, seed, CHECKS // 2)
        checks += one.checks
        if one.path is None:
            continue
        parked = scene.replaying(first, _at_rest(arms[first].goal))
        left = CHECKS // 2 - one.checks
        two = plan_rrt_connect(parked, begins[second], arms[second].goal, seed, left)
        checks += two.checks
        if two.path is not None:
            later = len(one.path) - 1 + np.arange(len(two.path), dtype=float)
            paths = {first: JointPath(one.path), second: JointPath(two.path, later)}
            return paths, scene, checks
    return None, scene, checks


def _both(
    scene: Scene, start: np.ndarray, seed: int
) -> tuple[dict[str, JointPath] | None, Scene, int]:
    """Both arms at once, in the product of their joint spaces."""
    master, slave = (arm for arm in scene.arms if isinstance(arm, Posed))
    ends = np.concatenate([master.start, start]), np.concatenate([master.goal, slave.goal])
    found: SampledPlan = plan_rrt_connect(scene, *ends, seed, CHECKS)
    if found.path is None:
        return None, scene, found.checks
    paths = {name: JointPath(found.path[:, part]) for name, part in scene.columns.items()}
    return paths, scene, found.checks


def _at_rest(q: np.ndarray) -> JointPath:
    return JointPath(np.array([q, q]))


def _columns(
    name: str, paths: dict[str, JointPath] | None, scene: Scene, effort: int
) -> dict[str, Any]:
    """Whether it arrives, its certified clearance [m], tool paths of both arms [m], its effort."""
    row: dict[str, Any] = {f"{name}_arrives": paths is not None, f"{name}_effort": effort}
    if paths is None:
        return row
    bracket = certified_clearance(scene, paths, _TOLERANCE)
    arms: dict[str, PlacedArm] = {arm.name: arm for arm in scene.arms}
    row |= {f"{name}_clearance": bracket.lower, f"{name}_free": bracket.lower > 0.0}
    ways = []
    for arm, path in paths.items():
        times = np.linspace(path.index[0], path.index[-1], 400)
        points = end_effector(arms[arm], path.at(times))
        ways.append(float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum()))
    return row | {f"{name}_tool_path": sum(ways)}


def _cells() -> list[dict[str, Any]]:
    spread = {"trial_perturbation": assumption("trial_perturbation")}
    return [
        {"spheres": count, "scene": k, **spread} for count, of in SCENES.items() for k in range(of)
    ]


PLANNERS = REGISTRY.keeps(
    Study(
        name="xue_planners",
        title="The same scene, and with several obstacles, by four planners, judged by whole links",
        cells=_cells,
        compute=planners_cell,
        compared=DESCENTS,
        peers={PACKAGE: "rrt_"},
        seed=20200350,
        settings=Chosen(
            "xue",
            (*CASE, "trial_perturbation", "upper_arm"),
            scenes=SCENES,
            radius=RADIUS,
            near=NEAR,
            free=FREE,
            checks=CHECKS,
        ),
    )
)
