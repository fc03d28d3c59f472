"""Command line: print, compute, verify, export and cite the items of the ledger.

Whatever happens ends in one line: this module imports next to nothing, so that even an interruption
while a command is being imported is answered.
"""

from __future__ import annotations

import gc
import io
import os
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

from ..errors import DualArmError, LedgerError

#: Environment variable: any value shows the traceback of an error that nobody foresaw.
TRACEBACK_VARIABLE = "DUALARM_TRACEBACK"
#: Exit codes beside 0; 1 also stands for a check that failed.
FAILED, BAD_INPUT, UNFORESEEN, INTERRUPTED = 1, 2, 70, 130
#: Files were written, but the motion in them did not arrive or is not certified free of contact.
NOT_USABLE = 3
#: New objects after which garbage is sought, and how often among the older ones. Loading and
#: compiling make many that stay, and almost no garbage: Python's own (700, 10, 10) would cost a
#: tenth of the time of a first plan.
COLLECT_AFTER = (100_000, 20, 50)
#: Seconds after which a command that is still at work is interrupted once more: a library may have
#: swallowed the exception, as Python does in ``__del__``. Longer than what ends workers takes.
AGAIN = 5.0
#: Whether the system can do so; Windows cannot.
ALARMED = hasattr(signal, "setitimer")


def process() -> None:
    """Entry point of the process ``dualarm``, which nothing interrupts once it has answered."""
    main(last=True)


def main(last: bool = False) -> None:
    """Exit with 0, 1 for a failed check, 2 for bad input, 3 for a motion that must not be run, 130
    when interrupted; ``last`` if the process ends with it."""
    with _interruptions(last) as seen, _seldom_collected(last):
        try:
            _write_what_the_encoding_lacks()
            code = _answer(sys.argv[1:])
            sys.stdout.flush()
        except BaseException as error:  # one place decides how each of them ends
            code = INTERRUPTED if seen else _ending(error)
    if seen:
        code = _said("interrupted", INTERRUPTED)
        exec("")  # else an interrupted exec() of a library ends the interpreter by the signal
    sys.exit(code)


def _write_what_the_encoding_lacks() -> None:
    """Letters that a terminal or pipe has no code for are written as escapes, not refused."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper) and stream.encoding.lower() != "utf-8":
            stream.reconfigure(errors="backslashreplace")


def _answer(arguments: list[str]) -> int:
    completing = "_DUALARM_COMPLETE" in os.environ
    if not arguments and not completing:
        from .overview import overview

        print(overview())
        return BAD_INPUT
    from .app import application

    command = application(rich=sys.stdout.isatty())
    if completing:
        command.main(arguments, prog_name="dualarm")
    with command.make_context("dualarm", arguments) as context:
        command.invoke(context)
    return 0


def _ending(error: BaseException) -> int:
    """Exit code of an exception, after the line that says what it was."""
    if isinstance(error, SystemExit):
        return error.code if isinstance(error.code, int) else int(bool(error.code))
    if isinstance(error, LedgerError):
        return _said(str(error), FAILED)
    if isinstance(error, DualArmError):
        for line in getattr(error, "lines", [str(error)]):
            _said(line, BAD_INPUT)
        return BAD_INPUT
    if isinstance(error, BrokenPipeError):  # the reader of a pipe went away
        _mute(sys.stdout)
        return 0
    if isinstance(error, OSError):
        _mute(sys.stdout)
        return _said(f"{error.filename or 'output'}: {error.strerror or error}", FAILED)
    import typer

    if isinstance(error, typer.Exit):
        return error.exit_code
    if isinstance(error, typer.Abort):
        return _said("interrupted", INTERRUPTED)
    if isinstance(error, typer.TyperException):
        return _said(error.format_message() + _where(error), BAD_INPUT)
    if os.environ.get(TRACEBACK_VARIABLE) or not isinstance(error, Exception):
        raise error
    kind = f"{type(error).__name__}: {error}"
    return _said(f"unforeseen {kind} ({TRACEBACK_VARIABLE}=1 shows where)", UNFORESEEN)


def _where(error: Any) -> str:
    context = getattr(error, "ctx", None)
    return f" (see `{context.command_path} --help`)" if context else ""


def _said(message: str, code: int) -> int:
    try:
        print(f"dualarm: {' '.join(message.split())}", file=sys.stderr, flush=True)
    except OSError:  # nobody listens
        pass
    return code


def _mute(stream: Any) -> None:
    """Send what is still buffered nowhere, so that the interpreter does not stumble at its end."""
    try:
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
    except (OSError, ValueError):
        pass


@contextmanager
def _seldom_collected(last: bool) -> Iterator[None]:
    """Look for garbage seldom; a caller that goes on gets its own habit back."""
    before = gc.get_threshold()
    gc.set_threshold(*COLLECT_AFTER)
    try:
        yield
    finally:
        if not last:
            gc.set_threshold(*before)


@contextmanager
def _interruptions(last: bool) -> Iterator[list[int]]:
    """Note interruptions, and let one end us, whatever a library makes of the exception.

    Those that follow within ``AGAIN`` seconds do not disturb what the first one has to clear away.
    After the ``last`` command of a process there is nothing left to interrupt but its end.
    """
    seen: list[int] = []
    quiet = False
    hook = sys.unraisablehook

    def stop(number: int, frame: FrameType | None) -> None:
        nonlocal quiet
        if quiet:
            return
        quiet = True
        seen.append(number)
        sys.unraisablehook = lambda _: None
        if ALARMED:
            signal.setitimer(signal.ITIMER_REAL, AGAIN)
        raise KeyboardInterrupt

    def once_more(number: int, frame: FrameType | None) -> None:
        nonlocal quiet
        quiet = False
        signal.raise_signal(signal.SIGINT)

    try:
        before = {signal.SIGINT: signal.signal(signal.SIGINT, stop)}
    except ValueError:  # not the main thread
        yield seen
        return
    if ALARMED:
        before[signal.SIGALRM] = signal.signal(signal.SIGALRM, once_more)
    try:
        yield seen
    finally:
        if seen and ALARMED:
            signal.setitimer(signal.ITIMER_REAL, 0)
        if last:
            signal.signal(signal.SIGINT, signal.SIG_IGN)
        else:
            for number, handler in before.items():
                if handler is not None:  # else it was not set from Python, and cannot be from there
                    signal.signal(number, handler)
            sys.unraisablehook = hook
