"""Page `geometry`: the arm, its place in the world, and the inputs of the runs."""

from . import arm, task

__all__ = ["arm", "task"]
