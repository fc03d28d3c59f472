"""Cells of each stored study by one worker process and by two."""

from __future__ import annotations

import os
from collections.abc import Callable
from functools import cache
from time import perf_counter

import numpy as np
from growth import Series

from dualarm_repro.ledger.study import Study
from dualarm_repro.ledger.workers import results
from dualarm_repro.papers import load

TITLE, X = "cells of a stored study", "worker processes"
SECONDS = 1.0  # of one worker
CHUNKS = 64  # as many as a study hands out
ROUNDS = 3
MEMORY = False  # of the workers is not seen here


def series() -> list[Series]:
    """One series a study whose peers are here, over as many of its cells, drawn with a seed, as
    take one worker about a second. The workers have started before."""
    sizes = tuple(n for n in (1, 2, 4, 8) if n <= (os.cpu_count() or 1))
    studies = [study for study in load().studies.values() if not study.missing_peers()]
    return [
        Series(study.name, lambda n, study=study: _by(n, study), sizes, rounds=ROUNDS)
        for study in studies
    ]


def _by(workers: int, study: Study) -> Callable[[], object]:
    cells, chosen = study.cells(), _drawn(study.name)
    parts = [part.tolist() for part in np.array_split(chosen, min(CHUNKS, len(chosen)))]

    def run() -> list[object]:
        tasks = ((_computed, study, [(k, cells[k]) for k in part]) for part in parts)
        return list(results(tasks, len(parts), study.name, workers))

    return run


def _computed(study: Study, numbered: list[tuple[int, dict[str, object]]]) -> list[object]:
    return [study.cell(k, cell) for k, cell in numbered]


@cache
def _drawn(name: str) -> list[int]:
    """Numbers of the cells of a study that are computed, the same for any number of workers."""
    study = load().studies[name]
    cells = study.cells()
    order = np.random.default_rng(0).permutation(len(cells)).tolist()
    study.cell(order[0], cells[order[0]])  # compiles
    chosen, begun = [], perf_counter()
    for k in order:
        study.cell(k, cells[k])
        chosen.append(k)
        if perf_counter() - begun > SECONDS:
            break
    return chosen
