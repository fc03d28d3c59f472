"""Files that somebody else names: their paths and their bytes, of regular files alone and bounded.

Every reader of such a file goes through here, so that a folder, a device that never ends, a pipe
that nobody writes to or a name that is none ends in one line.
"""

from __future__ import annotations

import os
import stat
from pathlib import Path

from .errors import DataFileError, InputError

#: Largest mesh file [bytes].
LARGEST_MESH = 200_000_000
_KINDS = (
    (stat.S_ISDIR, "a folder"),
    (stat.S_ISFIFO, "a pipe"),
    (stat.S_ISSOCK, "a socket"),
    (stat.S_ISCHR, "a device"),
    (stat.S_ISBLK, "a device"),
)


def path_of(source: str, field: str, value: object) -> Path:
    """The path that an argument names.

    Raises
    ------
    InputError
        The value is neither text nor a path, is empty, or holds a NUL.
    """
    named = os.fspath(value) if isinstance(value, os.PathLike) else value
    if not isinstance(named, str):
        raise InputError(source, field, value, "a path as text or pathlib.Path")
    if not named.strip() or "\0" in named:
        raise InputError(source, field, named, "the path of a file")
    return Path(named)


def require_regular(path: Path, expected: str, largest: int) -> None:
    """Raise unless a file can be read to its end.

    Raises
    ------
    DataFileError
        Missing, a folder, a pipe, a socket, a device, or of more than ``largest`` bytes.
    """
    try:
        found = path.stat()
    except (OSError, ValueError) as error:
        raise _unreadable(path, error, expected) from None
    _require_regular(path, found, expected, largest)


def contents(path: Path, expected: str, largest: int) -> bytes:
    """The bytes of a file.

    Parameters
    ----------
    expected : str
        What the message asks for, such as ``"a readable YAML file"``.
    largest : int
        Most bytes that are read.

    Raises
    ------
    DataFileError
        As :func:`require_regular`; also for a file that may not be read.
    """
    require_regular(path, expected, largest)  # opening a device may do something already
    try:
        # Without O_NONBLOCK a pipe put in its place meanwhile would be waited for.
        handle = os.open(path, os.O_RDONLY | os.O_CLOEXEC | os.O_NONBLOCK)
        with os.fdopen(handle, "rb") as file:
            _require_regular(path, os.fstat(handle), expected, largest)
            found = file.read(largest + 1)
    except (OSError, ValueError) as error:
        raise _unreadable(path, error, expected) from None
    if len(found) > largest:
        raise _too_large(path, len(found), largest)
    return found


def _require_regular(path: Path, found: os.stat_result, expected: str, largest: int) -> None:
    if not stat.S_ISREG(found.st_mode):
        kind = next((name for holds, name in _KINDS if holds(found.st_mode)), "no regular file")
        raise DataFileError(path, "file", kind, expected)
    if found.st_size > largest:
        raise _too_large(path, found.st_size, largest)


def _too_large(path: Path, size: int, largest: int) -> DataFileError:
    return DataFileError(path, "size", f"{size / 1e6:.1f} MB", f"at most {largest / 1e6:g} MB")


def _unreadable(path: Path, error: Exception, expected: str) -> DataFileError:
    return DataFileError(path, "file", getattr(error, "strerror", None) or "no such name", expected)
