"""Scene, task and robot files read so that no file can overwhelm the reader.

Size, nesting and the number of values, with aliases written out, are bounded before anything is
made of them.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from .datafiles import opened, parsed_yaml
from .errors import DataFileError
from .input_files import contents

#: Largest file [bytes], about ten thousand obstacles.
LARGEST_FILE = 1_000_000
#: Most values of a file, an alias counted as often as it is used.
MOST_VALUES = 500_000
#: Deepest nesting of lists and mappings.
DEEPEST = 50


def read_written(path: Path) -> dict[str, Any]:
    """Content of a YAML file that somebody else may have written.

    Raises
    ------
    DataFileError
        Missing, no regular file, too large, nested too deep, aliases that multiply or contain
        themselves, not YAML.
    """
    path = Path(path)
    written = contents(opened(path), "a readable YAML file", LARGEST_FILE)
    _refuse_deep(path, written)
    content = parsed_yaml(path, written)
    _count(path, content, {}, 0)
    return content


def _too_deep(path: Path) -> DataFileError:
    expected = f"at most {DEEPEST} lists or mappings inside each other"
    return DataFileError(path, "nesting", "deeper", expected)


def _refuse_deep(path: Path, written: bytes) -> None:
    """Brackets and indents deeper than any scene; the parser follows them by recursion."""
    depth = 0
    for line in written.splitlines():
        indent = len(line) - len(line.lstrip(b" -"))
        for byte in line if b"[" in line or b"{" in line or depth else b"":
            depth += (byte in b"[{") - (byte in b"]}")
            if depth > DEEPEST:
                raise _too_deep(path)
        depth = max(depth, 0)
        if indent > 20 * DEEPEST:
            raise _too_deep(path)


def _count(path: Path, value: Any, known: dict[int, int | None], depth: int) -> int:
    """Number of values below one; None in ``known`` marks those that are being counted."""
    if not isinstance(value, dict | list):
        return 1
    if depth > DEEPEST:
        raise _too_deep(path)
    counted = known.get(id(value), 0)
    if counted is None:
        raise DataFileError(path, "alias", "one that contains itself", "values that end")
    if counted:
        return counted
    known[id(value)] = None
    parts = value.values() if isinstance(value, dict) else value
    total = 1 + sum(_count(path, part, known, depth + 1) for part in parts)
    if total > MOST_VALUES:
        raise DataFileError(path, "aliases", f"{total} values", f"at most {MOST_VALUES} values")
    known[id(value)] = total
    return total
