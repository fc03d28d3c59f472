"""Mutants of a method: one number or one operator of its source, exchanged in a single place.

An integer n becomes n + 1, a number x becomes 2 x (1000 x below 1e-3), a comparison its opposite,
and + and -, * and / change places.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence
from io import StringIO
from pathlib import Path
from tokenize import generate_tokens
from typing import Any, NamedTuple

import numpy as np

_OPERATORS: dict[type[ast.AST], tuple[str, str]] = {
    ast.Add: ("+", "-"),
    ast.Sub: ("-", "+"),
    ast.Mult: ("*", "/"),
    ast.Div: ("/", "*"),
    ast.Lt: ("<", ">="),
    ast.LtE: ("<=", ">"),
    ast.Gt: (">", "<="),
    ast.GtE: (">=", "<"),
    ast.Eq: ("==", "!="),
    ast.NotEq: ("!=", "=="),
}
#: Below it a number is a tolerance, which is only felt when it grows a thousandfold.
_TOLERANCE = 1e-3
#: What no value depends on: error texts and what is only there for readers and type checkers.
_SILENT = (ast.Raise, ast.JoinedStr, ast.Import, ast.ImportFrom)

Place = tuple[int, int]


class Mutant(NamedTuple):
    """One token of one file, and what takes its place; lines count from 1, columns from 0."""

    file: str
    line: int
    column: int
    old: str
    new: str
    text: str

    def applied(self, source: str) -> str:
        """The source with the token exchanged."""
        lines = source.splitlines(keepends=True)
        row = lines[self.line - 1]
        lines[self.line - 1] = row[: self.column] + self.new + row[self.column + len(self.old) :]
        return "".join(lines)

    @property
    def where(self) -> str:
        """``file:line``, for the reader."""
        return f"{self.file}:{self.line}"


def mutants(root: Path, file: str) -> list[Mutant]:
    """Every mutant of one file, in the order of the text."""
    source = (root / file).read_text(encoding="utf-8")
    lines = source.splitlines()
    tokens = {t.start: t.string for t in generate_tokens(StringIO(source).readline) if t.string}
    operators = [(place, text) for place, text in tokens.items() if _is_operator(text)]
    found = set()
    for node in _live(ast.parse(source)):
        if isinstance(node, ast.Constant):
            place = _characters(lines, node.lineno, node.col_offset)
            if place in tokens and (new := _other_number(node.value)):
                found.add((place, tokens[place], new))
        for kind, left, right in _pairs(node):
            if kind in _OPERATORS:
                old, new = _OPERATORS[kind]
                start = _characters(lines, left.end_lineno, left.end_col_offset)
                end = _characters(lines, right.lineno, right.col_offset)
                at = [p for p, text in operators if start <= p < end and text == old]
                found |= {(p, old, new) for p in at[:1]}
    return [
        Mutant(file, line, column, old, new, lines[line - 1].strip())
        for (line, column), old, new in sorted(found)
    ]


def sample(root: Path, folders: Sequence[str], count: int, seed: int) -> list[Mutant]:
    """So many mutants of every folder, drawn with ``seed``; the same for the same sources."""
    drawn: list[Mutant] = []
    for number, folder in enumerate(folders):
        files = sorted(path.relative_to(root).as_posix() for path in (root / folder).rglob("*.py"))
        known = [mutant for file in files for mutant in mutants(root, file)]
        rng = np.random.default_rng([seed, number])
        chosen = rng.choice(len(known), min(count, len(known)), replace=False)
        drawn += [known[k] for k in sorted(chosen)]
    return drawn


def _is_operator(text: str) -> bool:
    return any(text == old for old, _ in _OPERATORS.values())


def _live(node: ast.AST) -> Iterator[ast.AST]:
    """The nodes that a value can depend on, without the whole numbers that index an array."""
    for name, value in ast.iter_fields(node):
        if name in ("annotation", "returns", "decorator_list"):
            continue
        for part in value if isinstance(value, list) else [value]:
            if not isinstance(part, ast.AST) or isinstance(part, _SILENT):
                continue
            if isinstance(part, ast.Constant) and _indexes(node, name):
                continue
            if name == "slice":
                part.indexes = isinstance(part, ast.Tuple)  # type: ignore[attr-defined]
            if name == "test" and "TYPE_CHECKING" in ast.dump(part):
                continue
            yield part
            yield from _live(part)


def _indexes(node: ast.AST, field: str) -> bool:
    return field == "slice" or isinstance(node, ast.Slice) or getattr(node, "indexes", False)


def _pairs(node: ast.AST) -> Iterator[tuple[type[ast.AST], ast.expr, ast.expr]]:
    """The operators of a node, each between two operands; texts are not added."""
    if isinstance(node, ast.BinOp):
        operands = (node.left, node.right)
        if not any(isinstance(one, ast.JoinedStr | ast.List | ast.Tuple) for one in operands):
            if not any(isinstance(getattr(one, "value", None), str) for one in operands):
                yield type(node.op), *operands
    elif isinstance(node, ast.Compare):
        sides = [node.left, *node.comparators]
        for operator, left, right in zip(node.ops, sides, sides[1:], strict=False):
            yield type(operator), left, right


def _other_number(value: Any) -> str | None:
    if isinstance(value, bool) or not isinstance(value, int | float):
        return None
    if isinstance(value, int):
        return str(value + 1)
    if value == 0.0:
        return "0.01"
    return repr(value * (2.0 if abs(value) >= _TOLERANCE else 1000.0))


def _characters(lines: list[str], line: int | None, column: int | None) -> Place:
    """A place in characters; a syntax tree counts bytes."""
    line = line or 1  # only what was not parsed has no place
    return line, len(lines[line - 1].encode()[:column].decode())
