"""Sample the workspace of an arm: one call evaluates as many configurations as fit in memory."""

import numpy as np

from dualarm_repro.arms import load_arm

arm = load_arm("ur5")
q = arm.random_configurations(200_000, np.random.default_rng(1))
points, w = arm.positions(q), arm.manipulability(q)

distance = np.linalg.norm(points, axis=1)
print(f"{len(q)} flange positions, {distance.min():.3f} to {distance.max():.3f} m from the base")
for near, far in ((0.0, 0.3), (0.3, 0.6), (0.6, 0.9)):
    shell = (near <= distance) & (distance < far)
    share, mean = shell.mean(), w[shell].mean()
    print(f"  {near:.1f} to {far:.1f} m: {share:.1%}, mean manipulability {mean:.4f}")
