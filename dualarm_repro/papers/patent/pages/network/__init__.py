"""From the programme to a network: penalty, matrix equation, decay of the error, state equation."""

from . import decay, matrix_equation, penalty, symbols

__all__ = ["decay", "matrix_equation", "penalty", "symbols"]
