"""Arms: exact DH tables, models, batch kernels, closed-form inverse kinematics, workspace."""

from .arm import Arm
from .catalog import arm_names, load_arm
from .exclusions import Evidence, Exclusion, Neighbours
from .joint_type import JointType
from .occupancy import Occupancy, RotationVolume, occupancy, rotation_volumes
from .robot_file import DHRobot, MirrorRobot, URDFRobot, load_robot_file
from .shapes import Shapes
from .workspace import Extents, VoxelVolume, extents, sample_workspace, voxel_volume
from .wrist_geometry import WristGeometry, wrist_geometry

__all__ = [
    "Arm",
    "DHRobot",
    "Evidence",
    "Exclusion",
    "Extents",
    "JointType",
    "MirrorRobot",
    "Neighbours",
    "Occupancy",
    "RotationVolume",
    "Shapes",
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
