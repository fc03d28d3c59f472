"""The search from both ends of `qiu`: one master, master and slave, and RRT-Connect of OMPL.

OMPL looks at the whole links among the same obstacles by ``pin.computeCollisions``, every 0.02 rad,
and its path is simplified; ours must be free by the same checks and not longer.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from importlib.util import find_spec
from itertools import cycle

import numpy as np
from equal_work import DifferentWork, holds, reference, same
from ompl_paths import ompl_path
from pinocchio_checks import checker, free_path, length
from timing import OURS, Row, timed

from dualarm_repro.papers.qiu.document import PRINTED, placed
from dualarm_repro.papers.qiu.reading import Slave
from dualarm_repro.planning.search.bidirectional import plan_bidirectional
from dualarm_repro.planning.search.bidirectional_batch import plan_bidirectional_batch
from dualarm_repro.planning.search.bidirectional_compiled import plan_bidirectional_compiled
from dualarm_repro.planning.search.dual_search import DualSearch, search_around
from dualarm_repro.planning.search.search_plan import SearchPlan
from dualarm_repro.scene import Scene

_BATCH, _SEEDS = 64, 5
#: The reading whose motion of both arms is free and keeps the largest distance.
FREE = {
    "goal_branch": "front_deep",
    "control_points": "four_with_link_radii",
    "adaptive_step": "lengthened",
    "floor": "at_bases",
    "gain_ratio": 1e-3,
}
_MEETS = 1e-4  # the ends of a path, which its smoothing shifts a little [rad]
TASK, WEAK = "search of one master", "the same with a weaker repulsion"
BOTH = "master, its hull, and the slave around it"
OMPL = "RRT-Connect of OMPL, whole links, simplified"


def measure() -> Iterator[Row]:
    """Rows of this suite; a peer that is not installed is left out."""
    yield from _one_master()
    yield from _both_arms()


def _one_master() -> Iterator[Row]:
    reading, start = Slave.nominal(), PRINTED.start
    master, goal, around = reading.arm(), reading.posture(), reading.obstacles()
    chosen, weak = reading.settings(), Slave.nominal(gain_ratio=1e-3).settings()

    def alone(
        planner: Callable[..., SearchPlan] = plan_bidirectional_compiled, how: object = chosen
    ) -> np.ndarray:
        return planner(master, start, goal, around, how).path

    readable = partial(alone, plan_bidirectional)
    many = [np.tile(end, (_BATCH, 1)) for end in (start, goal)]
    batch = partial(plan_bidirectional_batch, master, *many, around, chosen)

    def same_paths(jobs: int) -> Callable[[], str]:
        paths = lambda: [plan.path for plan in batch(jobs=jobs)]  # noqa: E731
        return same(lambda: [alone()] * _BATCH, paths, 1e-9)

    scene, ends = reading.truth(), (start, goal)
    yield timed(TASK, OURS, alone, 1, check=_free(scene, alone, ends))
    yield timed(TASK, f"{OURS}, readable", readable, 1, check=same(alone, readable, 1e-9))
    yield timed(TASK, f"{OURS}, batch of {_BATCH}", batch, _BATCH, check=same_paths(1))
    yield timed(
        *(TASK, f"{OURS}, batch in two threads", partial(batch, jobs=2), _BATCH),
        check=same_paths(2),
        threads=2,
    )
    yield from _ompl(TASK, scene, alone, ends)
    yield timed(WEAK, OURS, partial(alone, how=weak), 1, check=reference())


def _both_arms() -> Iterator[Row]:
    """By the reading whose motion of whole links is free; ours until both can be executed."""
    reading, slave, start = Slave.nominal(**FREE), placed("slave"), PRINTED.start
    master, goals = reading.arm(), (reading.posture(), reading.slave_posture())
    chosen, other = reading.settings(), reading.settings(goal=goals[1])
    around, beside = reading.obstacles(), reading.obstacles(reading.slave_obstacles != "master")
    circles, spread = reading.circles(), round(reading.schedule_steps)
    scene = reading.scene()

    def both() -> DualSearch:
        first = plan_bidirectional_compiled(master, start, goals[0], around, chosen)
        return search_around(
            *(first, slave, (start, goals[1]), beside, other),
            *(circles, spread, reading.smooth_inside),
        )

    def motion() -> np.ndarray:
        return both().stacked(scene)

    names = scene.columns
    ends = [scene.stack(**dict(zip(names, each, strict=True))) for each in ((start,) * 2, goals)]
    yield timed(BOTH, OURS, motion, 1, check=_free(scene, motion, ends))
    yield from _ompl(BOTH, scene, motion, ends)


def _free(scene: Scene, path: Callable[[], np.ndarray], ends: object) -> Callable[[], str]:
    """From the start to the goal, with whole links free every 0.02 rad."""

    def good() -> bool:
        found = path()
        meets = np.abs(found[[0, -1]] - np.asarray(ends)).max() < _MEETS
        return bool(meets) and free_path(checker(scene), found)

    return holds("from start to goal and free with whole links", good)


def _ompl(task: str, scene: Scene, ours: Callable[[], np.ndarray], ends: object) -> Iterator[Row]:
    if not find_spec("ompl"):
        return
    seeds, free = cycle(range(_SEEDS)), checker(scene)

    def path(seed: int) -> np.ndarray | None:
        return ompl_path(scene.limits, *ends, free, seed)

    def check() -> str:
        found = [path(seed) for seed in range(_SEEDS)]
        if any(one is None or not free_path(free, one) for one in found):
            raise DifferentWork("a path of OMPL is missing or not free")
        ratio = length(ours()) / float(np.mean([length(one) for one in found]))
        if ratio > 1.0:
            raise DifferentWork(f"our path is {ratio:.2f} times as long")
        return f"free, ours {ratio:.2f} times as long"

    yield timed(task, OMPL, lambda: path(next(seeds)), 1, check=check)
