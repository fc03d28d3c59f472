"""The house rules that a machine can check: floors, file length, docstrings, names."""

import ast
import re
from pathlib import Path

import pytest

PACKAGE = Path(__file__).parents[1] / "dualarm_repro"
FILES = sorted(PACKAGE.rglob("*.py"))
#: Floors from the ground up. An import goes down, or stays within its own room.
FLOORS = (
    (
        "errors",
        "tracking",
        "cache_folder",
        "sources",
        "datafiles",
        "settings",
        "kernel",
        "differences",
    ),
    ("ledger",),
    ("arms",),
    ("scene",),
    ("planning", "control", "welding"),
    ("view",),
    ("papers",),
    ("cli",),
)
FLOOR = {room: floor for floor, rooms in enumerate(FLOORS) for room in rooms}
#: The view draws what the ledger, arms, scenes and methods give; the methods know no ledger.
FORBIDDEN = {
    ("arms", "ledger"),
    ("scene", "ledger"),
    ("planning", "ledger"),
    ("control", "ledger"),
    ("welding", "ledger"),
}


def _room(path: Path) -> str:
    return path.relative_to(PACKAGE).parts[0].removesuffix(".py")


def _imports(path: Path) -> set[str]:
    """Rooms that a file imports from, relative imports resolved."""
    package = ("dualarm_repro", *path.relative_to(PACKAGE).parts[:-1])
    rooms = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom):
            base = package[: len(package) - node.level + 1] if node.level else ()
            full = (*base, *(node.module.split(".") if node.module else ()))
            names = [full] if len(full) > 1 else [(*full, alias.name) for alias in node.names]
            rooms |= {name[1] for name in names if name[:1] == ("dualarm_repro",) and len(name) > 1}
        elif isinstance(node, ast.Import):
            rooms |= {
                alias.name.split(".")[1]
                for alias in node.names
                if alias.name.startswith("dualarm_repro.")
            }
    return rooms


@pytest.mark.parametrize("path", FILES, ids=lambda p: str(p.relative_to(PACKAGE)))
def test_file(path):
    text = path.read_text(encoding="utf-8")
    tree = ast.parse(text)
    assert len(text.splitlines()) <= 400
    assert ast.get_docstring(tree), "a module says what its one concept is"
    assert path.stem not in {"utils", "helpers", "manager", "misc", "common"}
    for node in ast.walk(tree):
        assert not isinstance(node, ast.Assert), "input errors are raised, not asserted"
        public = isinstance(node, ast.FunctionDef | ast.ClassDef) and not node.name.startswith("_")
        if public and node in tree.body:
            assert ast.get_docstring(node), f"{node.name} has no docstring"
    room = _room(path)
    if room == "__init__":
        return
    for other in _imports(path) - {room, "__version__"}:
        assert FLOOR[other] <= FLOOR[room], f"{room} imports {other}, which is above it"
        assert other in FLOORS[0] or FLOOR[other] < FLOOR[room], f"{room} imports its peer {other}"
        assert (room, other) not in FORBIDDEN


def _code(path: Path) -> str:
    return path.read_text(encoding="utf-8")


def test_documents_cache_with_memo_and_read_no_docstrings():
    """A plain cache would hide which files were opened; a docstring is no datum."""
    for path in (PACKAGE / "papers").rglob("*.py"):
        assert not re.search(r"\b(lru_cache|cached_property|functools\.cache)\b", _code(path)), path
        assert not re.search(r"^from functools import .*\bcache\b", _code(path), re.M), path
        assert "__doc__" not in _code(path), path


def test_documents_do_not_read_whole_items():
    """What a computation reads of the ledger is noted by the part it needs."""
    for path in (PACKAGE / "papers").rglob("*.py"):
        assert not re.search(r"REGISTRY\.(item|items|paper|papers|errata)\b", _code(path)), path


def test_kernels_are_compiled_in_one_way():
    for path in FILES:
        if path.name != "kernel.py":
            assert not re.search(r"\bnjit\b", _code(path)), path


def _unannotated(function: ast.FunctionDef) -> list[str]:
    """Arguments without a type, and ``return``; none of a kernel, whose types numba infers."""
    if any(isinstance(name, ast.Name) and name.id == "kernel" for name in function.decorator_list):
        return []
    given = function.args
    named = [*given.posonlyargs, *given.args, *given.kwonlyargs, given.vararg, given.kwarg]
    missing = [one.arg for one in named if one is not None and one.annotation is None]
    missing += [] if function.returns else ["return"]
    return [name for name in missing if name not in ("self", "cls")]


@pytest.mark.parametrize(
    "path", [p for p in FILES if _room(p) != "papers"], ids=lambda p: str(p.relative_to(PACKAGE))
)
def test_functions_are_annotated_unless_they_are_kernels(path):
    for node in ast.walk(ast.parse(_code(path))):
        if isinstance(node, ast.FunctionDef):
            assert not _unannotated(node), f"{node.name}, line {node.lineno}"


def test_papers_do_not_import_each_other():
    papers = [path for path in FILES if _room(path) == "papers" and len(path.parts) > 2]
    names = {p.name for p in (PACKAGE / "papers").iterdir() if p.is_dir()}
    for path in papers:
        own = path.relative_to(PACKAGE).parts[1]
        if own not in names:
            continue
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ImportFrom) and node.level == 2 and node.module:
                assert node.module.split(".")[0] not in names - {own}


def test_book_touches_only_the_upper_rooms():
    for page in (PACKAGE.parent / "book").rglob("*.md"):
        allowed = {"papers", "ledger", "view", "arms", "scene"}
        if page.stem == "use_your_arm":  # which shows how to call the methods
            allowed |= {"planning", "control", "datafiles"}
        text = page.read_text(encoding="utf-8")
        for cell in re.findall(r"^```\{code-cell\}(.*?)^```", text, re.DOTALL | re.MULTILINE):
            for room in re.findall(r"^from dualarm_repro\.(\w+)", cell, re.MULTILINE):
                assert room in allowed, f"{page.name}: {room}"
