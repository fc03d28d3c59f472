"""Pictures along a line or in a plane whose place and weights a reader can move."""

from .curves import Curve, curve_slice
from .distance import distance_slice
from .maps import Layer, map_slice
from .placement import placement_slice
from .potential import potential_slice

__all__ = [
    "Curve",
    "Layer",
    "curve_slice",
    "distance_slice",
    "map_slice",
    "placement_slice",
    "potential_slice",
]
