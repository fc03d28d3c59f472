"""The welding cell of the benchmarks: three arms around a saddle seam."""

from __future__ import annotations

import numpy as np

from dualarm_repro import load_arm
from dualarm_repro.welding import Cell, Tools, Torch, Workpiece, assemble

ARM = "er16"
BASES = ((1.0, -1.0, 0.05), (-1.0, -1.0, 0.05), (0.0, 1.0, 0.0))
GOOD = np.array([0.0, 0.1, 0.65])  # a feasible position of the workpiece [m]


def weld_cell(points: int) -> Cell:
    """Two carriers and a welder with ``points`` points along the seam."""
    bases = np.tile(np.eye(4), (3, 1, 1))
    bases[:, :3, 3] = BASES
    workpiece = Workpiece(0.10, 0.06, 0.6, 0.15, points)
    tools = Tools("axial", 0.15, 0.06, Torch(0.35, 0.0, 0.02, 0.10), "along_bisector")
    arms = [load_arm(ARM)] * 3
    return assemble(arms, bases, workpiece, "bisector", tools, floor=0.0, threshold=1e-3)
