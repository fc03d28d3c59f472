"""What became of one call with hostile input: refused in one line, answered, or a defect."""

import dataclasses
import signal
from contextlib import contextmanager, suppress
from enum import Enum

import numpy as np

from dualarm_repro.errors import DualArmError

#: Longest processor time of a call [s], and longest line of an error.
PATIENCE, LINE = 10.0, 6000
#: The same where it compiles first, and how often it is asked whether it still does [s].
COMPILED, AGAIN = 120.0, 0.5


class Hang(BaseException):
    """A call takes too long; no ``Exception``, so that nothing on the way swallows it."""


def compiles(frame):
    """Whether the compiler is at work. What ends it midway leaves a function that it takes for
    compiled, and every later call of it fails."""
    while frame is not None:
        if frame.f_globals.get("__name__", "").partition(".")[0] in ("numba", "llvmlite"):
            return True
        frame = frame.f_back
    return False


@contextmanager
def patience(seconds=PATIENCE):
    """Raise :class:`Hang` in what takes longer, but never in the compiler."""

    def stop(number, frame):
        if not compiles(frame):
            raise Hang

    before = signal.signal(signal.SIGPROF, stop)
    signal.setitimer(signal.ITIMER_PROF, seconds, AGAIN)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)


def holds_nan(value, depth=4):
    """Whether there is a NaN in a result: arrays, numbers, and what holds them."""
    if isinstance(value, float | np.floating):
        return bool(np.isnan(value))
    if isinstance(value, np.ndarray):
        return value.dtype.kind in "fc" and bool(np.isnan(value).any())
    if depth == 0 or isinstance(value, str | bytes | type | Enum):
        return False
    if isinstance(value, dict):
        return any(holds_nan(one, depth - 1) for one in value.values())
    if isinstance(value, list | tuple):
        return any(holds_nan(one, depth - 1) for one in value)
    if dataclasses.is_dataclass(value):
        return any(
            holds_nan(getattr(value, one.name, None), depth - 1)
            for one in dataclasses.fields(value)
        )
    return False


def _answer(call):
    """What a call gives. One that takes too long may have compiled for arguments of a new type: it
    is given time for that, once, and then has to be quick."""
    try:
        with patience():
            return call()
    except Hang:
        with suppress(DualArmError), patience(COMPILED):
            call()
        with patience():
            return call()


def judged(call, nan_given=False, nan_allowed=False):
    """``("refused" | "answered", "")``, or ``("defect", what)``.

    A value for a NaN that was given is as wrong as a NaN for finite numbers, unless NaN has a
    meaning in the answers of that call (``nan_allowed``).
    """
    try:
        result = _answer(call)
    except DualArmError as error:
        try:
            text = str(error)
        except Exception as other:
            return "defect", f"{type(error).__name__} cannot be printed: {type(other).__name__}"
        lines = getattr(error, "lines", [text])  # several faults are a line each
        if not lines or any("\n" in line or not line for line in lines):
            return "defect", f"the message is no line: {text[:80]!r}"
        return ("refused", "") if len(text) < LINE else ("defect", f"{len(text)} letters")
    except Hang:
        return "defect", "no answer"
    except (Exception, RecursionError) as error:
        where = error.__traceback__
        while where.tb_next is not None:
            where = where.tb_next
        place = where.tb_frame.f_code
        words = " ".join(str(error).split())[:90]
        return "defect", (
            f"{type(error).__name__}: {words} ({place.co_filename.rpartition('/')[2]}:"
            f"{where.tb_lineno})"
        )
    if nan_allowed:
        return "answered", ""
    if nan_given:
        return "defect", "answers for NaN"
    return ("defect", "NaN for finite input") if holds_nan(result) else ("answered", "")
