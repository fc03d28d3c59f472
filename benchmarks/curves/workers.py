"""Each stored study by one worker process and by two.

What is told is what a user waits for: ``dualarm study NAME --jobs 2`` beside ``--jobs 1``. Some
studies take a quarter of an hour, so a sample is measured and scaled to the whole: parts as a study
hands them out, one after the other to whoever is free, drawn with a seed and the same for any
number of workers. No process computes a part twice, since it may remember what it has computed.

A study is done when its last part is. That is one of many, and one of a few in a sample, which thus
ends more unevenly than the study; so the dearest parts of a sample are handed out first. Where the
sample is the whole study, its parts come in the order in which the study hands them out.

What slows a processor for a while slows one worker or two: samples that take seconds are measured
by turns, in other processes each, and the medians told.

The start of the workers is paid once a study and is told apart, not scaled. CPU time is that of all
processes: two workers that take more of it than one do some work twice.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter, process_time, sleep, time
from typing import Any

import numpy as np
from timing import Spread

from dualarm_repro.ledger.study import Study, parts
from dualarm_repro.ledger.workers import results
from dualarm_repro.papers import load
from dualarm_repro.tracking import forget

BENCHMARKS, ROOT = Path(__file__).resolve().parents[1:3]
TITLE, X = "a stored study", "worker processes"
SECONDS, LONGEST = 4.0, 100.0  # that the parts of a sample take one worker, and at most
SHORT, TURNS = 15.0, 3  # samples below are measured so often
EVEN = 8  # times the dearest part: what is less cannot be shared evenly
PATIENCE = 120.0  # [s] until all workers have begun
SMALLEST = 0.1  # [s] of a study, below which there is nothing to share
MEMORY = False  # of the workers is not seen here
Part = list[tuple[int, dict[str, Any]]]  # numbers and settings of cells


def times() -> dict[str, object]:
    """The curve, one series a study whose peers are here.

    Every number of workers is tried in a process of its own, since one that has computed a cell
    may remember what others share with it, and workers that are begun anew do not.
    """
    sizes = [n for n in (1, 2, 4, 8) if n <= (os.cpu_count() or 1)]
    made = []
    for name, study in load().studies.items():
        first = {} if study.missing_peers() else _in_a_process("sampled", name)
        costs = first.get("costs", [])
        if sum(costs) <= SMALLEST:
            continue
        turns = {n: [] if n > 1 else [first] for n in sizes}
        for turn in range(TURNS if sum(costs) < SHORT else 1):
            for n in sizes[:: -1 if turn % 2 else 1]:
                if (turn, n) != (0, 1):  # which was the sampling
                    turns[n].append(_in_a_process("waited", name, n, costs))
        points = [{"x": n, **medians(turns[n])} for n in sizes]
        made.append({"name": name, "limit": False, "points": points})
    return {"title": TITLE, "x": X, "series": made}


def medians(turns: Sequence[dict[str, Any]]) -> dict[str, object]:
    """Of what was measured by turns, with the quartiles of the wall time."""
    keys = ("seconds", "cpu_seconds", "start_seconds")
    spread = {key: Spread.of([one[key] for one in turns]) for key in keys}
    wall = spread["seconds"]
    return {key: spread[key].median for key in keys} | {"quartiles": [wall.low, wall.high]}


def sampled(name: str) -> dict[str, object]:
    """By one worker: the parts of a study in the order of :func:`drawn_parts`, enough of them to be
    shared evenly; their seconds, and all that :func:`waited` gives."""
    study = load().studies[name]
    order = drawn_parts(study)
    started = warmed(study, order[0], 1)
    costs: list[float] = []
    cells, used = 0, process_time()
    for part in order:
        begun = perf_counter()
        _computed(study, part)
        costs.append(perf_counter() - begun)
        cells += len(part)
        total = sum(costs)
        if total > LONGEST or (total > SECONDS and total >= EVEN * max(costs)):
            break
    return {"costs": costs, **_scaled(study, cells, sum(costs), process_time() - used, started)}


def waited(name: str, workers: int, costs: Sequence[float]) -> dict[str, object]:
    """Wall and CPU seconds of a study by so many workers that have started and loaded its code, and
    the seconds until they had started."""
    study = load().studies[name]
    order = drawn_parts(study)
    started = warmed(study, order[0], workers)
    sample = handed_out(study, order, costs)
    tasks = ((_computed, study, part) for part in sample)
    begun, used = perf_counter(), process_time()
    spent = list(results(tasks, len(sample), name, workers))
    taken, used = perf_counter() - begun, process_time() - used
    # One worker is this process itself.
    cpu = used + (sum(spent) if workers > 1 else 0.0)
    return _scaled(study, sum(map(len, sample)), taken, cpu, started)


def _scaled(
    study: Study, cells: int, seconds: float, cpu: float, started: float
) -> dict[str, object]:
    """What so many cells took, scaled to the whole study."""
    scale = len(study.cells()) / cells
    return {"seconds": scale * seconds, "cpu_seconds": scale * cpu, "start_seconds": started}


def warmed(study: Study, part: Part, workers: int) -> float:
    """Seconds until each worker has begun this part, which it forgets again.

    A worker collects garbage once after its first task, which is part of its start: two tasks.
    """
    called = time()
    begun = []
    for _ in range(2):
        with TemporaryDirectory() as folder:
            tasks = [(_warmed, study, (part, folder, workers))] * workers
            begun.append(max(results(tasks, workers, study.name, workers)))
    return begun[0] - called


def handed_out(study: Study, order: Sequence[Part], costs: Sequence[float]) -> list[Part]:
    """The parts of a sample in the order in which workers get them."""
    if len(costs) == len(order):
        every = sorted(order, key=lambda part: part[0][0])
        return [every[k] for k in study.handed_out(parts(len(study.cells())))]
    return [order[k] for k in np.argsort(costs)[::-1].tolist()]


def drawn_parts(study: Study) -> list[Part]:
    """All parts of a study, in an order drawn with a seed."""
    cells = study.cells()
    every = [[(k, cells[k]) for k in numbers.tolist()] for numbers in parts(len(cells))]
    return [every[k] for k in np.random.default_rng(0).permutation(len(every)).tolist()]


def _computed(study: Study, part: Part) -> float:
    """CPU seconds of a part."""
    begun = process_time()
    for number, settings in part:
        study.cell(number, settings)
    return process_time() - begun


def _warmed(study: Study, shared: tuple[Part, str, int]) -> float:
    """When it began: the worker loads the code of a study, and waits for the others, so that none
    gets the part of another."""
    begun, (part, folder, workers) = time(), shared
    Path(folder, str(os.getpid())).touch()
    _computed(study, part)
    forget()
    while len(os.listdir(folder)) < workers:
        if time() > begun + PATIENCE:
            raise RuntimeError(f"{workers} workers did not begin within {PATIENCE:g} s")
        sleep(0.01)
    return begun


def _in_a_process(*asked: object) -> Any:
    command = [sys.executable, __file__, *map(json.dumps, asked)]
    path = os.pathsep.join(filter(None, [str(ROOT), str(BENCHMARKS), os.environ.get("PYTHONPATH")]))
    made = subprocess.run(
        command, stdout=subprocess.PIPE, text=True, env={**os.environ, "PYTHONPATH": path}
    )
    if made.returncode:
        raise RuntimeError(f"workers, {asked[1]}: exit code {made.returncode}")
    return json.loads(made.stdout.splitlines()[-1])


if __name__ == "__main__":
    call, *arguments = map(json.loads, sys.argv[1:])
    calls: dict[str, Callable[..., object]] = {"sampled": sampled, "waited": waited}
    print(json.dumps(calls[call](*arguments)))
