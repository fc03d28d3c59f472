"""Page `pan/cell`: the cell, the seam and its frames."""

from . import coordination, robots, seam

__all__ = ["coordination", "robots", "seam"]
