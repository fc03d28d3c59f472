"""What a computed value depends on: code, inputs and versions, found and never listed by hand.

Code is the import closure of the modules that compute it; inputs are the data files, or parts of
them, that were opened while it was computed; versions are those of the distributions that this code
can reach.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cache, partial
from hashlib import sha256
from inspect import getsourcefile
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..datafiles import data_path
from ..sources import ROOT, graph
from .versions import versions

if TYPE_CHECKING:
    from .registry import Registry

#: Rooms that never change a value: they draw it, or keep and carry it. Modules of the ledger that
#: compute are named below.
_CARRIERS = (f"{ROOT}.view", f"{ROOT}.ledger")
_COMPUTING = frozenset(
    f"{ROOT}.ledger.{name}"
    for name in (
        "assumptions",
        "formula",
        "printed",
        "printed_values",
        "rules",
        "shares",
        "statistical_rules",
        "streams",
        "verdict",
        "witnesses",
    )
)
_BOOKKEEPING = frozenset(
    f"{ROOT}.{name}"
    for name in (
        "sources",
        "cache_folder",
        "tracking",
        "machine_code",
        "interruption",
        "terminal",
    )
)


def carries(module: str) -> bool:
    """Whether a module only keeps, passes on or draws values."""
    if module in _COMPUTING:
        return False
    return module in _BOOKKEEPING or module.startswith(_CARRIERS)


def keeps_books(module: str) -> bool:
    """Whether a module only finds, hashes or keeps files, or tells of it."""
    return module in _BOOKKEEPING


@dataclass(frozen=True)
class Closure:
    """The code that a value depends on.

    Attributes
    ----------
    modules
        Of the package, sorted.
    digest
        SHA-256 over their code.
    versions
        Versions of the distributions they can reach.
    """

    modules: tuple[str, ...]
    digest: str
    versions: Mapping[str, str]


def closure(
    functions: Iterable[Callable[..., Any]], also: Iterable[str] = (), *, drawn: bool = False
) -> Closure:
    """The closure of functions, and of further modules of the package.

    Parameters
    ----------
    drawn
        Whether the code that draws counts as well.
    """
    found = {module_of(function) for function in functions} | set(also)
    return closure_of_modules(tuple(sorted(found)), drawn)


@cache
def closure_of_modules(roots: tuple[str, ...], drawn: bool = False) -> Closure:
    """The same, of modules by name; files outside the package by their path, for themselves."""
    inside = [name for name in roots if name in graph().files]
    outside = [Path(name) for name in roots if name not in graph().files]
    modules = graph().closure(inside, keeps_books if drawn else carries)
    texts = [graph().digest(modules), *(hash_file(path) for path in outside)]
    digest = texts[0] if len(texts) == 1 else sha256(" ".join(texts).encode()).hexdigest()
    return Closure(modules, digest, versions(graph().external(modules)))


def module_of(function: Callable[..., Any]) -> str:
    """The module that defines a function; for one outside the package, its file."""
    while isinstance(function, partial):
        function = function.func
    if function.__module__ in graph().files:
        return function.__module__
    return str(getsourcefile(function) or function.__module__)


def hash_file(path: Path) -> str:
    """SHA-256 of a file; ``absent`` where there is none."""
    try:
        return sha256(path.read_bytes()).hexdigest()
    except OSError:
        return "absent"


def hash_inputs(registry: Registry, names: Iterable[str]) -> dict[str, str]:
    """SHA-256 of inputs as they are now: files of the data folder, templates of the package, or
    parts of a document."""
    return {name: _hash_input(registry, name) for name in sorted(names)}


def _hash_input(registry: Registry, name: str) -> str:
    if name.startswith(f"{ROOT}/"):
        return hash_file(Path(__file__).resolve().parents[2] / name)
    if "#" not in name:
        return hash_file(data_path(*Path(name).parts))
    return registry.part_digest(name)
