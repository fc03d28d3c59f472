"""Cells of each stored study by one worker process and by two."""

from __future__ import annotations

import os
from collections.abc import Callable
from time import perf_counter

import numpy as np
from growth import Series

from dualarm_repro.ledger.study import Study
from dualarm_repro.ledger.workers import results
from dualarm_repro.papers import load

TITLE, X = "cells of a stored study", "worker processes"
SECONDS, MOST = 3.0, 400  # of one worker, and cells
ROUNDS = 3
MEMORY = False  # of the workers is not seen here


def series() -> list[Series]:
    """One series a study whose peers are here, over as many of its cells, drawn with a seed, as
    take one worker a few seconds. Workers are started before."""
    sizes = tuple(n for n in (1, 2, 4, 8) if n <= (os.cpu_count() or 1))
    studies = [study for study in load().studies.values() if not study.missing_peers()]
    return [
        Series(study.name, lambda n, study=study: _sampled(study, n), sizes, rounds=ROUNDS)
        for study in studies
    ]


def _sampled(study: Study, workers: int) -> Callable[[], object]:
    cells = study.cells()
    order = np.random.default_rng(0).permutation(len(cells))[:MOST].tolist()
    study.cell(order[0], cells[order[0]])  # compiles
    chosen, begun = [], perf_counter()
    for k in order:
        study.cell(k, cells[k])
        chosen.append(k)
        if perf_counter() - begun > SECONDS:
            break

    def run() -> list[object]:
        tasks = ((_cell, study, (k, cells[k])) for k in chosen)
        return list(results(tasks, len(chosen), study.name, workers))

    return run


def _cell(study: Study, numbered: tuple[int, dict[str, object]]) -> object:
    return study.cell(*numbered)
