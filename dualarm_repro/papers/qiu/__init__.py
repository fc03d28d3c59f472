"""Document `qiu`: search from both ends for two IRB 120 among spheres."""

from . import errata, pages, studies

__all__ = ["errata", "pages", "studies"]
