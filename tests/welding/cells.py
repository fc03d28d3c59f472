"""A cell of the size of industrial robots for the tests of the welding room."""

import numpy as np

from dualarm_repro.arms import load_arm
from dualarm_repro.welding import Tools, Torch, Workpiece, assemble, base_poses

BASES = np.tile(np.eye(4), (3, 1, 1))
BASES[:, :3, 3] = [[1.0, -1.0, 0.05], [-1.0, -1.0, 0.05], [0.0, 1.0, 0.0]]
BOX = np.array([[-0.6, 0.6], [-0.9, 0.9], [0.1, 1.5]])


def make_cell(
    arm="kr16-2",
    count=36,
    posture="bisector",
    grasp="axial",
    crank=0.0,
    axis="along_bisector",
    reading="inverted",
    floor=0.0,
    lift=0.0,
    radii=(0.10, 0.06),
    arms=None,
    bases=None,
    reference="workpiece_origin",
):
    if bases is None:
        bases = BASES.copy()
        bases[:, 2, 3] += lift
        bases = base_poses(bases, reading)
    return assemble(
        [load_arm(arm)] * 3 if arms is None else arms,
        bases,
        Workpiece(*radii, length=0.6, branch_length=0.15, seam_points=count),
        posture,
        Tools(grasp, 0.15, 0.06, Torch(0.35, crank, 0.02, 0.10), axis),
        floor=floor,
        threshold=1e-3,
        reference=reference,
    )
