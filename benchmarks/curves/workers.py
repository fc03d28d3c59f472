"""Cells of each stored study by one worker process and by two."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from time import perf_counter, sleep

import numpy as np

from dualarm_repro.ledger.study import Study
from dualarm_repro.ledger.workers import results
from dualarm_repro.papers import load

ROOT = Path(__file__).resolve().parents[2]
TITLE, X = "cells of a stored study", "worker processes"
SECONDS, LONGEST = 3.0, 8.0  # that the cells of a call take one worker, and at most
EVEN = 8  # times the dearest cell: what is less cannot be shared evenly
SMALLEST = 0.1  # [s] of a study, below which there is nothing to share
CHUNKS = 64  # as many as a study hands out
MEMORY = False  # of the workers is not seen here


def times() -> dict[str, object]:
    """The curve, one series a study whose peers are here.

    Every number of workers is tried in a process of its own, since one that has computed a cell
    may remember what others share with it, and workers that are begun anew do not.
    """
    sizes = [n for n in (1, 2, 4, 8) if n <= (os.cpu_count() or 1)]
    made = []
    for name, study in load().studies.items():
        spent = [] if study.missing_peers() else _in_a_process("drawn", name)
        if sum(spent) > SMALLEST:
            points = [{"x": n, **_in_a_process("spent", name, n, spent)} for n in sizes]
            made.append({"name": name, "limit": False, "points": points})
    return {"title": TITLE, "x": X, "series": made}


def drawn(name: str) -> list[float]:
    """Seconds of as many cells of a study, in an order drawn with a seed, as a call computes."""
    study = load().studies[name]
    cells, order = study.cells(), order_of(study)
    study.cell(order[0], cells[order[0]])  # compiles
    spent: list[float] = []
    for k in order:
        begun = perf_counter()
        study.cell(k, cells[k])
        spent.append(perf_counter() - begun)
        total = sum(spent)
        if total > LONGEST or (total > SECONDS and total >= EVEN * max(spent)):
            break
    return spent


def spent(name: str, workers: int, drawn: Sequence[float]) -> dict[str, object]:
    """Seconds of a call by so many workers, who have started and computed another cell each."""
    study = load().studies[name]
    order = order_of(study)
    warm = [(_warmed, study, order[0])] * workers
    list(results(warm, workers, name, workers))
    parts = chunks(chosen(order, drawn))
    tasks = ((_computed, study, part) for part in parts)
    begun = perf_counter()
    list(results(tasks, len(parts), name, workers))
    taken = perf_counter() - begun
    # Once, since what is computed again is remembered; and the CPU time is that of the workers.
    return {"seconds": taken, "quartiles": [taken, taken], "cpu_seconds": taken}


def chosen(order: Sequence[int], drawn: Sequence[float]) -> list[int]:
    """Cells of a call, the same for any number of workers; where a few take so long that they
    cannot be shared evenly, these, the dearest first and each twice."""
    if sum(drawn) < EVEN * max(drawn):
        dearest = np.argsort(drawn)[::-1]
        return [order[k] for k in np.repeat(dearest, 2).tolist()]
    return list(order[1 : len(drawn) + 1])


def chunks(cells: Sequence[int]) -> list[list[int]]:
    """Parts of the cells that are handed out, as those of a study are."""
    return [part.tolist() for part in np.array_split(cells, min(CHUNKS, len(cells)))]


def order_of(study: Study) -> list[int]:
    """Numbers of all cells of a study in an order drawn with a seed."""
    return np.random.default_rng(0).permutation(len(study.cells())).tolist()


def _computed(study: Study, numbers: list[int]) -> list[object]:
    cells = study.cells()
    return [study.cell(k, cells[k]) for k in numbers]


def _warmed(study: Study, number: int) -> None:
    _computed(study, [number])
    sleep(1.0)  # so that no worker gets the cell of another


def _in_a_process(*asked: object) -> object:
    command = [sys.executable, __file__, *map(json.dumps, asked)]
    path = os.pathsep.join(filter(None, [str(ROOT), os.environ.get("PYTHONPATH")]))
    made = subprocess.run(
        command, stdout=subprocess.PIPE, text=True, env={**os.environ, "PYTHONPATH": path}
    )
    if made.returncode:
        raise RuntimeError(f"workers, {asked[1]}: exit code {made.returncode}")
    return json.loads(made.stdout.splitlines()[-1])


if __name__ == "__main__":
    call, *arguments = map(json.loads, sys.argv[1:])
    print(json.dumps({"drawn": drawn, "spent": spent}[call](*arguments)))
