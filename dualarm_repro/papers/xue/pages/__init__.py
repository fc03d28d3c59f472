"""Pages of the book on `xue`: what computes and judges the items of each."""

from . import beyond, claims, kinematics, planning, potentials, scene, table2, truth, workspace

__all__ = [
    "beyond",
    "claims",
    "kinematics",
    "planning",
    "potentials",
    "scene",
    "table2",
    "truth",
    "workspace",
]
