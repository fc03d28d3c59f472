"""Fills the HTML templates beside this file; every value that is no markup itself is escaped."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

from .badge import badge, badge_of
from .wording import short

# One file for each kind of output: heads and cards of items, pages of the ledger.
TEMPLATES = Path(__file__).resolve().parent / "templates"


def render(name: str, **values: Any) -> Markup:
    """The template ``<name>.html`` filled with values; it also knows ``badge``, ``badge_of`` and
    ``short``."""
    return Markup(_environment().get_template(f"{name}.html").render(values))


@cache
def _environment() -> Environment:
    made = Environment(
        loader=FileSystemLoader(TEMPLATES),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    made.globals["badge"] = badge
    made.globals["badge_of"] = badge_of
    made.filters["short"] = short
    return made
