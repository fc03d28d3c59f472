"""Where commands are tried: fresh folders, a warm cache, and what each gives undisturbed."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

import numpy as np

from dualarm_repro.cache_folder import cache_folder

from .calls import Place, called
from .jobs import Job, last_line

Kind = TypeVar("Kind")
#: Words that take from a superuser the right to ignore who owns a file and its mode.
ORDINARY = (
    "setpriv", "--bounding-set=-dac_override,-dac_read_search",
    "--inh-caps=-dac_override,-dac_read_search",
)  # fmt: skip


class Trial(NamedTuple):
    """One fault and what it was done to; ``wrong`` is empty where the command survived it."""

    kind: str
    name: str
    wrong: str


class Undisturbed(NamedTuple):
    """What a command gives, the seconds that it computes for it, and the folder that it leaves."""

    results: dict[str, str]
    cpu: float
    folder: Path


@dataclass
class Laboratory:
    """Folders below ``scratch``; ``repeats`` random moments and sizes of each kind and command.

    ``few`` tries only so many, drawn by ``rng``, of the ways to damage, the folders, the locales.
    ``cache`` is the one that all share; without, a copy of the user's.
    """

    scratch: Path
    rng: np.random.Generator
    repeats: int
    few: int | None = None
    cache: Path | None = None
    known: dict[str, Undisturbed] = field(default_factory=dict)
    _number: int = 0

    def place(self, **surroundings: Any) -> Place:
        """A new folder, and the warm cache unless another is given."""
        self._number += 1
        folder = self.scratch / f"place{self._number}"
        folder.mkdir(parents=True)
        surroundings.setdefault("cache", self.warm())
        return Place(folder, **surroundings)

    def some(self, ways: Iterable[Kind]) -> list[Kind]:
        """All of some ways, or a few of them."""
        every = list(ways)
        return [every[k] for k in self.rng.permutation(len(every))[: self.few]]

    def warm(self) -> Path:
        """The cache that all share."""
        if self.cache is None:
            self.cache, source = self.scratch / "warm", cache_folder()
            if source is not None and source.is_dir():
                shutil.copytree(source, self.cache)
        self.cache.mkdir(parents=True, exist_ok=True)
        return self.cache

    def undisturbed(self, job: Job) -> Undisturbed:
        """What a command gives when nothing happens to it, twice the same.

        Raises
        ------
        RuntimeError
            It fails, or gives one thing today and another tomorrow.
        """
        if job.name not in self.known:
            both = []
            for _ in range(2):  # the first also warms the cache
                place = self.place()
                call = called(job.command, place)
                if call.code not in job.codes:
                    raise RuntimeError(f"{job.name} fails undisturbed: {last_line(call.err)}")
                both.append(Undisturbed(job.results(place.folder, call), call.cpu, place.folder))
            if both[0].results != both[1].results:
                raise RuntimeError(f"{job.name} gives other results the second time")
            self.known[job.name] = both[1]
        return self.known[job.name]

    def survives(self, job: Job, place: Place) -> str:
        """Run a command that has to give its results all the same; what is wrong, else nothing."""
        expected = self.undisturbed(job).results
        return job.complaint(called(job.command, place), expected, place.folder)

    def again(self, job: Job, place: Place) -> str:
        """After a fault: no file of a final name is harmed, and the rerun gives the results."""
        harmed = job.harmed(self.undisturbed(job).results, place.folder)
        return harmed or self.survives(job, place)


def ordinary() -> tuple[str, ...] | None:
    """Prefix of a command that obeys the modes of files; None where there is no way."""
    if os.geteuid() != 0:
        return ()
    return ORDINARY if shutil.which(ORDINARY[0]) else None


def damages(rng: np.random.Generator) -> dict[str, Callable[[Path], None]]:
    """Ways in which a file goes bad."""

    def flip(path: Path) -> None:
        content = bytearray(path.read_bytes())
        for place in rng.integers(len(content), size=min(16, len(content))):
            content[place] ^= int(rng.integers(1, 256))
        path.write_bytes(content)

    def folder(path: Path) -> None:
        path.unlink()
        path.mkdir()

    def another_owner(path: Path) -> None:
        path.chmod(0)
        if os.geteuid() == 0:
            os.chown(path, 12345, 12345)

    return {
        "empty": lambda path: _put(path, b""),
        "truncated": lambda path: _put(path, path.read_bytes()[: path.stat().st_size // 2]),
        "random bytes": lambda path: _put(path, rng.bytes(max(path.stat().st_size, 64))),
        "flipped bytes": flip,
        "a folder in its place": folder,
        "another owner": another_owner,
    }


def _put(path: Path, content: bytes) -> None:
    path.write_bytes(content)


def each_damage(
    lab: Laboratory, files: Callable[[Path], list[Path]], prepared: Callable[[], Place]
) -> Iterator[tuple[str, Place]]:
    """For each way, a place whose files have gone bad in it."""
    for way, damage in lab.some(damages(lab.rng).items()):
        place = prepared()
        if way == "another owner" and not place.prefix and os.geteuid() == 0:
            continue  # nothing is closed to a superuser
        if not (found := files(place.folder)):
            raise RuntimeError(f"nothing to damage below {place.folder.name}")
        for path in found:
            damage(path)
        yield way, place
