"""Page `success`: who arrives and who is free, and what the paths are worth."""

from . import quality, rates

__all__ = ["quality", "rates"]
