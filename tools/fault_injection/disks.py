"""Disks that are full, and folders that nobody may write into."""

from __future__ import annotations

import os
import resource
import shutil
import subprocess
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from functools import partial
from pathlib import Path

from .calls import Place, called
from .jobs import OUT, Job, refusal
from .laboratory import Laboratory, Trial, ordinary

#: Page of a disk in memory [bytes].
_PAGE = 4096


def full(lab: Laboratory, jobs: Sequence[Job], cached: Sequence[Job]) -> Iterator[Trial]:
    """No room for the results of some commands, and for what others keep."""
    yield from full_disk(lab, jobs)
    yield from full_cache(lab, cached)


def full_disk(lab: Laboratory, jobs: Sequence[Job]) -> Iterator[Trial]:
    """No room for the results: refused in one line, nothing harmed, and all well once there is."""
    mounts = _may_mount(lab.place().folder)
    for job in jobs:
        lab.undisturbed(job)
        for _ in range(lab.repeats):
            limit = partial(_largest_file, int(lab.rng.integers(1, 4000)))
            place = lab.place(before=limit)
            wrong = _refused(lab, job, place) or lab.again(job, replace(place, before=None))
            yield Trial("full disk", f"{job.name}, small files", wrong)
            if not mounts:
                continue
            place, room = lab.place(), int(lab.rng.integers(1, 6)) * _PAGE
            (place.folder / OUT).mkdir()
            with mounted(place.folder / OUT, room):
                wrong = _refused(lab, job, place)
            yield Trial("full disk", f"{job.name}, small disk", wrong or lab.again(job, place))


def _refused(lab: Laboratory, job: Job, place: Place) -> str:
    """What is wrong with a command that has no room; empty if nothing."""
    call = called(job.command, place)
    expected = lab.undisturbed(job).results
    if call.code in job.codes:  # it fitted
        return job.complaint(call, expected, place.folder)
    if wrong := refusal(call) or job.harmed(expected, place.folder):
        return wrong
    left = job.left_behind(place.folder)
    return f"{left} temporary files left behind" if left else ""


def full_cache(lab: Laboratory, jobs: Sequence[Job]) -> Iterator[Trial]:
    """No room for the cache: it only costs time."""
    for job in jobs:
        lab.undisturbed(job)
        empty = lab.scratch / f"empty-{job.name}"
        place = lab.place(cache=empty, before=partial(_largest_file, 512))
        yield Trial("full disk", f"{job.name}, no room for the cache", lab.survives(job, place))


def read_only(lab: Laboratory, jobs: Sequence[Job]) -> Iterator[Trial]:
    """A folder for the results, a home and a cache that are closed."""
    prefix = ordinary()
    if prefix is None:
        return
    for job in jobs:
        expected = lab.undisturbed(job).results
        place = lab.place(prefix=prefix)
        with closed(place.folder / OUT):
            call = called(job.command, place)
            wrong = "" if job.told else refusal(call) or job.harmed(expected, place.folder)
        yield Trial("read-only folder", f"{job.name}, results", wrong or lab.again(job, place))
        home = lab.scratch / f"home-{job.name}"
        with closed(home):
            changes = {"HOME": str(home), "DUALARM_CACHE": None, "XDG_CACHE_HOME": None}
            wrong = lab.survives(job, lab.place(prefix=prefix, changes=changes))
        yield Trial("read-only folder", f"{job.name}, home", wrong)
        with closed(lab.scratch / f"cache-{job.name}") as cache:
            wrong = lab.survives(job, lab.place(prefix=prefix, cache=cache))
        yield Trial("read-only folder", f"{job.name}, cache", wrong)


@contextmanager
def closed(folder: Path) -> Iterator[Path]:
    """A folder that can be read but not written into."""
    folder.mkdir(parents=True)
    folder.chmod(0o555)
    try:
        yield folder
    finally:
        folder.chmod(0o755)


@contextmanager
def mounted(folder: Path, size: int) -> Iterator[None]:
    """A disk in memory of so many bytes."""
    command = ["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", folder]
    subprocess.run(command, check=True, capture_output=True)
    try:
        yield
    finally:
        subprocess.run(["umount", "-l", folder], check=True)


def _may_mount(folder: Path) -> bool:
    """Whether this process may mount a disk at all."""
    if os.geteuid() != 0 or shutil.which("mount") is None:
        return False
    try:
        with mounted(folder, _PAGE):
            return True
    except subprocess.CalledProcessError:
        return False


def _largest_file(size: int) -> None:
    """Limit the size of every file that this process writes [bytes]."""
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, resource.RLIM_INFINITY))
