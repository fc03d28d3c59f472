"""Cold processes: import, help, listing and a plan, until they have ended."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable, Iterator, Mapping
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory

from timing import OURS, Row, timed

from dualarm_repro.cache_folder import CACHE_VARIABLE
from dualarm_repro.datafiles import data_path

IMPORT, HELP, LIST = "import", "dualarm --help", "dualarm list"
PLAN, FIRST = "dualarm plan, two arms", "dualarm plan, two arms, first ever"
METHOD = "apf-bidirectional"
ROUNDS = 5
ROOT = Path(__file__).resolve().parents[1]


def measure() -> Iterator[Row]:
    """Rows of this suite: each call is a process of its own, and its CPU time counts."""
    yield _row(IMPORT, OURS, ["-c", "import dualarm_repro"])
    yield _row(IMPORT, "Python alone", ["-c", "pass"])
    for module in ("pinocchio", "roboticstoolbox", "pink", "mink"):
        if find_spec(module):
            yield _row(IMPORT, module, ["-c", f"import {module}"])
    yield _row(HELP, OURS, ["-m", "dualarm_repro.cli", "--help"])
    yield _row(LIST, OURS, ["-m", "dualarm_repro.cli", "list"])
    yield timed(PLAN, OURS, _planning(), 1, rounds=ROUNDS)
    yield timed(FIRST, OURS, _planning(nothing_kept=True), 1, rounds=1)


def _row(task: str, name: str, arguments: list[str]) -> Row:
    return timed(task, name, lambda: cold(arguments), 1, rounds=ROUNDS)


def _planning(nothing_kept: bool = False) -> Callable[[], None]:
    """A plan in a cold process, its files in a folder that is removed."""
    tasks = str(data_path("scenes", "example_tasks.yaml"))

    def plan() -> None:
        with TemporaryDirectory() as folder:
            kept = {CACHE_VARIABLE: f"{folder}/cache"} if nothing_kept else {}
            command = ["-m", "dualarm_repro.cli", "plan", tasks, "--method", METHOD]
            cold([*command, "--out", f"{folder}/out"], kept)

    return plan


def cold(arguments: list[str], changed: Mapping[str, str] | None = None) -> None:
    """Run Python with these arguments until it has ended.

    Raises
    ------
    RuntimeError
        It did not end with exit code 0; the last line of what it said is told.
    """
    path = os.pathsep.join([str(ROOT), os.environ.get("PYTHONPATH", "")]).rstrip(os.pathsep)
    environment = {**os.environ, "PYTHONPATH": path, **(changed or {})}
    environment.pop("PYTHONDONTWRITEBYTECODE", None)  # nobody compiles every library every time
    made = subprocess.run(
        [sys.executable, *arguments], capture_output=True, text=True, env=environment
    )
    if made.returncode:
        said = made.stderr.strip().splitlines()[-1:] or ["nothing said"]
        raise RuntimeError(f"{' '.join(arguments)}: exit code {made.returncode}, {said[0]}")
