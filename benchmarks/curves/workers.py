"""Cells of each stored study by one worker process and by two."""

from __future__ import annotations

import os
from collections.abc import Callable
from functools import cache
from itertools import count
from time import perf_counter

import numpy as np
from growth import Series

from dualarm_repro.ledger.study import Study
from dualarm_repro.ledger.workers import results
from dualarm_repro.papers import load

TITLE, X = "cells of a stored study", "worker processes"
SECONDS, LONGEST = 2.0, 3.0  # that the cells of a call take one worker, and at most
EVEN = 8  # times the dearest cell: what is less cannot be shared evenly
SMALLEST = 0.1  # [s] of a study, below which there is nothing to share
CHUNKS = 64  # as many as a study hands out
ROUNDS = 2  # of calls that take long
MEMORY = False  # of the workers is not seen here


def series() -> list[Series]:
    """One series a study whose peers are here, over as many of its cells as take one worker some
    seconds. The workers have started before."""
    sizes = tuple(n for n in (1, 2, 4, 8) if n <= (os.cpu_count() or 1))
    studies = [study for study in load().studies.values() if not study.missing_peers()]
    studies = [study for study in studies if sum(_drawn(study.name)[1]) > SMALLEST]
    return [
        Series(study.name, lambda n, study=study: _by(n, study), sizes, rounds=ROUNDS)
        for study in studies
    ]


def _by(workers: int, study: Study) -> Callable[[], object]:
    cells, calls = study.cells(), count()

    def run() -> list[object]:
        chosen = _chosen(study.name, next(calls))
        parts = [part.tolist() for part in np.array_split(chosen, min(CHUNKS, len(chosen)))]
        tasks = ((_computed, study, [(k, cells[k]) for k in part]) for part in parts)
        return list(results(tasks, len(parts), study.name, workers))

    return run


def _computed(study: Study, numbered: list[tuple[int, dict[str, object]]]) -> list[object]:
    return [study.cell(k, cell) for k, cell in numbered]


def _chosen(name: str, call: int) -> list[int]:
    """Cells of a call, the same for any number of workers. Each call has cells of its own, since a
    process may remember what it has computed; where a few take so long that they cannot be shared
    evenly, every call has these, the dearest first and each twice."""
    order, spent = _drawn(name)
    drawn = len(spent)
    if sum(spent) < EVEN * max(spent):
        dearest = np.argsort(spent)[::-1]
        return [order[k] for k in np.repeat(dearest, 2).tolist()]
    return [order[((call + 1) * drawn + k) % len(order)] for k in range(drawn)]


@cache
def _drawn(name: str) -> tuple[list[int], list[float]]:
    """Numbers of all cells of a study in an order drawn with a seed, and the seconds of the first
    of them, as many as a call computes."""
    study = load().studies[name]
    cells = study.cells()
    order = np.random.default_rng(0).permutation(len(cells)).tolist()
    study.cell(order[0], cells[order[0]])  # compiles
    spent: list[float] = []
    for k in order:
        begun = perf_counter()
        study.cell(k, cells[k])
        spent.append(perf_counter() - begun)
        total = sum(spent)
        if total > LONGEST or (total > SECONDS and total >= EVEN * max(spent)):
            break
    return order, spent
