"""The import graph of the package: which of its modules the behaviour of a module depends on.

A module is followed to what it imports, wherever in the file the import stands; a name that a
package merely passes on is followed to the module that defines it. What counts of a module is its
code: docstrings, comments and empty lines change no digest; imports for type checkers are left out.
"""

from __future__ import annotations

import ast
import json
import os
import sys
from collections.abc import Callable, Iterable, Iterator
from functools import cache, cached_property
from hashlib import sha256
from io import StringIO
from pathlib import Path
from tokenize import COMMENT, generate_tokens
from typing import Any, NamedTuple

from .cache_folder import cache_folder

ROOT = "dualarm_repro"
_NO_MODULES: frozenset[str] = frozenset()


class Imported(NamedTuple):
    """``from module import name as alias``; ``name`` is empty for ``import module``."""

    module: str
    name: str
    alias: str


class Module(NamedTuple):
    """What the graph knows of one file."""

    digest: str
    imports: tuple[Imported, ...]
    external: tuple[str, ...]
    lines: dict[str, int]


class Graph:
    """The modules below one package folder.

    Source that is edited while a process runs is not what the process runs, so each file is read
    once.
    """

    def __init__(self, folder: Path, index: Path | None = None) -> None:
        self._folder, self._index_file = folder, index
        self._modules: dict[str, Module] = {}
        self._followed: dict[str, tuple[str, ...]] = {}
        self._index: dict[str, Any] = _read_index(index)
        self._read: dict[str, bytes] = {}
        self._new = False

    @cached_property
    def files(self) -> dict[str, Path]:
        """Every module of the package with its file."""
        found = {}
        for path in sorted(self._folder.rglob("*.py")):
            parts = [ROOT, *path.relative_to(self._folder).with_suffix("").parts]
            found[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
        return found

    def read(self) -> None:
        """Take the text of every module as it is now; it is parsed when it is asked for."""
        self._read = {name: path.read_bytes() for name, path in self.files.items()}

    def module(self, name: str) -> Module:
        """One module of the package."""
        if name not in self._modules:
            raw = self._read[name] if name in self._read else self.files[name].read_bytes()
            key = sha256(name.encode() + b"\0" + raw).hexdigest()
            kept = self._index.get(key)
            if kept is None:
                kept = _parse(name, self.files[name].name == "__init__.py", raw)
                self._index[key], self._new = kept, True
            digest, imports, external, lines = kept
            self._modules[name] = Module(
                digest, tuple(Imported(*entry) for entry in imports), tuple(external), lines
            )
        return self._modules[name]

    def defining(self, name: str, wanted: str) -> Iterator[str]:
        """Modules that ``from name import wanted`` depends on."""
        inner = f"{name}.{wanted}"
        if inner in self.files:
            yield inner
        elif name in self.files:
            if self.files[name].name == "__init__.py":
                for entry in self.module(name).imports:
                    if entry.alias == wanted and entry.name:
                        yield from self.defining(entry.module, entry.name)
                        return
            yield name

    def closure(
        self, roots: Iterable[str], cut: Callable[[str], bool] = _NO_MODULES.__contains__
    ) -> tuple[str, ...]:
        """Modules reached from ``roots``, which count whatever ``cut`` says; sorted.

        Parameters
        ----------
        cut
            Says which modules not to follow.
        """
        reached, waiting = set(), list(roots)
        while waiting:
            name = waiting.pop()
            if name in reached:
                continue
            reached.add(name)
            waiting += [one for one in self._imported(name) if one not in reached and not cut(one)]
        self.save()
        return tuple(sorted(reached))

    def _imported(self, name: str) -> tuple[str, ...]:
        """Modules of the package that a module depends on at once."""
        if name not in self._followed:
            found: list[str] = []
            for entry in self.module(name).imports:
                found += self.defining(entry.module, entry.name) if entry.name else [entry.module]
            self._followed[name] = tuple(dict.fromkeys(one for one in found if one in self.files))
        return self._followed[name]

    def digest(self, modules: Iterable[str]) -> str:
        """SHA-256 over names and code of modules."""
        text = "\n".join(f"{name} {self.module(name).digest}" for name in sorted(modules))
        return sha256(text.encode()).hexdigest()

    def external(self, modules: Iterable[str]) -> tuple[str, ...]:
        """Top-level names that these modules import from other distributions."""
        return tuple(sorted({name for one in modules for name in self.module(one).external}))

    def save(self) -> None:
        """Keep what was parsed for the next process; a cache that cannot be written costs time."""
        if not self._new or self._index_file is None:
            return
        self._new = False
        try:
            self._index = _read_index(self._index_file) | self._index  # what others have parsed
            self._index_file.parent.mkdir(parents=True, exist_ok=True)
            temporary = self._index_file.with_suffix(f".{os.getpid()}")
            temporary.write_text(json.dumps(self._index), encoding="utf-8")
            temporary.replace(self._index_file)
        except OSError:
            return


@cache
def graph() -> Graph:
    """The graph of this package, all of it read at once: as near as can be to what is running."""
    folder = cache_folder()
    found = Graph(Path(__file__).resolve().parent, folder / "sources.json" if folder else None)
    found.read()
    return found


def _read_index(path: Path | None) -> dict[str, Any]:
    try:
        found = json.loads(path.read_text(encoding="utf-8")) if path else {}
    except (OSError, ValueError):
        return {}
    well_formed = isinstance(found, dict) and all(
        isinstance(entry, list) and len(entry) == 4 for entry in found.values()
    )
    return found if well_formed else {}


def _parse(name: str, is_package: bool, raw: bytes) -> list[Any]:
    """Digest, imports, external names and lines of definitions of one file, as plain JSON."""
    tree = ast.parse(raw)
    lines = dict(_definitions(tree.body))
    imports: list[list[str]] = []
    external: set[str] = set()
    package = name.split(".") if is_package else name.split(".")[:-1]
    for node in _running(tree):
        for entry in _imports_of(node, package):
            if entry[0].split(".")[0] == ROOT:
                imports.append(entry)
            elif (top := entry[0].split(".")[0]) not in sys.stdlib_module_names:
                external.add(top)
    digest = sha256(_code(raw, tree).encode()).hexdigest()
    return [digest, imports, sorted(external), lines]


def _running(tree: ast.AST) -> Iterator[ast.AST]:
    """All nodes but those that only a type checker sees."""
    waiting = [tree]
    while waiting:
        for node in ast.iter_child_nodes(waiting.pop()):
            if isinstance(node, ast.If) and "TYPE_CHECKING" in ast.dump(node.test):
                continue
            yield node
            waiting.append(node)


def _imports_of(node: ast.AST, package: list[str]) -> Iterator[list[str]]:
    if isinstance(node, ast.Import):
        for alias in node.names:
            yield [alias.name, "", alias.asname or alias.name]
    elif isinstance(node, ast.ImportFrom):
        base = package[: len(package) - node.level + 1] if node.level else []
        module = ".".join([*base, *([node.module] if node.module else [])])
        for alias in node.names:
            yield [module, "" if alias.name == "*" else alias.name, alias.asname or alias.name]


def _definitions(body: list[ast.stmt], prefix: str = "") -> Iterator[tuple[str, int]]:
    for node in body:
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            yield f"{prefix}{node.name}", node.lineno
            inner = ".<locals>." if isinstance(node, ast.FunctionDef) else "."
            yield from _definitions(node.body, f"{prefix}{node.name}{inner}")


def _code(raw: bytes, tree: ast.AST) -> str:
    """The text without docstrings, comments and empty lines: the same for every version of Python,
    which a dump of the syntax tree is not."""
    lines = raw.decode("utf-8").splitlines()
    text = "\n".join(lines) + "\n"
    for token in generate_tokens(StringIO(text).readline) if "#" in text else ():
        if token.type == COMMENT:
            row, column = token.start
            lines[row - 1] = lines[row - 1][:column]
    for node in ast.walk(tree):
        body = getattr(node, "body", None)
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef) and body:
            first = body[0]
            if isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant):
                for row in range(first.lineno, (first.end_lineno or first.lineno) + 1):
                    lines[row - 1] = ""
    return "\n".join(kept for line in lines if (kept := line.rstrip()))
