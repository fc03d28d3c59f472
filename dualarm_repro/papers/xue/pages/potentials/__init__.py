"""Page on the potentials: equations (9)-(16) and the virtual point."""

from . import improved, traditional

__all__ = ["improved", "traditional"]
