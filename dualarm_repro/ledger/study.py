"""Heavy studies: stored results that cannot go stale unseen.

A study is a list of cells; each is computed by itself from its settings and its own random stream,
so that the outcome does not depend on order, on the number of workers or on interruptions. With it
are stored the closure of what it depends on and a hash of the table itself.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from hashlib import sha256
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..datafiles import data_path, opened
from ..errors import DataFileError, InputError, LedgerError
from ..tracking import note, recording
from .closure import closure, hash_file, hash_inputs
from .comparison import Comparison
from .drift import differences
from .files import through_json, to_json, write, write_text
from .streams import stream
from .workers import results

if TYPE_CHECKING:
    import pandas as pd

    from .registry import Registry

#: Parts of a study that are handed out; a worker may wait for one at the end, so they are small.
_CHUNKS = 256


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
    seed
        Entropy of all random streams; cell k uses spawn key (k,).
    settings
        Frozen settings, recorded with the result.
    measured
        Columns that depend on the machine and are not compared (times).
    nested
        Columns that hold JSON texts, compared by what they mean.
    compared
        Columns, or what is in nested ones, that are compared otherwise than by digits.
    knife_edge
        Column that says of a cell that next to nothing decides its outcome: a spot check leaves it
        out, whether the stored or the new row says so, since another processor may decide
        otherwise.
    certificate
        Settings and stored row of a cell to columns that follow from others of the same row. Where
        a search ends hangs on round-off; what holds at the place that it found does not, and a
        spot check computes it again there. Such columns are ``measured`` too.
    peers
        Packages of others that some columns are computed with, with the prefix of those columns.
    also
        Modules that it depends on beside the closure of ``compute`` and ``cells``.
    dearest
        Numbers of cells that workers get first, where a few take so long that one worker would be
        left with the last of them.
    """

    name: str
    title: str
    cells: Callable[[], list[dict[str, Any]]]
    compute: Callable[[Mapping[str, Any], np.random.Generator], Mapping[str, Any]]
    seed: int
    settings: Mapping[str, Any] = field(default_factory=dict)
    measured: tuple[str, ...] = ()
    nested: tuple[str, ...] = ()
    compared: tuple[Comparison, ...] = ()
    knife_edge: str | None = None
    certificate: Callable[[Mapping[str, Any], Mapping[str, Any]], Mapping[str, Any]] | None = None
    peers: Mapping[str, str] = field(default_factory=dict)
    also: tuple[str, ...] = ()
    dearest: tuple[int, ...] = ()
    registry: Registry | None = field(default=None, repr=False, compare=False)

    @property
    def nudge(self) -> Callable[[int], None] | None:
        """Makes inputs of this process differ by round-off; None if the registry knows no way."""
        return self._known().nudge

    @property
    def table_path(self) -> Path:
        """The stored outcome, one row a cell."""
        return data_path("results", f"{self.name}.parquet")

    @property
    def meta_path(self) -> Path:
        """Seed, settings, closure, inputs, versions and hash of the stored outcome."""
        return data_path("results", f"{self.name}.json")

    @cached_property
    def code(self) -> dict[str, Any]:
        """Digest of code, seed and settings as they are now, with the modules and versions."""
        found = closure([self.compute, self.cells], ("dualarm_repro.ledger.streams", *self.also))
        settings = to_json({"seed": self.seed, "settings": dict(self.settings)}, indent=None)
        text = f"{found.digest} {settings}"
        return {
            "digest": sha256(text.encode()).hexdigest(),
            "modules": list(found.modules),
            "versions": dict(found.versions),
        }

    def cell(self, index: int, settings: Mapping[str, Any]) -> dict[str, Any]:
        """Compute one cell with its own random stream."""
        return dict(self.compute(settings, stream(self.seed, index)))

    def run(
        self,
        jobs: int = 1,
        progress: bool = False,
        scratch: Path | None = None,
        scheduler: str | None = None,
    ) -> pd.DataFrame:
        """Compute every cell and store the outcome.

        Chunks that are finished are kept in ``scratch`` until the study is complete, so that a run
        that was killed goes on where it stopped.

        Parameters
        ----------
        jobs
            Worker processes on this machine.
        scheduler
            Address of a Dask scheduler whose workers compute instead.

        Raises
        ------
        LedgerError
            A package that some columns need is not installed.
        """
        import pandas as pd

        if lacking := self.missing_peers():
            raise LedgerError(f"{self.name}: {', '.join(lacking)} not installed, which it needs")
        cells = self.cells()
        key = self.code["digest"][:16]
        folder = (scratch or Path("_build") / "studies") / f"{self.name}-{key}"
        chunks = parts(len(cells))
        kept = {k: _read_chunk(folder, chunk) for k, chunk in enumerate(chunks)}
        missing = [k for k in self.handed_out(chunks) if kept[k] is None]
        tasks = ((self._chunk, chunks[k], [cells[i] for i in chunks[k]]) for k in missing)
        made = results(tasks, len(missing), self.name, jobs, progress, scheduler)
        for k, (rows, inputs) in zip(missing, made, strict=True):
            kept[k] = {"rows": rows, "inputs": inputs}
            write_text(_chunk_path(folder, chunks[k]), to_json(kept[k], indent=None))
        whole = [chunk for chunk in kept.values() if chunk is not None]
        rows = [row for chunk in whole for row in chunk["rows"]]
        inputs = sorted({name for chunk in whole for name in chunk["inputs"]})
        table = pd.DataFrame(
            [{**cell, **row} for cell, row in zip(_flat(cells), rows, strict=True)]
        )
        write(self.table_path, lambda path: table.to_parquet(path, index=False))
        meta = {
            "title": self.title,
            "seed": self.seed,
            "settings": dict(self.settings),
            "cells": len(cells),
            "code": self.code,
            "inputs": hash_inputs(self._known(), inputs),
            "table_sha256": hash_file(self.table_path),
        }
        write_text(self.meta_path, to_json(meta))
        for chunk in chunks:  # another run of the same study may remove them too
            _chunk_path(folder, chunk).unlink(missing_ok=True)
        return table

    def handed_out(self, chunks: Sequence[np.ndarray]) -> list[int]:
        """Positions of these chunks in the order in which workers get them."""
        beyond = [cell for cell in self.dearest if cell >= sum(map(len, chunks))]
        if beyond:
            raise InputError(f"study {self.name}", "dearest", beyond, "numbers of its cells")
        rank = {cell: place for place, cell in enumerate(self.dearest)}
        return sorted(
            range(len(chunks)),
            key=lambda k: min(rank.get(i, len(rank)) for i in chunks[k].tolist()),
        )

    def _known(self) -> Registry:
        from .registry import REGISTRY

        return self.registry or REGISTRY

    def missing_peers(self) -> list[str]:
        """Packages of others that are not installed here: their columns are not compared."""
        return [name for name in self.peers if find_spec(name) is None]

    def meta(self) -> dict[str, Any]:
        """What is recorded with the stored outcome.

        Raises
        ------
        DataFileError
            Nothing is stored, or it is no JSON mapping.
        """
        expected = f"a stored study (`dualarm study {self.name}` computes it)"
        try:
            found = json.loads(opened(self.meta_path).read_text(encoding="utf-8"))
        except (OSError, ValueError) as error:
            reason = getattr(error, "strerror", None) or str(error)
            raise DataFileError(self.meta_path, "file", reason, expected) from None
        if not isinstance(found, dict) or not _whole(found):
            raise DataFileError(self.meta_path, "file", type(found).__name__, expected)
        return found

    def status(self) -> str:
        """``up to date``, ``missing``, or ``stale`` with what has changed."""
        if not self.meta_path.is_file() or not self.table_path.is_file():
            return "missing"
        try:
            meta = self.meta()
        except DataFileError:
            return "stale: its record cannot be read"
        if hash_file(self.table_path) != meta["table_sha256"]:
            return "stale: the table is not the one that was computed"
        if meta["code"]["digest"] != self.code["digest"]:
            return "stale: code, seed or settings changed"
        now = hash_inputs(self._known(), meta["inputs"])
        if changed := [name for name, key in now.items() if key != meta["inputs"][name]]:
            return f"stale: {', '.join(changed)} changed"
        return "up to date"

    def load(self) -> pd.DataFrame:
        """The stored outcome.

        Raises
        ------
        LedgerError
            Something it depends on, or the table itself, has changed since it was computed.
        """
        import pandas as pd

        meta, status = self.meta(), self.status()
        if status != "up to date":
            raise LedgerError(f"{self.name}: {status}; run `dualarm study {self.name}`")
        note(*meta["inputs"])
        return pd.read_parquet(opened(self.table_path))

    def differs(self, stored: Mapping[str, Any], made: Mapping[str, Any]) -> list[str]:
        """Where a cell that was computed again differs from the stored one.

        Not compared are measured times, and columns of peers that are missing here.
        """
        rows = self.plain(stored), self.plain(made)
        absent = tuple(self.peers[name] for name in self.missing_peers())
        keys = (rows[0].keys() | rows[1].keys()) - set(self.measured)
        found = []
        for key in sorted(key for key in keys if not key.startswith(absent or ("\0",))):
            before, now = ({"obtained": {key: row.get(key)}} for row in rows)
            found += differences(before, now, self.compared)
        return found

    def plain(self, row: Mapping[str, Any]) -> dict[str, Any]:
        """A row as it comes back from the store, nested texts read."""
        plain = through_json(row)
        for key in self.nested:
            if isinstance(plain.get(key), str):
                plain[key] = json.loads(plain[key])
        return plain

    def _chunk(
        self, chunk: np.ndarray, cells: list[dict[str, Any]]
    ) -> tuple[list[dict[str, Any]], list[str]]:
        with recording() as inputs:
            rows = [self.cell(int(k), cell) for k, cell in zip(chunk, cells, strict=True)]
        return json.loads(to_json(rows)), sorted(inputs)


def parts(count: int) -> list[np.ndarray]:
    """Numbers of the cells that a worker gets at a time, of so many in all."""
    return np.array_split(np.arange(count), min(_CHUNKS, count))


def _whole(meta: Mapping[str, Any]) -> bool:
    """Whether a record of a study has what its readers take from it, in the form they expect."""
    code, cells = meta.get("code"), meta.get("cells")
    return (
        isinstance(code, dict)
        and isinstance(code.get("digest"), str)
        and isinstance(cells, int)
        and isinstance(meta.get("inputs"), dict)
        and isinstance(meta.get("table_sha256"), str)
    )


def _chunk_path(folder: Path, chunk: np.ndarray) -> Path:
    return folder / f"{chunk[0]:06d}.json"


def _read_chunk(folder: Path, chunk: np.ndarray) -> dict[str, Any] | None:
    """What was kept of these cells, and of no more or fewer of them."""
    try:
        found = json.loads(_chunk_path(folder, chunk).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    if not isinstance(found, dict) or not {"rows", "inputs"} <= found.keys():
        return None
    rows = found["rows"]
    return found if isinstance(rows, list) and len(rows) == len(chunk) else None


def _flat(cells: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Cell settings as columns; nested ones as JSON text."""
    return [
        {k: json.dumps(v) if isinstance(v, list | dict) else v for k, v in cell.items()}
        for cell in cells
    ]
