"""A replay that leant on the library would agree with it whatever it says."""

import ast
import sys
from pathlib import Path

import pytest

HERE = Path(__file__).parent
SOURCES = sorted(HERE.glob("*.py"))
#: numpy computes; yaml reads the capsules of an arm, which no export holds.
ALLOWED = {"numpy", "pytest", "yaml", *sys.stdlib_module_names}


def imported(text):
    """First names of all modules that a source imports."""
    for node in ast.walk(ast.parse(text)):
        names = [entry.name for entry in node.names] if isinstance(node, ast.Import) else []
        names += [node.module or "."] if isinstance(node, ast.ImportFrom) else []
        yield from (name.partition(".")[0] for name in names)


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: path.stem)
def test_nothing_of_the_library_is_imported(path):
    own = {source.stem for source in SOURCES}
    text = path.read_text(encoding="utf-8")
    assert set(imported(text)) <= ALLOWED | own
    assert "import" + "lib" not in text


def test_an_import_of_the_library_is_seen():
    assert set(imported("def f():\n    from dualarm_repro.scene import Scene")) == {"dualarm_repro"}
