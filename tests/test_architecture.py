"""The house rules that a machine can check: floors, file length, docstrings, names."""

import ast
import re
from pathlib import Path
from statistics import median

import pytest

from dualarm_repro.ledger.closure import module_of

PACKAGE = Path(__file__).parents[1] / "dualarm_repro"
FILES = sorted(PACKAGE.rglob("*.py"))
#: Floors from the ground up. An import goes down, or stays within its own room.
FLOORS = (
    (
        "errors",
        "tracking",
        "cache_folder",
        "sources",
        "input_files",
        "datafiles",
        "written",
        "settings",
        "annotation",
        "arguments",
        "interruption",
        "machine_code",
        "kernel",
        "copies",
        "differences",
        "instrument",
        "quiet_import",
        "terminal",
    ),
    ("ledger",),
    ("arms",),
    ("scene",),
    ("planning", "control", "welding"),
    ("baselines",),
    ("view",),
    ("papers",),
    ("arena", "new_document"),
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
    ("baselines", "ledger"),
}


#: Rooms of the documents.
DOCUMENTS = sorted(p.name for p in (PACKAGE / "papers").iterdir() if (p / "__init__.py").is_file())


def _room(path: Path) -> str:
    return path.relative_to(PACKAGE).parts[0].removesuffix(".py")


def imported(text: str, package: str) -> set[str]:
    """Dotted names that the source of a module in ``package`` imports, relative ones resolved.

    ``from a import b`` gives ``a.b``, whether ``b`` is a module or a name in one.
    """
    found = set()
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            parts = package.split(".")
            base = parts[: len(parts) - node.level + 1] if node.level else []
            base += node.module.split(".") if node.module else []
            found |= {".".join((*base, alias.name)) for alias in node.names}
    return found


def _imports(path: Path) -> set[str]:
    """The same of a file of the package."""
    package = ".".join(path.relative_to(PACKAGE.parent).parts[:-1])
    return imported(path.read_text(encoding="utf-8"), package)


def _below(names: set[str], package: str) -> set[str]:
    """First parts of the names that lie below ``package``."""
    prefix = f"{package}."
    return {n.removeprefix(prefix).partition(".")[0] for n in names if n.startswith(prefix)}


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("from .. import qiu", "dualarm_repro.papers.qiu"),
        ("from .. import pan, qiu as other", "dualarm_repro.papers.qiu"),
        ("from ..qiu import field", "dualarm_repro.papers.qiu.field"),
        ("from ..qiu.pages.field import draw", "dualarm_repro.papers.qiu.pages.field.draw"),
        ("from ...papers import qiu", "dualarm_repro.papers.qiu"),
        ("from ...papers.qiu import field", "dualarm_repro.papers.qiu.field"),
        ("from dualarm_repro.papers import qiu", "dualarm_repro.papers.qiu"),
        ("from dualarm_repro.papers.qiu import field", "dualarm_repro.papers.qiu.field"),
        ("import dualarm_repro.papers.qiu.field as f", "dualarm_repro.papers.qiu.field"),
        ("def f():\n    from .. import qiu", "dualarm_repro.papers.qiu"),
        ("from . import field", "dualarm_repro.papers.xue.field"),
        ("from ...arms import Arm", "dualarm_repro.arms.Arm"),
    ],
)
def test_imports_are_resolved(text, name):
    assert name in imported(text, "dualarm_repro.papers.xue")


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
    for other in _below(_imports(path), "dualarm_repro") - {room, "__version__"}:
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


@pytest.mark.parametrize("document", DOCUMENTS)
def test_papers_do_not_import_each_other(document):
    others = set(DOCUMENTS) - {document}
    for path in (PACKAGE / "papers" / document).rglob("*.py"):
        assert not _below(_imports(path), "dualarm_repro.papers") & others, path


def _shown(page: Path) -> set[str]:
    """Items that the cells of a page of the book show."""
    calls = re.findall(r"^show\(([^)]*)\)", page.read_text(encoding="utf-8"), re.MULTILINE)
    return set(re.findall(r'"([\w.]+)"', " ".join(calls)))


@pytest.mark.parametrize("document", DOCUMENTS)
def test_a_document_has_one_file_for_each_page_of_its_book(document, registry):
    """The checker of an item lies in the file, or the folder, named as the page that shows it."""
    book, room = PACKAGE.parent / "book" / document, PACKAGE / "papers" / document / "pages"
    pages = {page.stem for page in book.glob("*.md") if page.stem != "index" and _shown(page)}
    files = {path.stem for path in room.glob("*.py")} - {"__init__"}
    folders = {path.parent.name for path in room.glob("*/__init__.py")}
    assert not files & folders
    assert files | folders == pages
    for item_id, checker in registry.checkers.items():
        if item_id.startswith(f"{document}."):
            assert item_id in _shown(book.parent / f"{checker.page}.md")
            home = f"dualarm_repro.papers.{document}.pages.{checker.page.split('/')[1]}"
            module = module_of(checker.compute)
            assert f"{module}.".startswith(f"{home}."), (
                f"{item_id} of {checker.page} is in {module}"
            )


def test_the_documents_are_the_smaller_part_and_files_are_short():
    lines = {path: len(path.read_text(encoding="utf-8").splitlines()) for path in FILES}
    papers = sum(count for path, count in lines.items() if _room(path) == "papers")
    assert papers <= 0.36 * sum(lines.values())
    assert max(lines.values()) <= 400
    assert median(lines.values()) <= 110


#: Decorators of functions that numba compiles.
_KERNELS = {"kernel", "inlined"}


def _unannotated(function: ast.FunctionDef) -> list[str]:
    """Arguments without a type, and ``return``; none of a kernel, whose types numba infers."""
    if any(isinstance(name, ast.Name) and name.id in _KERNELS for name in function.decorator_list):
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


def test_book_touches_only_the_upper_rooms():
    for page in (PACKAGE.parent / "book").rglob("*.md"):
        allowed = {"papers", "ledger", "view", "arms", "scene"}
        if page.stem == "use_your_arm" or page.parent.name in DOCUMENTS:  # which run the methods
            allowed |= {"planning", "control", "welding", "datafiles", "differences", "settings"}
        if page.stem == "arena":
            allowed |= {"arena", "baselines", "planning"}
        if page.parent.name == "recipes":
            allowed |= {"baselines", "planning", "welding"}
        text = page.read_text(encoding="utf-8")
        for cell in re.findall(r"^```\{code-cell\}(.*?)^```", text, re.DOTALL | re.MULTILINE):
            for room in re.findall(r"^from dualarm_repro\.(\w+)", cell, re.MULTILINE):
                assert room in allowed, f"{page.name}: {room}"
