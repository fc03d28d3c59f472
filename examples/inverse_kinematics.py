"""Solve a pose in closed form: every branch of an arm with a spherical wrist, none approximate."""

import numpy as np

from dualarm_repro.arms import load_arm

arm = load_arm("irb2400")
pose = arm.fk(np.radians([10.0, 20.0, -15.0, 30.0, 45.0, 0.0]))
solutions = arm.ik(pose)

print(f"{len(solutions)} configurations within the limits reach the pose [deg]:")
print(np.degrees(solutions).round(1))
print(f"largest error of a pose: {np.abs(arm.fk(solutions) - pose).max():.1e}")
best = solutions[arm.manipulability(solutions).argmax()]
print("farthest from a singularity:", np.degrees(best).round(1))
print("beyond the limits as well:", len(arm.ik(pose, within_limits=False)))
