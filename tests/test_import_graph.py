"""The import graph, on small packages written for it."""

import ast
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path

import pytest

from dualarm_repro.sources import Graph

ROOT = Path(__file__).parents[1]

FILES = {
    "__init__.py": '"""Package."""\n',
    "ground.py": "VALUE = 1\n",
    "room/__init__.py": "from .inner import shown as offered\nfrom .other import unused\n",
    "room/inner.py": "from ..ground import VALUE\n\ndef shown():\n    return VALUE\n",
    "room/other.py": "unused = 0\n",
    "room/lazy.py": "def f():\n    from dualarm_repro.ground import VALUE\n    return VALUE\n",
    "user.py": "from .room import offered\n",
    "absolute.py": "import dualarm_repro.ground\nimport numpy.linalg\n",
    "dotted.py": "from . import ground\nfrom .room import lazy\n",
    "typed.py": "import typing\nif typing.TYPE_CHECKING:\n    from .ground import VALUE\n",
    "star.py": "from .ground import *\n",
}


@pytest.fixture
def folder(tmp_path):
    for name, text in FILES.items():
        path = tmp_path / "dualarm_repro" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return tmp_path / "dualarm_repro"


def reached(folder, name):
    found = Graph(folder).closure([f"dualarm_repro.{name}"])
    return {one.removeprefix("dualarm_repro.") for one in found} - {name}


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("user", {"room.inner", "ground"}),
        ("room.lazy", {"ground"}),
        ("absolute", {"ground"}),
        ("dotted", {"ground", "room.lazy"}),
        ("typed", set()),
        ("star", {"ground"}),
        ("ground", set()),
    ],
)
def test_closure(folder, name, expected):
    assert reached(folder, name) == expected


def test_external_names(folder):
    assert Graph(folder).external(["dualarm_repro.absolute"]) == ("numpy",)


@pytest.mark.parametrize(
    ("text", "same"),
    [
        ('"""New words."""\n\n# comment\nVALUE = 1  # more\n', True),
        ("VALUE = 2\n", False),
        ("VALUE = '# no comment'\n", False),
    ],
)
def test_what_counts_of_a_file(folder, text, same):
    before = Graph(folder).digest(["dualarm_repro.ground"])
    (folder / "ground.py").write_text(text)
    assert (Graph(folder).digest(["dualarm_repro.ground"]) == before) is same


def test_docstrings_of_functions_do_not_count(folder):
    path = folder / "room/inner.py"
    before = Graph(folder).digest(["dualarm_repro.room.inner"])
    path.write_text(path.read_text().replace("shown():\n", 'shown():\n    """Said."""\n'))
    after = Graph(folder)
    assert after.digest(["dualarm_repro.room.inner"]) == before
    assert after.module("dualarm_repro.room.inner").lines == {"shown": 3}


@pytest.mark.parametrize("text", ["", "[]", "{", '{"a": [1]}', '{"a": 1}'])
def test_a_damaged_index_only_costs_time(folder, tmp_path, text):
    index = tmp_path / "index.json"
    expected = Graph(folder, index).closure(["dualarm_repro.user"])
    index.write_text(text)
    assert Graph(folder, index).closure(["dualarm_repro.user"]) == expected


def test_the_index_is_keyed_by_content(folder, tmp_path):
    index = tmp_path / "index.json"
    before = Graph(folder, index)
    before.closure(["dualarm_repro.user"])
    path = folder / "room/inner.py"
    stat = path.stat()
    path.write_text(path.read_text().replace("return VALUE", "return 5 * 1"))
    import os

    os.utime(path, ns=(stat.st_atime_ns, stat.st_mtime_ns))
    name = ["dualarm_repro.room.inner"]
    assert Graph(folder, index).digest(name) != before.digest(name)


def test_two_processes_keep_what_both_have_parsed(folder, tmp_path, monkeypatch):
    index = tmp_path / "index.json"
    one, other = Graph(folder, index), Graph(folder, index)
    names = [name for name in one.files if not one.files[name].name.startswith("__")]
    one.module(names[0])
    other.module(names[1])
    one.save()
    other.save()
    monkeypatch.setattr("dualarm_repro.sources._parse", None)  # nothing is parsed again
    third = Graph(folder, index)
    assert third.module(names[0]) == one.module(names[0])
    assert third.module(names[1]) == other.module(names[1])


def test_the_text_that_counts_is_that_of_the_reading(folder):
    name, path = "dualarm_repro.room.inner", folder / "room/inner.py"
    before, read = Graph(folder).digest([name]), Graph(folder)
    read.read()
    path.write_text(path.read_text().replace("return VALUE", "return 5 * 1"))
    assert read.digest([name]) == before, "the process runs what it has read"
    assert Graph(folder).digest([name]) != before


@pytest.mark.parametrize("folder", ["benchmarks", "examples", "tools"])
def test_what_lies_beside_the_package_imports_what_is_there(folder):
    for path in (ROOT / folder).rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            module = node.module if isinstance(node, ast.ImportFrom) and not node.level else None
            if module and module.partition(".")[0] == "dualarm_repro":
                for alias in node.names:
                    found = import_module(module)
                    known = hasattr(found, alias.name) or find_spec(f"{module}.{alias.name}")
                    assert known, f"{path.name}: {module} has no {alias.name}"
