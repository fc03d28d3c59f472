"""Machine code of compiled functions, kept under what it depends on.

The cache of numba knows the file of a function only: after an edit of a function that it calls, old
machine code would go on running. Here the key is the import closure of the function's module, and
the field names of the named tuples that it is given, whose classes may be anywhere.
"""

from __future__ import annotations

import os
import pickle
import sys
from collections.abc import Callable
from functools import cache
from hashlib import sha256
from pathlib import Path
from platform import python_version
from typing import Any

import llvmlite
import numba
from numba import types
from numba.core.caching import (
    CompileResultCacheImpl,
    FunctionCache,
    IndexDataCacheFile,
    NullCache,
    _CacheLocator,
)

from .cache_folder import cache_folder
from .sources import graph
from .terminal import watched


@cache
def stamp(module: str) -> str:
    """What the machine code of a module depends on: its import closure and the compiler."""
    found = graph().digest(graph().closure([module]))
    versions = (numba.__version__, llvmlite.__version__, python_version())
    return sha256(f"{found} {versions}".encode()).hexdigest()


def compiled_folder() -> Path | None:
    """Folder of the machine code (``NUMBA_CACHE_DIR`` if set), or None where nothing is kept."""
    if chosen := os.environ.get("NUMBA_CACHE_DIR"):
        return Path(chosen)
    root = cache_folder()
    return root / "compiled" if root else None


def is_kept(module: str) -> bool | None:
    """Whether there is machine code of any function of a module; None: none would be kept."""
    folder = compiled_folder()
    if folder is None:
        return None
    return any((folder / module / stamp(module)[:16]).glob("*.nbi"))


class _Locator(_CacheLocator):
    """Machine code below the cache folder, by module and stamp."""

    def __init__(self, function: Callable[..., Any], folder: Path) -> None:
        self._module, self._folder = function.__module__, folder
        self._py_file = function.__code__.co_filename  # for a warning of numba

    def get_cache_path(self) -> str:
        return str(self._folder / self._module / stamp(self._module)[:16])

    def get_source_stamp(self) -> str:
        return stamp(self._module)

    def get_disambiguator(self) -> str:
        return ""

    @classmethod
    def from_function(cls, function: Callable[..., Any], file: str) -> _Locator | None:
        folder = compiled_folder()
        if folder is None:
            return None
        found = cls(function, folder)
        try:
            found.ensure_cache_path()
        except OSError:  # a cache that cannot be written only costs time
            return None
        return found


class _Implementation(CompileResultCacheImpl):
    _locator_classes = [_Locator]  # noqa: RUF012 - the name and type numba looks for


class _Sealed(IndexDataCacheFile):
    """Machine code that is believed only with the hash and the key it was written with.

    What is damaged would end the process, or compute something else; it is compiled again. So is
    what another process wrote to the same file for another key: two that read the index before
    either has written it choose one name.
    """

    def save(self, key: Any, data: Any) -> None:
        super().save(key, (key, data))

    def load(self, key: Any) -> Any:
        found = super().load(key)
        return found[1] if found is not None and found[0] == key else None

    def _dump(self, obj: Any) -> bytes:
        written = super()._dump(obj)
        return sha256(written).digest() + written

    def _load_index(self) -> dict[Any, str]:
        try:
            with open(self._index_path, "rb") as file:
                version = pickle.load(file)
                stamp, overloads = pickle.loads(_unsealed(file.read()))
        except Exception:  # whatever damaged bytes make of it
            return {}
        return overloads if (version, stamp) == (self._version, self._source_stamp) else {}

    def _load_data(self, name: str) -> Any:
        written = Path(self._data_path(name)).read_bytes()
        return pickle.loads(_unsealed(written))


def _unsealed(written: bytes) -> bytes:
    """What stands behind its hash; OSError, which numba takes for a miss, if it is another."""
    seal, rest = written[:32], written[32:]
    if sha256(rest).digest() != seal:
        raise OSError("not what was written")
    return rest


@cache
def _say_once() -> None:
    """Tell who watches, once in a process, what the first use of a function takes its time for."""
    if watched():
        print("Compiling for this machine; the next time this is quick.", file=sys.stderr)


class NoMachineCode(NullCache):
    """Where there is no folder to keep it in."""

    def load_overload(self, sig: Any, target_context: Any) -> None:
        _say_once()


class MachineCode(FunctionCache):
    """Machine code of one function; ``nested``: without what Python needs to call it.

    Raises
    ------
    RuntimeError
        There is no folder to keep it in.
    """

    _impl_class = _Implementation

    def __init__(self, function: Callable[..., Any], nested: bool) -> None:
        super().__init__(function)
        self._nested, place = nested, self._impl.locator
        self._cache_file = _Sealed(
            self._cache_path, self._impl.filename_base, place.get_source_stamp()
        )

    def save_overload(self, sig: Any, data: Any) -> None:
        try:
            super().save_overload(sig, data)
        except OSError:
            return  # a cache that cannot be written only costs time

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        found = super().load_overload(sig, target_context)
        if found is None:
            _say_once()
        return found

    def _index_key(self, sig: Any, codegen: Any) -> tuple[Any, ...]:
        _, *rest = super()._index_key(sig, codegen)
        arguments = tuple(map(_layout, getattr(sig, "args", sig)))
        return self._nested, arguments, *rest


def _layout(kind: Any) -> Any:
    """A type, but of a named tuple its name and fields: the class may change between two runs."""
    if not isinstance(kind, types.BaseTuple):
        return kind
    cls = getattr(kind, "instance_class", tuple)
    named = (cls.__module__, cls.__qualname__, getattr(cls, "_fields", ()))
    return *named, *map(_layout, getattr(kind, "types", ()))
