"""Executable reproduction of four documents on robot arms that share a workspace."""

from importlib.metadata import version

from .arms import Arm, load_arm

__version__ = version("dualarm_repro")
__all__ = ["Arm", "__version__", "load_arm"]
