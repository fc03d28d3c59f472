"""Sphinx extension: ``.. room:: dualarm_repro.arms`` documents every module of a room."""

from __future__ import annotations

import re
from importlib import import_module
from pathlib import Path
from pkgutil import walk_packages
from typing import Any

from docutils import nodes
from docutils.statemachine import StringList
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

_LIBRARY = Path(__file__).resolve().parents[2] / "dualarm_repro"
_FIELD = "Alias for field number"
_UP = re.compile(r"(:\w+:`~?)\.\.+")


class Room(SphinxDirective):
    """One rubric and one ``automodule`` for each module, so that no module can be forgotten."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        package = import_module(self.arguments[0])
        prefix = f"{package.__name__}."
        lines = []
        for module in walk_packages(package.__path__, prefix):
            lines += [f".. rubric:: {module.name.removeprefix(prefix)}", ""]
            lines += [f".. automodule:: {module.name}", "   :members:", ""]
        for file in sorted(_LIBRARY.rglob("*.py")):  # a text may come from a class of another room
            self.env.note_dependency(str(file))
        block = nodes.Element()
        self.state.nested_parse(StringList(lines, self.arguments[0]), 0, block)
        return block.children


def adapt(app: Sphinx, what: str, name: str, obj: Any, options: Any, lines: list[str]) -> None:
    """Docstrings write |x| for a length and ``..room.name`` as an import does; not so Sphinx."""
    lines[:] = [_UP.sub(r"\1.", line.replace("|", r"\|")) for line in lines]


def skip(app: Sphinx, what: str, name: str, obj: Any, skipped: bool, options: Any) -> bool | None:
    """Fields of a named tuple have only a number for a text; its docstring describes them."""
    return True if (getattr(obj, "__doc__", None) or "").startswith(_FIELD) else None


def forget_sourceless(app: Sphinx) -> list[Any]:
    """Leave modules without a page of their source, such as ``builtins``, out of their list."""
    modules = getattr(app.env, "_viewcode_modules", {})
    for name in [name for name, found in modules.items() if not found]:
        del modules[name]
    return []


def setup(app: Sphinx) -> dict[str, Any]:
    """Entry point of Sphinx."""
    app.add_directive("room", Room)
    app.connect("autodoc-process-docstring", adapt)
    app.connect("autodoc-skip-member", skip)
    app.connect("html-collect-pages", forget_sourceless, priority=400)  # before that list is made
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
