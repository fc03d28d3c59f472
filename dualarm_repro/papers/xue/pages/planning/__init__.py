"""Page on the planned motions: Figures 7-11 and the statements about them."""

from . import flow, motions

__all__ = ["flow", "motions"]
