"""Write the figures of what was tried against the project into ``tests/README.md``.

They come from ``data/results`` and from the tests themselves, and none is typed;
``data/results/tried.json`` holds them for the page of the book.
"""

from __future__ import annotations

import argparse
import ast
import json
import sys
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from dualarm_repro.ledger.files import to_json, write_text
from dualarm_repro.view.tried import HEAD

ROOT = Path(__file__).resolve().parents[1]
RESULTS = ROOT / "data" / "results"
PAGE = ROOT / "tests" / "README.md"
TRIED = RESULTS / "tried.json"
BEGIN, END = "<!-- figures: tools/trust_figures.py -->", "<!-- end of the figures -->"
#: Examples of a property that asks for no other number, hypothesis' own choice.
EXAMPLES = 100
ABSENT = "not stored yet"


def properties(folder: Path) -> tuple[int, int]:
    """Number of properties that hypothesis tests, and of their examples."""
    counts = [
        _examples(node)
        for path in sorted(folder.rglob("*.py"))
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.FunctionDef) and "given" in map(_called, node.decorator_list)
    ]
    return len(counts), sum(counts)


def _called(node: ast.expr) -> str:
    function = node.func if isinstance(node, ast.Call) else node
    return function.attr if isinstance(function, ast.Attribute) else getattr(function, "id", "")


def _examples(function: ast.FunctionDef) -> int:
    for decorator in function.decorator_list:
        for keyword in getattr(decorator, "keywords", ()):
            if keyword.arg == "max_examples" and isinstance(keyword.value, ast.Constant):
                return int(str(keyword.value.value))
    return EXAMPLES


def _stored(results: Path, name: str) -> Any:
    path = results / f"{name}.json"
    return json.loads(path.read_text(encoding="utf-8")) if path.is_file() else None


def rows(results: Path, tests: Path) -> Iterator[tuple[str, str, str]]:
    """What was tried, how often, and how it ended."""
    count, examples = properties(tests)
    yield "properties (hypothesis)", f"{count} with {examples} examples", "each holds"
    fuzz = _stored(results, "fuzz")
    if fuzz is None:
        yield "hostile inputs", ABSENT, ""
    else:
        kinds = ", ".join(f"{number} {kind}" for kind, number in sorted(fuzz["cases"].items()))
        yield "hostile inputs", str(sum(fuzz["cases"].values())), kinds
    faults = _stored(results, "faults")
    if faults is None:
        yield "faults", ABSENT, ""
    for kind, found in (faults or {"counts": {}})["counts"].items():
        yield f"faults: {kind}", str(found["tried"]), f"{found['survived']} survived"
    again = _stored(results, "determinism")
    if again is None:
        yield "computed again in other circumstances", ABSENT, ""
    for name, found in (again or {"counts": {}})["counts"].items():
        number = f"{found['items']} items, {found['cells']} cells of studies"
        yield f"computed again: {name}", number, f"{found['otherwise']} otherwise"
    ledger = _stored(results, "trust")
    for name, found in (ledger or {"counts": {}})["counts"].items():
        yield (
            f"changes of what is {name}" if name != "method" else "mutants of the methods",
            str(found["tried"]),
            f"{found['killed']} noticed",
        )
    matrix = _stored(results, "install_matrix")
    if matrix is not None:
        ends = ", ".join(f"{number} {end}" for end, number in matrix["counts"].items())
        yield "installations of the wheel", str(len(matrix["rows"])), ends
    coverage = _stored(results, "coverage")
    if coverage is None:
        yield "branches of the library", ABSENT, ""
    else:
        share = coverage["reached"] / coverage["branches"]
        yield "branches of the library", str(coverage["branches"]), f"{share:.1%} reached"


def figures(found: Iterable[tuple[str, str, str]]) -> str:
    """The table of `rows` in Markdown."""
    head, *lines = [f"| {' | '.join(row)} |" for row in (HEAD, *found)]
    return "\n".join([head, f"|{'---|' * len(HEAD)}", *lines])


def with_figures(text: str, table: str) -> str:
    """A page whose part between the marks is the table.

    Raises
    ------
    ValueError
        A mark is missing.
    """
    before, begin, rest = text.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not begin or not end:
        raise ValueError(f"{BEGIN} and {END} are not both there")
    return f"{before}{BEGIN}\n\n{table}\n\n{END}{after}"


def main(arguments: list[str] | None = None) -> int:
    """Write the figures; with ``--check``, 1 if the page does not show them."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--check", action="store_true", help="write nothing")
    asked = parser.parse_args(arguments)
    before, found = PAGE.read_text(encoding="utf-8"), list(rows(RESULTS, PAGE.parent))
    after, stored = with_figures(before, figures(found)), to_json({"rows": found})
    if asked.check:
        same = TRIED.is_file() and TRIED.read_text(encoding="utf-8") == stored
        return int(before != after or not same)
    write_text(PAGE, after)
    write_text(TRIED, stored)
    return 0


if __name__ == "__main__":
    sys.exit(main())
