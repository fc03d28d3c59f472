"""The source of the function that computes an item, highlighted, from where its record says it is."""

from __future__ import annotations

import ast
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from markupsafe import Markup

_PACKAGE = Path(__file__).resolve().parents[1]


def source_of(place: Mapping[str, Any]) -> str | None:
    """Text of a function of the library, decorators included; None if it is not found.

    Parameters
    ----------
    place
        ``code`` of a record: file, below the folder that holds the package, and function.
    """
    path = _PACKAGE.parent / place["file"]
    if not path.is_relative_to(_PACKAGE) or not path.is_file():
        return None
    text = path.read_text(encoding="utf-8")
    nodes: list[ast.AST] = [ast.parse(text)]
    for name in place["function"].partition(".<locals>")[0].split("."):
        nodes = [
            node
            for outer in nodes
            for node in ast.iter_child_nodes(outer)
            if isinstance(node, ast.FunctionDef | ast.ClassDef) and node.name == name
        ]
    if not nodes:
        return None
    node = nodes[-1]
    assert isinstance(node, ast.FunctionDef | ast.ClassDef)
    first = min([node.lineno, *(one.lineno for one in node.decorator_list)])
    return "\n".join(text.splitlines()[first - 1 : node.end_lineno])


def highlighted(source: str, language: str = "python") -> Markup:
    """Source as HTML in the classes that the themes of Sphinx and Jupyter colour."""
    from pygments import highlight
    from pygments.formatters import HtmlFormatter
    from pygments.lexers import get_lexer_by_name

    return Markup(highlight(source, get_lexer_by_name(language), HtmlFormatter()))
