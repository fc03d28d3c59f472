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
SECONDS, LEAST = 1.0, 8  # of one worker, and cells
LONGEST = 2.0  # [s] after which the cells that are drawn must do, however few
SMALLEST = 0.1  # [s] of a study, below which there is nothing to share
CHUNKS = 64  # as many as a study hands out
ROUNDS = 2  # of calls that take long
MEMORY = False  # of the workers is not seen here


def series() -> list[Series]:
    """One series a study whose peers are here, over as many of its cells, drawn with a seed, as
    take one worker about a second. Where these are few, since each is dear, every one is computed
    twice, so that they can be shared evenly. The workers have started before."""
    sizes = tuple(n for n in (1, 2, 4, 8) if n <= (os.cpu_count() or 1))
    studies = [study for study in load().studies.values() if not study.missing_peers()]
    studies = [study for study in studies if sum(_drawn(study.name).values()) > SMALLEST]
    return [
        Series(study.name, lambda n, study=study: _by(n, study), sizes, rounds=ROUNDS)
        for study in studies
    ]


def _by(workers: int, study: Study) -> Callable[[], object]:
    cells, spent = study.cells(), _drawn(study.name)
    chosen = sorted(spent, key=lambda k: -spent[k])  # the longest first, as in any fair share
    if len(chosen) < LEAST:
        chosen = np.repeat(chosen, 2).tolist()
    parts = [part.tolist() for part in np.array_split(chosen, min(CHUNKS, len(chosen)))]

    def run() -> list[object]:
        tasks = ((_computed, study, [(k, cells[k]) for k in part]) for part in parts)
        return list(results(tasks, len(parts), study.name, workers))

    return run


def _computed(study: Study, numbered: list[tuple[int, dict[str, object]]]) -> list[object]:
    return [study.cell(k, cell) for k, cell in numbered]


@cache
def _drawn(name: str) -> dict[int, float]:
    """Cells of a study that are computed, the same for any number of workers, by their number, and
    the seconds that each takes."""
    study = load().studies[name]
    cells = study.cells()
    order = np.random.default_rng(0).permutation(len(cells)).tolist()
    study.cell(order[0], cells[order[0]])  # compiles
    spent: dict[int, float] = {}
    for k in order:
        begun = perf_counter()
        study.cell(k, cells[k])
        spent[k] = perf_counter() - begun
        if sum(spent.values()) > (SECONDS if len(spent) >= LEAST else LONGEST):
            break
    return spent
