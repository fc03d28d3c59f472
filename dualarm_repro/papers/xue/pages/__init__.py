"""Pages of the book on `xue`: what computes and judges the items of each."""

from . import kinematics, planning, potentials, scene, table2, truth, workspace

__all__ = ["kinematics", "planning", "potentials", "scene", "table2", "truth", "workspace"]
