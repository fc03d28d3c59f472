"""Reading a URDF file: its joints, the flange, the shapes of its links, and what is refused."""

from .description import URDF

__all__ = ["URDF"]
