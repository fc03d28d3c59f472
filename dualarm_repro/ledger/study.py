"""Heavy studies: stored results that cannot go stale unseen.

A study is a list of cells; each is computed by itself from its settings and its own random stream,
so that the outcome does not depend on order, on the number of workers or on interruptions.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from hashlib import sha256
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from joblib import Parallel, delayed
from tqdm import tqdm

from ..datafiles import data_path, data_root
from ..errors import DataFileError, InputError, LedgerError
from .drift import differences
from .files import to_json, write, write_text
from .fingerprint import hash_files, versions

_CHUNKS = 64


@dataclass(frozen=True)
class Study:
    """A stored study.

    Attributes
    ----------
    name
        ``<document>_<what>``; its files are ``data/results/<name>.parquet`` and ``.json``.
    title
        What it answers.
    cells
        Returns the settings of every cell, JSON-able mappings.
    compute
        One cell: settings and its generator to a flat mapping of numbers, booleans and texts.
    sources
        What the outcome depends on, relative to the package: files or folders of ``*.py``
        ("planning", "papers/xue/lottery.py").
    inputs
        Data files it depends on, relative to ``data``.
    seed
        Entropy of all random streams; cell k uses spawn key (k,).
    settings
        Frozen settings, recorded with the result.
    measured
        Columns that depend on the machine and are not compared (times).
    """

    name: str
    title: str
    cells: Callable[[], list[dict[str, Any]]]
    compute: Callable[[Mapping[str, Any], np.random.Generator], Mapping[str, Any]]
    sources: tuple[str, ...]
    seed: int
    inputs: tuple[str, ...] = ()
    settings: Mapping[str, Any] = field(default_factory=dict)
    measured: tuple[str, ...] = ()

    @property
    def table_path(self) -> Path:
        """The stored outcome, one row a cell."""
        return data_path("results", f"{self.name}.parquet")

    @property
    def meta_path(self) -> Path:
        """Seed, settings, hash of the sources and versions of the stored outcome."""
        return data_path("results", f"{self.name}.json")

    @cached_property
    def source_hash(self) -> str:
        """Hash of sources, inputs, seed and settings as they are now."""
        package = Path(__file__).resolve().parents[1]
        files = [p for name in self.sources for p in _python_files(package / name)]
        inputs = [data_path(name) for name in self.inputs]
        settings = to_json({"seed": self.seed, "settings": dict(self.settings)})
        return hash_files(files, package) + hash_files(inputs, data_root()) + hash_text(settings)

    def cell(self, index: int, settings: Mapping[str, Any]) -> dict[str, Any]:
        """Compute one cell with its own random stream."""
        stream = np.random.SeedSequence(self.seed, spawn_key=(index,))
        return dict(self.compute(settings, np.random.default_rng(stream)))

    def run(
        self, jobs: int = 1, progress: bool = False, scratch: Path | None = None
    ) -> pd.DataFrame:
        """Compute every cell and store the outcome.

        Chunks that are finished are kept in ``scratch`` until the study is complete, so that a run
        that was killed goes on where it stopped.
        """
        cells = self.cells()
        folder = (
            scratch or Path("_build") / "studies"
        ) / f"{self.name}-{hash_text(self.source_hash)}"
        chunks = np.array_split(np.arange(len(cells)), min(_CHUNKS, len(cells)))
        tasks = (delayed(self._chunk)(folder, chunk, cells) for chunk in chunks)
        done = Parallel(n_jobs=jobs, return_as="generator")(tasks)
        bar = tqdm(done, total=len(chunks), desc=self.name, disable=not progress)
        rows = [row for chunk in bar for row in chunk]
        table = pd.DataFrame(
            [{**cell, **row} for cell, row in zip(_flat(cells), rows, strict=True)]
        )
        write(self.table_path, lambda path: table.to_parquet(path, index=False))
        meta = {
            "title": self.title,
            "seed": self.seed,
            "settings": dict(self.settings),
            "cells": len(cells),
            "source_hash": self.source_hash,
            "versions": versions(),
        }
        write_text(self.meta_path, to_json(meta))
        for path in folder.glob("*.json"):
            path.unlink()
        return table

    def meta(self) -> dict[str, Any]:
        """What is recorded with the stored outcome.

        Raises
        ------
        DataFileError
            Nothing is stored, or it is no JSON.
        """
        try:
            return json.loads(self.meta_path.read_text(encoding="utf-8"))
        except (OSError, ValueError) as error:
            reason = getattr(error, "strerror", None) or str(error)
            expected = f"a stored study (`dualarm study {self.name}` computes it)"
            raise DataFileError(self.meta_path, "file", reason, expected) from None

    def status(self) -> str:
        """``up to date``, ``stale`` or ``missing``."""
        if not self.meta_path.is_file():
            return "missing"
        return "up to date" if self.meta()["source_hash"] == self.source_hash else "stale"

    def load(self) -> pd.DataFrame:
        """The stored outcome.

        Raises
        ------
        LedgerError
            A source, an input, the seed or a setting has changed since it was computed.
        """
        self.meta()
        if self.status() == "stale":
            raise LedgerError(
                f"{self.name}: stale, its sources changed; run `dualarm study {self.name}`"
            )
        return pd.read_parquet(self.table_path)

    def spot_check(self, count: int, seed: int) -> list[str]:
        """Recompute ``count`` cells drawn with ``seed``; say where they differ from the store."""
        if count < 1:
            raise InputError("spot check", "count", count, "a positive number")
        table, cells = self.load(), self.cells()
        drawn = np.random.default_rng(seed).choice(
            len(cells), min(count, len(cells)), replace=False
        )
        found = []
        for index in sorted(int(k) for k in drawn):
            made = json.loads(to_json(self.cell(index, cells[index])))
            stored = json.loads(to_json(table.iloc[index].to_dict()))
            for key in made.keys() - set(self.measured):
                lines = differences({key: stored.get(key)}, {key: made[key]})
                found += [f"{self.name} cell {index}: {line}" for line in lines]
        return found

    def _chunk(self, folder: Path, chunk: np.ndarray, cells: list[dict[str, Any]]) -> list[dict]:
        path = folder / f"{chunk[0]:06d}.json"
        if path.is_file():
            return json.loads(path.read_text(encoding="utf-8"))
        rows = [self.cell(int(index), cells[index]) for index in chunk]
        write_text(path, to_json(rows))
        return json.loads(to_json(rows))


def hash_text(text: str) -> str:
    """First 16 digits of the SHA-256 of a text."""
    return sha256(text.encode()).hexdigest()[:16]


def _python_files(path: Path) -> list[Path]:
    found = sorted(path.rglob("*.py")) if path.is_dir() else [path]
    if not found or not found[0].is_file():
        raise LedgerError(f"study sources: nothing at {path.name}")
    return found


def _flat(cells: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Cell settings as columns; nested ones as JSON text."""
    return [
        {k: json.dumps(v) if isinstance(v, list | dict) else v for k, v in cell.items()}
        for cell in cells
    ]
