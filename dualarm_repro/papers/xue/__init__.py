"""Document `xue`: improved artificial potential field for two Motoman ES165D around a window."""

from . import chain, chain_errata, drawings, statements, workspace

__all__ = ["chain", "chain_errata", "drawings", "statements", "workspace"]
