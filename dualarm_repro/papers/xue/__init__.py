"""Document `xue`: improved artificial potential field for two Motoman ES165D around a window."""

from . import errata, pages, studies

__all__ = ["errata", "pages", "studies"]
