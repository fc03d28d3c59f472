"""Which inputs a computation opened: recorded while it runs, also where a memo answers for it."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from functools import _make_key, wraps
from threading import RLock
from typing import Any, ParamSpec, TypeVar
from weakref import WeakKeyDictionary, WeakSet

P = ParamSpec("P")
T = TypeVar("T")
Owner = TypeVar("Owner")
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


@contextmanager
def unnoted() -> Iterator[None]:
    """Read without noting: for what is read whole and noted by the parts that are used."""
    token = _OPEN.set(())
    try:
        yield
    finally:
        _OPEN.reset(token)


def touches(name: str, changed: str) -> bool:
    """Whether a change of one input changes another: one is, or is a part of, the other."""
    return name == changed or _within(name, changed) or _within(changed, name)


def _within(part: str, whole: str) -> bool:
    return part.startswith((f"{whole}.", f"{whole}#"))


class Memo:
    """Answers of one function by its arguments, each with the inputs it was computed from."""

    def __init__(self, maxsize: int | None) -> None:
        self._maxsize = maxsize
        self._kept: OrderedDict[Any, tuple[Any, frozenset[str]]] = OrderedDict()
        self._lock = RLock()

    def get(self, key: Any) -> tuple[Any, frozenset[str]] | None:
        """The answer that is kept for these arguments."""
        with self._lock:
            found = self._kept.get(key)
            if found is not None:
                self._kept.move_to_end(key)
            return found

    def keep(self, key: Any, value: Any, inputs: frozenset[str]) -> None:
        """Keep an answer; the one that was asked for longest ago makes room."""
        with self._lock:
            self._kept[key] = (value, inputs)
            if self._maxsize is not None and len(self._kept) > self._maxsize:
                self._kept.popitem(last=False)

    def forget(self, changed: str | None = None) -> None:
        """Drop every answer, or those that were computed from an input that changed."""
        with self._lock:
            for key, (_, inputs) in list(self._kept.items()):
                if changed is None or any(touches(name, changed) for name in inputs):
                    del self._kept[key]


_MEMOS: WeakSet[Memo] = WeakSet()


def forget(changed: str | None = None) -> None:
    """Let no memo of the process answer with what it computed from an input that changed.

    Parameters
    ----------
    changed
        Name of the input as in :func:`note`; without it, every answer is forgotten.
    """
    for one in list(_MEMOS):
        one.forget(changed)


def memo(maxsize: int | None = None) -> Callable[[Callable[P, T]], Callable[P, T]]:
    """Decorator: as ``functools.lru_cache``, but an answer from memory notes its inputs as well.

    With a plain cache only the first of several results that use a robot would depend on its file.
    An answer is dropped when an input of it changes, see :func:`forget`.
    """

    def decorate(function: Callable[P, T]) -> Callable[P, T]:
        kept = Memo(maxsize)
        _MEMOS.add(kept)

        @wraps(function)
        def answer(*args: P.args, **options: P.kwargs) -> T:
            key = _make_key(args, options, False)
            found = kept.get(key)
            if found is None:
                with recording() as inputs:
                    value = function(*args, **options)
                kept.keep(key, value, frozenset(inputs))
                return value
            note(*found[1])
            again: T = found[0]
            return again

        answer.cache_clear = kept.forget  # type: ignore[attr-defined]
        return answer

    return decorate


def kept_with_owner(function: Callable[[Owner], T]) -> Callable[[Owner], T]:
    """Decorator: the answer for an object is kept as long as the object lives, and no longer.

    ``functools.lru_cache`` would keep the object alive, meshes and all. The answer must not refer
    to it.
    """
    kept: WeakKeyDictionary[Any, T] = WeakKeyDictionary()

    @wraps(function)
    def answer(*owner: Any, **named: Any) -> T:
        (key,) = (*owner, *named.values())
        try:
            return kept[key]
        except KeyError:
            value = kept[key] = function(*owner, **named)
            return value

    return answer
