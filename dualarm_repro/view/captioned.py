"""A figure that a cell of the book draws, shown as the book shows its own."""

from __future__ import annotations

from typing import Any

from .card import figure_html
from .page import Page


def captioned(figure: Any, caption: str, alt: str) -> Page:
    """The figure with a caption that states the finding, and alternative text; it is closed."""
    return Page(f'<div class="ledger-item">{figure_html(figure, alt, caption)}</div>')
