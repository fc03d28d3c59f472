"""Times of the search from both ends: one master, master and slave, and peers, in one run.

``python benchmarks/bidirectional.py [--json]``. Ratios of one run are what counts.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable
from importlib.util import find_spec
from statistics import median
from time import perf_counter

import numpy as np

from dualarm_repro.papers import load
from dualarm_repro.papers.qiu.readings import (
    IMPROVED,
    IMPROVED_VARIANT,
    circles,
    master_arm,
    master_posture,
    reconstructed,
    settings,
    slave_posture,
)
from dualarm_repro.papers.qiu.scenario import START, placed, repelling, truth_scene
from dualarm_repro.planning.bidirectional import plan_bidirectional
from dualarm_repro.planning.bidirectional_compiled import plan_bidirectional_compiled
from dualarm_repro.planning.rrt_connect import plan_rrt_connect
from dualarm_repro.planning.splice import smoothed
from dualarm_repro.planning.time_map import hull_tracks


def clock(function: Callable[[], object], repeats: int) -> float:
    """Median time of a call [ms], after one call that is not counted."""
    function()
    times = []
    for _ in range(repeats):
        began = perf_counter()
        function()
        times.append(1e3 * (perf_counter() - began))
    return median(times)


def measure() -> dict[str, float]:
    """Milliseconds by name."""
    entries = load().papers["qiu"].assumptions.items()
    values = {key: entry.value for key, entry in entries}
    master, slave = master_arm(values), placed("slave")
    goals, chosen = (
        (master_posture(values), slave_posture(values)),
        settings(values, IMPROVED_VARIANT),
    )
    rebuilt = settings(reconstructed(values, IMPROVED), IMPROVED_VARIANT)

    def alone(planner: Callable[..., object] = plan_bidirectional_compiled, how: object = chosen):
        return planner(master, START, goals[0], repelling(), how)

    def both() -> object:
        path = smoothed(alone().path, 1.0, 1e4)
        hulls = hull_tracks(master, path, circles(values), 31)
        return plan_bidirectional_compiled(slave, START, goals[1], repelling(True), chosen, hulls)

    times = {
        "master, compiled": clock(alone, 200),
        "master, compiled, reconstruction": clock(lambda: alone(how=rebuilt), 200),
        "master, readable": clock(lambda: alone(plan_bidirectional), 5),
        "master and slave, compiled": clock(both, 20),
    }
    if find_spec("ompl"):
        scene = truth_scene([master])
        seeds = iter(np.arange(10_000))
        times["master, RRT-Connect (OMPL)"] = clock(
            lambda: plan_rrt_connect(scene, START, goals[0], int(next(seeds))), 30
        )
    return times


def main() -> None:
    """Print the times and their ratio to the compiled master."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--json", action="store_true")
    times = measure()
    if parser.parse_args().json:
        print(json.dumps(times, indent=2))
        return
    for name, value in times.items():
        print(f"{name:34s} {value:9.3f} ms   x {value / times['master, compiled']:.1f}")


if __name__ == "__main__":
    main()
