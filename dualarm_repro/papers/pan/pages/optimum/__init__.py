"""Page `pan/optimum`: the optimum, and where the printed one could come from."""

from . import curves, printed_point, problem

__all__ = ["curves", "printed_point", "problem"]
