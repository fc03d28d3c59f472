"""Slave and master plans around the window of `xue`, compiled, in a batch and readable."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from equal_work import reference, same
from timing import OURS, Row, timed

from dualarm_repro.papers import load
from dualarm_repro.papers.xue.document import assumption, placed_master, placed_slave
from dualarm_repro.papers.xue.motions import slave_obstacles, window_obstacles
from dualarm_repro.papers.xue.outcomes import VARIANTS, starts
from dualarm_repro.papers.xue.reading import improved, nominal
from dualarm_repro.planning import plan_apf, plan_apf_compiled, plan_batch

_RUNS = 50
_SAME = 1e-8  # [rad]


def measure() -> Iterator[Row]:
    """Time per plan, the checks of the problem included."""
    load()
    case = nominal()
    slave, master = placed_slave(case.layout), placed_master(case.layout)
    obstacles, window = slave_obstacles(case), window_obstacles(case.layout)
    settings = improved(case.planner, case.layout.window_centre, slave.goal)
    begin = starts(case, assumption("trial_perturbation"), _RUNS, np.random.default_rng(0))
    task, problem = "slave plan, improved", (slave.goal, obstacles, settings)

    def compiled() -> np.ndarray:
        return plan_apf_compiled(slave, slave.start, *problem).path

    def readable() -> np.ndarray:
        return plan_apf(slave, slave.start, *problem).path

    def batch() -> np.ndarray:
        return plan_batch(slave, begin, *problem).last

    def one_by_one() -> list[np.ndarray]:
        return [plan_apf_compiled(slave, q, *problem).path[-1] for q in begin]

    yield timed(task, OURS, compiled, 1, check=reference())
    yield timed(task, "readable", readable, 1, check=same(compiled, readable, _SAME))
    yield timed(task, "batch of 50 starts", batch, _RUNS, check=same(one_by_one, batch, _SAME))
    trapped = VARIANTS["traditional"].settings(case)
    yield timed(
        "slave plan, traditional",
        OURS,
        lambda: plan_batch(slave, begin, slave.goal, obstacles, trapped),
        _RUNS,
    )
    alone = improved(case.planner, case.layout.window_centre, master.goal)
    yield timed(
        "master plan, improved",
        OURS,
        lambda: plan_apf_compiled(master, master.start, master.goal, window, alone),
        1,
    )
