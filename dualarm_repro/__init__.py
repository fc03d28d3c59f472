"""Executable reproduction of four documents on robot arms that share a workspace."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .arms import Arm, load_arm

    __version__: str

__all__ = ["Arm", "__version__", "load_arm"]


def __getattr__(name: str) -> Any:
    """Names of the package, imported when they are asked for: a command line must start at once."""
    if name == "__version__":
        from importlib.metadata import version

        return version("dualarm_repro")
    if name in __all__:
        from . import arms

        return getattr(arms, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
