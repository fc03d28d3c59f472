"""The same batch on one thread and on several, for kernels that let go of the interpreter."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from equal_work import reference, same
from timing import OURS, Row, timed

from dualarm_repro import load_arm
from dualarm_repro.scene import FLOOR, PlacedArm, Scene, Sphere, distances

POSES, DISTANCES = "poses, in threads", "distances of a scene, in threads"
#: Parts of a batch are whole blocks of SIMD lanes: a remainder runs as other code, which may round
#: otherwise.
N, FEW, CHUNKS = 204_800, 2_048, 8


def measure() -> Iterator[Row]:
    """Rows of this suite; those of several threads need ``--threads``."""
    rng = np.random.default_rng(0)
    arm = load_arm("irb120")
    yield from _rows(POSES, arm.fk, arm.random_configurations(N, rng))
    balls = {f"ball{k}": Sphere(rng.uniform(-0.6, 0.6, 3), 0.05) for k in range(10)}
    scene = Scene([PlacedArm("arm", arm)], balls, floor=0.0, exempt=[("arm", FLOOR)])
    yield from _rows(DISTANCES, lambda q: distances(scene, q), arm.random_configurations(FEW, rng))


def _rows(task: str, call: Callable[[np.ndarray], np.ndarray], q: np.ndarray) -> Iterator[Row]:
    cores = os.cpu_count() or 1
    yield timed(task, OURS, lambda: call(q), len(q), check=reference())
    for count in range(2, cores + 1) if cores <= 4 else (2, cores):
        run = _shared(call, q, count)
        yield timed(
            *(task, f"{OURS}, {count} threads", run, len(q)),
            check=same(lambda: call(q), run, 0.0),
            threads=count,
        )


def _shared(
    call: Callable[[np.ndarray], np.ndarray], q: np.ndarray, count: int
) -> Callable[[], np.ndarray]:
    """The call by parts of the batch, in a pool that stays."""
    pool, parts = ThreadPoolExecutor(count), np.array_split(q, CHUNKS * count)
    return lambda: np.concatenate(list(pool.map(call, parts)))
