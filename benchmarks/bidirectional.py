"""Times of the search from both ends: one master, master and slave, and a peer."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from importlib.util import find_spec

import numpy as np
from timing import OURS, Row, timed

from dualarm_repro.papers.qiu.document import PRINTED, placed, repelling, truth_scene
from dualarm_repro.papers.qiu.reading import Slave
from dualarm_repro.planning.search.bidirectional import plan_bidirectional
from dualarm_repro.planning.search.bidirectional_batch import plan_bidirectional_batch
from dualarm_repro.planning.search.bidirectional_compiled import plan_bidirectional_compiled
from dualarm_repro.planning.search.rrt_connect import plan_rrt_connect
from dualarm_repro.planning.search.time_map import hull_tracks

_BATCH = 64
TASK, WEAK = "search of one master", "the same with a weaker repulsion"
BOTH = "master, its hull, and the slave around it"


def measure() -> Iterator[Row]:
    """Rows of this suite; a peer that is not installed is left out."""
    reading, slave, start = Slave.nominal(), placed("slave"), PRINTED.start
    master, goals = reading.arm(), (reading.posture(), reading.slave_posture())
    chosen, weak = reading.settings(), Slave.nominal(gain_ratio=1e-3).settings()

    def alone(planner: Callable[..., object] = plan_bidirectional_compiled, how: object = chosen):
        return planner(master, start, goals[0], repelling(), how)

    def both() -> object:
        path, spread = reading.smooth(alone().path), round(reading.schedule_steps)
        hulls = hull_tracks(master, path, reading.circles(), spread)
        return plan_bidirectional_compiled(slave, start, goals[1], repelling(), chosen, hulls)

    yield timed(TASK, OURS, alone, 1)
    yield timed(TASK, f"{OURS}, readable", lambda: alone(plan_bidirectional), 1)
    many = [np.tile(end, (_BATCH, 1)) for end in (start, goals[0])]
    batch = partial(plan_bidirectional_batch, master, *many, repelling(), chosen)
    yield timed(TASK, f"{OURS}, batch of {_BATCH}", batch, _BATCH)
    yield timed(TASK, f"{OURS}, batch in two threads", partial(batch, jobs=2), _BATCH)
    yield timed(WEAK, OURS, lambda: alone(how=weak), 1)
    yield timed(BOTH, OURS, both, 1)
    if find_spec("ompl"):
        scene, seeds = truth_scene([master]), iter(np.arange(10_000))
        yield timed(
            TASK,
            "RRT-Connect of OMPL, whole links",
            lambda: plan_rrt_connect(scene, start, goals[0], int(next(seeds))),
            1,
        )
