"""Commands that are killed, interrupted, or run twice at once."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from .calls import ended, interrupt, kill, reaches, start
from .jobs import Job
from .laboratory import Laboratory, Trial

#: Share of a command's computing within which it is struck.
_EARLIEST, _LATEST = 0.02, 0.98
#: Seconds of computing after which our own handler is in place, and the end of the start-up.
_HANDLED, _STARTED = 0.2, 1.0
INTERRUPTED = 130


def killed(lab: Laboratory, jobs: Sequence[Job]) -> Iterator[Trial]:
    """``kill -9`` at random moments: no final file is harmed, the rerun gives the same results."""
    for job in jobs:
        usual = lab.undisturbed(job).cpu
        struck = 0
        while struck < lab.repeats:
            place = lab.place()
            process = start(job.command, place)
            hit = reaches(process, usual * lab.rng.uniform(_EARLIEST, _LATEST))
            if hit:
                kill(process)
                struck += 1
            ended(process)
            if hit:
                yield Trial("killed", job.name, lab.again(job, place))


def interrupted(lab: Laboratory, jobs: Sequence[Job]) -> Iterator[Trial]:
    """Ctrl-C: exit code 130 and one line, in the start-up as well as in long work."""
    for job in jobs:
        usual = lab.undisturbed(job).cpu
        for k in range(lab.repeats):
            first, last = (_STARTED, usual) if k % 2 else (_HANDLED, _STARTED)
            place = lab.place()
            process = start(job.command, place)
            hit = reaches(process, min(lab.rng.uniform(first, last), _LATEST * usual))
            if hit:
                interrupt(process)
            call = ended(process)
            if not hit or call.code in job.codes:
                continue  # it was faster
            wrong = "" if (call.code, call.err) == (INTERRUPTED, "dualarm: interrupted\n") else (
                f"exit code {call.code}, {len(call.err.splitlines())} lines"
            )  # fmt: skip
            moment = "in long work" if k % 2 else "in start-up"
            yield Trial("interrupted", f"{job.name} {moment}", wrong or lab.again(job, place))


def twice(lab: Laboratory, jobs: Sequence[Job]) -> Iterator[Trial]:
    """Two runs at once in one folder: both succeed with the same results."""
    for job in jobs:
        expected = lab.undisturbed(job).results
        for _ in range(lab.repeats):
            place = lab.place()
            both = [start(job.command, place) for _ in range(2)]
            calls = [ended(process) for process in both]
            wrong = [job.complaint(call, expected, place.folder) for call in calls]
            yield Trial("two at once", job.name, next(filter(None, wrong), ""))
