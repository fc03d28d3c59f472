"""Arms: exact DH tables, models, batch kernels, closed-form inverse kinematics, workspace."""

from .arm import Arm
from .catalog import arm_names, load_arm

__all__ = ["Arm", "arm_names", "load_arm"]
