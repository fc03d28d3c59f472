"""Load an arm, by name or from a URDF file, and ask for its pose, Jacobian and manipulability."""

import numpy as np
from example_robot_data import getModelPath

from dualarm_repro.arms import arm_names, load_arm

urdf = "ur_description/urdf/ur3_robot.urdf"
for source in ("irb120", f"{getModelPath(urdf)}/{urdf}"):
    arm = load_arm(source)
    q = np.full(arm.nq, 0.3)
    print(f"{arm.name}: {arm.nq} joints")
    print("  flange at", arm.fk(q)[:3, 3].round(3), "m")
    print("  rank of the Jacobian:", np.linalg.matrix_rank(arm.jacobian(q)))
    print(f"  manipulability: {arm.manipulability(q):.4f}")

print("names of the catalogue:", ", ".join(arm_names()))
