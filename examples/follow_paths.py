"""Follow two crossing paths with two redundant arms, with and without mutual avoidance."""

import numpy as np
import pinocchio as pin

from dualarm_repro.arms import load_arm
from dualarm_repro.control import ArmSystem, ControllerSettings, VelocityController
from dualarm_repro.scene import PlacedArm, clearance

arm = load_arm("xarm7")
bases = {"left": [0.0, 0.3, 0.0], "right": [0.0, -0.3, 0.0]}
system = ArmSystem(
    [PlacedArm(name, arm, pin.SE3(np.eye(3), np.array(at))) for name, at in bases.items()]
)
start = np.tile([0.0, -0.4, 0.0, 0.9, 0.0, 1.2, 0.0], 2)
speed = np.array([[0.0, -0.14, 0.0], [0.0, 0.14, 0.0]])  # of each tip [m/s]
dt, ticks = 2e-3, 1000

for avoid in (False, True):
    settings = ControllerSettings(outer=0.10, inner=0.03, avoid=avoid)
    controller = VelocityController(system, settings, slack=True)
    q, nearest = start, np.inf
    for tick in range(ticks):
        goal = system.tips(start) + tick * dt * speed
        q = q + dt * controller.velocity(q, goal, speed)
        nearest = min(nearest, clearance(system.scene, q).minimum)
    error = np.abs(system.tips(q) - goal).max()
    print(f"avoidance {avoid}: arms at least {nearest:.3f} m apart, tips off by {error:.3f} m")
