"""A pair of arms around a window, as a test bench: one arrangement, all settings stated."""

import numpy as np
import pinocchio as pin

from dualarm_repro.arms import load_arm
from dualarm_repro.planning import (
    APFSettings,
    Attraction,
    Repulsion,
    Termination,
    Trap,
    Update,
    VirtualPoint,
    obstacles_of,
    posture,
)
from dualarm_repro.scene import PlacedArm, Scene, facing, window_frame

CENTRE = (0.15, 0.30, 0.70)
MASTER = PlacedArm("master", load_arm("es165d"), pin.SE3(np.eye(3), np.array([-1.15, 3.25, -0.45])))
SLAVE = PlacedArm(
    "slave", load_arm("es165d-slave"), pin.SE3(np.eye(3), np.array([-1.15, 0.45, -0.45]))
)
MASTER_START = np.zeros(6)
MASTER_GOAL = np.pi * np.array([-1 / 2, -1 / 8, -1 / 2, 1 / 2, 1 / 4, 0])
START, GOAL = (
    posture(SLAVE, point, "radial", elbow="up") for point in ((0.75, 0.35, 0.5), (-0.45, 0.8, 0.15))
)
IMPROVED = APFSettings(
    attraction=Attraction(gain=3.0, joint_weight=1.0),
    control_points="frames_2_6",
    repulsion=Repulsion(gain=1.0, influence=0.3),
    virtual_point=VirtualPoint(
        gain=2.0,
        position=CENTRE,
        switching="on_when_stuck",
        release_distance=0.1,
        max_steps=400,
        max_activations=5,
    ),
    update=Update(rule="gradient", gain=0.05, max_step=0.02),
    termination=Termination(
        joint_tolerance=0.02,
        step_limit=3000,
        trap=Trap(rule="block_means", steps=50, threshold=2e-3),
    ),
)
BY_POSITION = IMPROVED.changed(
    attraction=Attraction(gain=3.0),
    termination=IMPROVED.termination.changed(joint_tolerance=None, position_tolerance=0.02),
)
TRADITIONAL = BY_POSITION.changed(control_points="end_effector", virtual_point=None)
SEARCH = Update(rule="neighbour_search", max_step=0.03)
FIXED = Update(rule="fixed_length", max_step=0.02)


def window(opening=(0.9, 1.1), centre=CENTRE):
    return window_frame(centre, facing((1.0, 0.0, 0.0)), *opening, 0.1, 0.1)


def scene(**obstacles):
    return Scene([MASTER, SLAVE], obstacles or {"window": window()}, self_collision=False)


def around(**obstacles):
    return obstacles_of(scene(**obstacles))


def virtual(**changes):
    return IMPROVED.changed(virtual_point=IMPROVED.virtual_point.changed(**changes))
