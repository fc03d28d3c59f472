"""Every example runs, says numbers, is short, and uses only what the rooms export."""

import ast
import importlib
import re
import subprocess
import sys
from pathlib import Path

import pytest
from long_tests import long_where

ROOT = Path(__file__).parents[2]
EXAMPLES = sorted((ROOT / "examples").glob("*.py"))
ROOMS = {"arms", "scene", "planning", "control", "welding", "ledger"}


#: These take seconds.
LONG = ("load_arm", "sweep_on_cluster", "follow_paths", "add_planner")


@pytest.mark.parametrize("name", long_where(LONG.__contains__, [one.stem for one in EXAMPLES]))
def test_example_runs(name, tmp_path):
    """In a folder that is not its own, where it leaves nothing."""
    path = ROOT / "examples" / f"{name}.py"
    run = subprocess.run(
        [sys.executable, str(path)], cwd=tmp_path, capture_output=True, text=True, timeout=300
    )
    assert run.returncode == 0, run.stderr
    assert len(re.findall(r"\d+(?:\.\d+)?", run.stdout)) >= 4
    assert "nan" not in run.stdout
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_example_is_short_and_uses_exports_alone(path):
    text = path.read_text(encoding="utf-8")
    tree = ast.parse(text)
    assert len(text.splitlines()) <= 40
    assert ast.get_docstring(tree)
    for node in ast.walk(tree):
        for alias in node.names if isinstance(node, ast.Import) else ():
            assert not alias.name.startswith("dualarm_repro")
        if isinstance(node, ast.ImportFrom) and node.module.startswith("dualarm_repro"):
            package, _, room = node.module.partition(".")
            assert (package, room in ROOMS) == ("dualarm_repro", True), node.module
            exported = importlib.import_module(node.module).__all__
            assert {alias.name for alias in node.names} <= set(exported)


@pytest.mark.parametrize("page", ["README.md", "book/use_your_arm.md"])
def test_every_example_is_listed(page):
    listed = re.findall(r"`(?:examples/)?(\w+\.py)`", (ROOT / page).read_text(encoding="utf-8"))
    assert sorted(listed) == [path.name for path in EXAMPLES]
