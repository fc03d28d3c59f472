"""Which inputs a computation opened: recorded while it runs, also where a memo answers for it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from functools import lru_cache, wraps
from typing import Any, ParamSpec, TypeVar

P, T = ParamSpec("P"), TypeVar("T")
_OPEN: ContextVar[tuple[set[str], ...]] = ContextVar("open recordings", default=())


def note(*names: str) -> None:
    """Say that inputs of these names were read, to every recording under way.

    A name is a file relative to the data folder, or ``file#field.path`` for a part of one.
    """
    for found in _OPEN.get():
        found.update(names)


@contextmanager
def recording() -> Iterator[set[str]]:
    """Record the names of the inputs that are read while the context lasts."""
    found: set[str] = set()
    token = _OPEN.set((*_OPEN.get(), found))
    try:
        yield found
    finally:
        _OPEN.reset(token)


def memo(maxsize: int | None = None) -> Callable[[Callable[P, T]], Callable[P, T]]:
    """Decorator: as ``functools.lru_cache``, but an answer from memory notes its inputs as well.

    With a plain cache only the first of several results that use a robot would depend on its file.
    """

    def decorate(function: Callable[P, T]) -> Callable[P, T]:
        @lru_cache(maxsize)
        def kept(*args: Any, **options: Any) -> tuple[T, Iterable[str]]:
            with recording() as found:
                value = function(*args, **options)
            return value, tuple(found)

        @wraps(function)
        def answer(*args: P.args, **options: P.kwargs) -> T:
            value, found = kept(*args, **options)
            note(*found)
            return value

        answer.cache_clear = kept.cache_clear  # type: ignore[attr-defined]
        return answer

    return decorate
