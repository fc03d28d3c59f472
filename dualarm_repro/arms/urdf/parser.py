"""Border to the parsers of Pinocchio and coal: one error of ours, nothing on the terminal."""

from __future__ import annotations

import os
import re
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ...errors import DataFileError, DualArmError

_WRITTEN = re.compile(r"^(?:Error|Warning):?\s*(.+)$", re.M)


@contextmanager
def bordered(path: Path, field: str, expected: str) -> Iterator[list[str]]:
    """Turn any failure of the parser into one DataFileError, and collect what it writes.

    The parsers write their reasons to the standard error of the process; they are caught there.
    What they say without failing is in the list when the context is left.
    """
    said: list[str] = []
    with tempfile.TemporaryFile() as sink:
        saved = os.dup(2)
        os.dup2(sink.fileno(), 2)
        failure: Exception | None = None
        try:
            yield said
        except DualArmError:
            raise
        except Exception as error:
            failure = error
        finally:
            os.dup2(saved, 2)
            os.close(saved)
            sink.seek(0)
            said += _lines(sink.read().decode(errors="replace"))
        if failure is not None:
            value = said[0] if said else _first_line(failure)
            raise DataFileError(path, field, value, expected) from None


def _lines(text: str) -> list[str]:
    found = _WRITTEN.findall(text)
    return list(dict.fromkeys(" ".join(line.split()) for line in found))


def _first_line(error: Exception) -> str:
    return str(error).strip().split("\n")[0] or type(error).__name__
