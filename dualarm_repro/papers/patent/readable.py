"""The quadratic programme as the reader sees it: source of the convex statement."""

from __future__ import annotations

import inspect

from ...control.statement import statement


def statement_source() -> str:
    """Code that states the problem, without its docstring."""
    return inspect.getsource(statement).split('"""')[-1]
