"""Mutants of the methods in a copy of the tree: what notices each, or that nothing does."""

from __future__ import annotations

import json
import os
import re
import resource
import subprocess
import sys
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from signal import SIGINT, SIGKILL, SIGTERM, SIGXCPU
from typing import Any

import yaml
from tree_copy import copy_tree

from dualarm_repro.ledger.trust.mutants import Mutant, sample

ROOT = Path(__file__).resolve().parents[1]
PACKAGE = "dualarm_repro"
TREE = (PACKAGE, "data", "tests", "tools", "pyproject.toml", "CITATION.cff")
ROOMS = tuple(
    f"{PACKAGE}/{room}" for room in ("arms", "scene", "planning", "control", "welding", "ledger")
)
SEED, PER_ROOM = 20200344, 8
#: CPU seconds that the checks of one mutant, and its tests, may take.
LIMIT, TEST_LIMIT = 240, 600
#: A process that waits so many times its CPU seconds is stuck, which is an error and no kill.
STALLED = 20
#: CPU seconds that all checks may take without a mutant.
BASE_LIMIT = 1800
#: What is computed again for a mutant: at most so many cells and items, none dearer than that.
CELLS, ITEMS, CHEAP = 6, 8, 10.0
EQUIVALENT = Path(__file__).with_name("equivalent_mutants.yaml")


def equivalents() -> list[dict[str, Any]]:
    """Mutants that change no value, each with its reason."""
    return yaml.safe_load(EQUIVALENT.read_text(encoding="utf-8")) or []


def excused(mutant: Mutant, known: Iterable[dict[str, Any]]) -> str | None:
    """Why a mutant changes no value; None where it must be noticed.

    A line that holds the token twice names the column, which counts from 0.
    """
    for entry in known:
        if all(getattr(mutant, name) == told for name, told in entry.items() if name != "reason"):
            return entry["reason"]
    return None


def killers(rows: Iterable[Mapping[str, Any]]) -> dict[tuple[Any, ...], str]:
    """What killed stored mutants, by their place in the sources and what was exchanged."""
    return {_place(row): row["killed_by"] for row in rows if row["killed_by"]}


def _place(row: Mapping[str, Any]) -> tuple[Any, ...]:
    return tuple(row[name] for name in ("file", "line", "column", "old", "new"))


class Copy:
    """A copy of package, data and tests with a cache of its own, in which sources are mutated."""

    def __init__(self, folder: Path, *, recompute: bool = True) -> None:
        self.folder = folder / "tree"
        copy_tree(ROOT, TREE, self.folder)
        self._env = os.environ | {
            "PYTHONPATH": str(self.folder),
            "DUALARM_CACHE": str(folder / "cache"),
            "PYTHONDONTWRITEBYTECODE": "1",
            "MPLBACKEND": "agg",
        }
        self._broken: dict[str, list[str]] = {}
        made = self._probe(None, None, BASE_LIMIT)[1] if recompute else []
        self.checks = [row for row in made if row["differs"] == []]

    def _probe(self, cells: Any, items: Any, limit: int) -> tuple[int, list[dict[str, Any]]]:
        asked = json.dumps({"cells": cells, "items": items, "limit": limit})
        command = [sys.executable, "tools/mutation_probe.py"]
        done = self._run(command, limit + 60, asked)
        return done.returncode, [json.loads(line) for line in done.stdout.splitlines()]

    def _run(self, command: list[str], limit: int, text: str | None = None) -> Any:
        def limited() -> None:
            resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 5))

        return subprocess.run(
            command,
            cwd=self.folder,
            env=self._env,
            input=text,
            capture_output=True,
            text=True,
            preexec_fn=limited,
            check=False,
            timeout=STALLED * limit,
        )

    def killer(self, mutant: Mutant) -> str | None:
        """What notices a mutant, stopping at the first; None if nothing does."""
        path = self.folder / mutant.file
        source = path.read_text(encoding="utf-8")
        room = mutant.file.split("/")[1]
        tests = self.tests(mutant)
        broken = self.broken(room)
        path.write_text(mutant.applied(source), encoding="utf-8")
        try:
            return self._recomputed(mutant) or self._tested(tests, broken)
        finally:
            path.write_text(source, encoding="utf-8")

    def _recomputed(self, mutant: Mutant) -> str | None:
        module = mutant.file.removesuffix(".py").replace("/", ".").removesuffix(".__init__")
        near = [r for r in self.checks if module in r["modules"] and r["seconds"] <= CHEAP]
        near.sort(key=lambda row: row["seconds"])
        cells = [[r["name"], r["index"]] for r in near if r["kind"] == "cell"][:CELLS]
        items = [r["name"] for r in near if r["kind"] == "item"][-ITEMS:]
        if not cells and not items:
            return None
        code, rows = self._probe(cells, items, LIMIT)
        for row in rows:
            if row["differs"]:
                index = f" {row['index']}" if row["kind"] == "cell" else ""
                return f"{row['kind']} {row['name']}{index}: {row['differs'][0]}"[:160]
        return _ended(code)

    def _tested(self, tests: list[list[str]], broken: list[str]) -> str | None:
        for files in tests:
            done = self._pytest([*files, "-x", *(f"--deselect={name}" for name in broken)])
            if done.returncode:
                named = re.search(r"^FAILED (\S+)", done.stdout, re.MULTILINE)
                return f"test {named[1]}" if named else _ended(done.returncode) or "tests end"
        return None

    def _pytest(self, arguments: list[str]) -> Any:
        command = [sys.executable, "-m", "pytest", "-q", "-rf", "-p", "no:cacheprovider"]
        return self._run([*command, *arguments], TEST_LIMIT)

    def broken(self, room: str) -> list[str]:
        """Tests of a room that fail without any mutant, so that they notice none."""
        if room not in self._broken:
            done = self._pytest([f"tests/{room}"])
            self._broken[room] = re.findall(r"^FAILED (\S+)", done.stdout, re.MULTILINE)
        return self._broken[room]

    def tests(self, mutant: Mutant) -> list[list[str]]:
        """Test files that name the mutated module, then the room of its tests."""
        parts = Path(mutant.file).with_suffix("").parts
        room, name = parts[1], parts[-1]
        files = sorted((self.folder / "tests" / room).rglob("test_*.py"))
        near = [f for f in files if name in f.stem or f".{name} import" in f.read_text()]
        near.sort(key=lambda f: name not in f.stem)
        first = [f.relative_to(self.folder).as_posix() for f in near]
        return [*([first] if first else []), [f"tests/{room}"]]


def _ended(code: int) -> str | None:
    """How a process ended that was to notice something.

    Raises
    ------
    RuntimeError
        Somebody else ended it, so that it noticed nothing.
    """
    if code in (-SIGKILL, -SIGTERM, -SIGINT):
        raise RuntimeError(f"a check was ended by signal {-code}, which is none of its own")
    if code == -SIGXCPU:
        return "time limit"
    return f"ends with {code}" if code else None


def run(
    folder: Path,
    per_room: int = PER_ROOM,
    seed: int = SEED,
    limit: int | None = None,
    noticed: Mapping[tuple[Any, ...], str] | None = None,
) -> Iterator[dict[str, Any]]:
    """Every mutant of the sample with what killed it, one after the other.

    Parameters
    ----------
    limit
        So many mutants only, evenly out of the sample, and by tests alone.
    noticed
        What killed mutants, see :func:`killers`; these are not tried again, and the others by
        tests alone.
    """
    drawn = sample(ROOT, ROOMS, per_room, seed)
    if limit is not None:
        drawn = drawn[:: max(1, len(drawn) // limit)][:limit]
    known, noticed = equivalents(), noticed or {}
    copy = Copy(folder, recompute=limit is None and not noticed)
    for mutant in drawn:
        row = {**mutant._asdict(), "killed_by": None, "equivalent": excused(mutant, known)}
        if row["equivalent"] is None:
            row["killed_by"] = noticed.get(_place(row)) or copy.killer(mutant)
        yield row
