"""Document `pan`: where to start a weld with three robots, by manipulability and evolution."""

from . import errata, pages, studies

__all__ = ["errata", "pages", "studies"]
