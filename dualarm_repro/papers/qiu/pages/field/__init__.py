"""Page `field`: the potential field, its forces and its parameters."""

from . import forces, parameters

__all__ = ["forces", "parameters"]
