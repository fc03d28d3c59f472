"""Page `pan/optimum`: the optimum, and where the printed one could come from."""

from . import curves, printed_point, problem, starts

__all__ = ["curves", "printed_point", "problem", "starts"]
