"""Document `patent`: mutual avoidance of two redundant arms by a QP and a neural solver."""

from . import errata, pages, studies

__all__ = ["errata", "pages", "studies"]
