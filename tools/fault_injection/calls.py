"""Commands in processes of their own: how they ended, and how to strike them in the middle."""

from __future__ import annotations

import os
import signal
import subprocess
import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

import psutil

#: Seconds of the clock after which a command counts as hanging, however busy the machine is.
LIMIT = 3600.0
#: Seconds between two looks at how much a process has computed.
_LOOK = 0.002


class Call(NamedTuple):
    """How a command ended."""

    code: int
    out: str
    err: str
    cpu: float


@dataclass(frozen=True)
class Place:
    """A folder to work in, a cache, and what else surrounds a command.

    Attributes
    ----------
    changes
        Environment variables; None removes one.
    prefix
        Words before the command, which run it with fewer rights.
    before
        Called in the new process before the command.
    """

    folder: Path
    cache: Path
    changes: Mapping[str, str | None] = field(default_factory=dict)
    prefix: tuple[str, ...] = ()
    before: Callable[[], None] | None = None

    def environment(self) -> dict[str, str]:
        """Environment of a command."""
        own = {"DUALARM_CACHE": str(self.cache), "MPLBACKEND": "agg", **self.changes}
        known = {**os.environ, **own}
        return {name: value for name, value in known.items() if value is not None}


def start(command: Sequence[str], place: Place) -> subprocess.Popen[bytes]:
    """Start a command in a session of its own."""
    return subprocess.Popen(
        [*place.prefix, *command], cwd=place.folder, env=place.environment(),
        stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        start_new_session=True, preexec_fn=place.before,
    )  # fmt: skip


def ended(process: subprocess.Popen[bytes]) -> Call:
    """Wait for the end of a command; one that hangs is killed and has the code -9."""
    before = os.times()
    try:
        out, err = process.communicate(timeout=LIMIT)
    except subprocess.TimeoutExpired:
        kill(process)
        out, err = process.communicate()
    after = os.times()
    cpu = after.children_user + after.children_system
    cpu -= before.children_user + before.children_system
    return Call(process.returncode, _text(out), _text(err), cpu)


def called(command: Sequence[str], place: Place) -> Call:
    """Run a command to its end."""
    return ended(start(command, place))


def computed(process: subprocess.Popen[bytes]) -> float | None:
    """Seconds that a command and its children have computed; None if it has ended."""
    total = 0.0
    try:
        for one in _tree(process):
            times = one.cpu_times()
            total += times.user + times.system + times.children_user + times.children_system
    except psutil.Error:
        return None if process.poll() is not None else total
    return total


def reaches(process: subprocess.Popen[bytes], seconds: float) -> bool:
    """Wait until a command has computed for so long; False if it ends before.

    The moment is one of its own computing, so that a busy machine moves it to no other place.
    """
    end = time.monotonic() + LIMIT
    while process.poll() is None and time.monotonic() < end:
        done = computed(process)
        if done is None:
            return False
        if done >= seconds:
            return True
        time.sleep(_LOOK)
    return False


def kill(process: subprocess.Popen[bytes]) -> None:
    """End a command and all its children at once, as a loss of power does."""
    with suppress(psutil.Error):
        for one in _tree(process):
            with suppress(psutil.Error):
                one.kill()
    with suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)


def interrupt(process: subprocess.Popen[bytes]) -> None:
    """What Ctrl-C does: an interruption of every process of the command."""
    with suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGINT)


def _tree(process: subprocess.Popen[bytes]) -> list[psutil.Process]:
    parent = psutil.Process(process.pid)
    return [parent, *parent.children(recursive=True)]


def _text(written: bytes) -> str:
    return written.decode("utf-8", "backslashreplace")
