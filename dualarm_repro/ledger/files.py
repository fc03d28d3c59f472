"""Writing results: to a temporary name first, then renamed, so that no half file is left."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Mapping
from pathlib import Path
from tempfile import NamedTemporaryFile
from typing import Any

import numpy as np

from ..errors import OutputError


def write(path: Path, save: Callable[[Path], Any]) -> Path:
    """Call ``save`` with a temporary path beside ``path`` and rename it when it has succeeded.

    Raises
    ------
    OutputError
        The folder or the file cannot be written.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with NamedTemporaryFile(
            dir=path.parent, prefix=f".{path.stem}.", suffix=path.suffix, delete=False
        ) as handle:
            temporary = Path(handle.name)
    except OSError as error:
        raise OutputError(path, "output", error.strerror, "a folder that can be written") from None
    try:
        save(temporary)
        temporary.chmod(0o666 & ~_umask())
        temporary.replace(path)
    except OSError as error:
        raise OutputError(path, "output", error.strerror, "a file that can be written") from None
    finally:
        temporary.unlink(missing_ok=True)
    return path


def write_text(path: Path, text: str) -> Path:
    """Write a UTF-8 text file atomically."""
    return write(path, lambda temporary: temporary.write_text(text, encoding="utf-8"))


def to_json(value: Any, indent: int | None = 2) -> str:
    """JSON text; numpy values become numbers and lists, NaN and infinity become null."""
    return json.dumps(_plain(value), indent=indent, ensure_ascii=False, allow_nan=False) + "\n"


def through_json(value: Mapping[str, Any]) -> dict[str, Any]:
    """A mapping as it comes back from its JSON text."""
    found: dict[str, Any] = json.loads(to_json(dict(value)))
    return found


def _plain(value: Any) -> Any:
    if isinstance(value, dict):
        return {str(key): _plain(part) for key, part in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(part) for part in value]
    if isinstance(value, np.ndarray):
        return _plain(value.tolist())
    if isinstance(value, np.generic):
        return _plain(value.item())
    if isinstance(value, float) and not np.isfinite(value):
        return None
    return value


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
