"""The highlighted source of the function that computes an item, from the place in its record."""

from __future__ import annotations

import ast
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from markupsafe import Markup

_PACKAGE = Path(__file__).resolve().parents[1]
_Defined = ast.FunctionDef | ast.ClassDef


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
    outer: ast.Module | _Defined = ast.parse(text)
    for name in place["function"].partition(".<locals>")[0].split("."):
        inner = [one for one in outer.body if isinstance(one, _Defined) and one.name == name]
        if not inner:
            return None
        outer = inner[-1]
    if isinstance(outer, ast.Module):
        return None
    first = min([outer.lineno, *(one.lineno for one in outer.decorator_list)])
    return "\n".join(text.splitlines()[first - 1 : outer.end_lineno])


def highlighted(source: str, language: str = "python") -> Markup:
    """Source as HTML in the classes that the themes of Sphinx and Jupyter colour."""
    from pygments import highlight
    from pygments.formatters import HtmlFormatter
    from pygments.lexers import get_lexer_by_name

    return Markup(highlight(source, get_lexer_by_name(language), HtmlFormatter()))
