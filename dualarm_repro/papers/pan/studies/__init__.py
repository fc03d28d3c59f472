"""The stored studies of `pan`."""

from . import consistency, evolution, fit, optimisers, sensitivity

__all__ = ["consistency", "evolution", "fit", "optimisers", "sensitivity"]
