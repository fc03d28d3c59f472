"""Sentences of the book as templates, filled with values of the ledger."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import cache
from typing import TYPE_CHECKING, Any

from ..errors import LedgerError
from .badge import percent
from .numbers import number, words

if TYPE_CHECKING:
    from jinja2 import Environment

#: A space that only stands where a line of the source was broken between two Chinese signs.
_BROKEN = re.compile(r"(?<=[\u3000-\u9fff\uff00-\uffef“”]) (?=[\u3000-\u9fff\uff00-\uffef“”])")


def fill(text: str, source: str, **values: Any) -> str:
    """A template with its values, on one line.

    Parameters
    ----------
    source
        What to name if the template is wrong, e.g. a file and an item.

    Raises
    ------
    LedgerError
        The template names a value that there is not.
    """
    from jinja2 import TemplateError

    try:
        filled = _environment().from_string(text).render(values)
    except (TemplateError, TypeError) as error:
        raise LedgerError(f"{source}: {error}") from None
    return " ".join(filled.split())


def condition(text: str, source: str) -> Callable[..., bool]:
    """An expression as a function of its values; one that is missing makes it false.

    Raises
    ------
    LedgerError
        It is no expression.
    """
    from jinja2 import TemplateSyntaxError, UndefinedError

    try:
        compiled = _environment().compile_expression(text, undefined_to_none=False)
    except TemplateSyntaxError as error:
        raise LedgerError(f"{source}: {error}: {text}") from None

    def holds(**values: Any) -> bool:
        try:
            return bool(compiled(**values))
        except (UndefinedError, TypeError, ZeroDivisionError):
            return False

    return holds


def close_up(text: str) -> str:
    """A text without spaces between Chinese signs."""
    return _BROKEN.sub("", text)


@cache
def _environment() -> Environment:
    from jinja2 import Environment, StrictUndefined

    made = Environment(undefined=StrictUndefined)
    made.filters["percent"] = percent
    made.filters["words"] = words
    made.filters["number"] = number
    return made
