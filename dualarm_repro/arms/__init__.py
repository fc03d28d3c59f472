"""Arms: exact DH tables, models, batch kernels, closed-form inverse kinematics, workspace."""

from .arm import Arm
from .catalog import arm_names, load_arm
from .occupancy import Occupancy, RotationVolume, occupancy, rotation_volumes
from .robot_file import DHRobot, MirrorRobot, URDFRobot, load_robot_file
from .workspace import Extents, VoxelVolume, extents, sample_workspace, voxel_volume
from .wrist_geometry import WristGeometry, wrist_geometry

__all__ = [
    "Arm",
    "DHRobot",
    "Extents",
    "MirrorRobot",
    "Occupancy",
    "RotationVolume",
    "URDFRobot",
    "VoxelVolume",
    "WristGeometry",
    "arm_names",
    "extents",
    "load_arm",
    "load_robot_file",
    "occupancy",
    "rotation_volumes",
    "sample_workspace",
    "voxel_volume",
    "wrist_geometry",
]
