"""Scenes: shapes, signed distances and gradients, clearance of arms, scene files."""

from .bodies import PlacedArm
from .certificate import Bracket, certified_minimum
from .clearance import Clearance, clearance, distances
from .distance import Witness, signed_distance
from .gradients import clearance_gradient
from .hull import ConvexHull, circle_points
from .moving import JointPath, MovingArm, MovingShape, PosePath
from .path import densify
from .points import point_distances
from .posing import Links, links_of
from .scene import FLOOR, Scene
from .scene_file import load_scene
from .shapes import Box, Capsule, HalfSpace, Shape, Sphere, facing, window_frame

__all__ = [
    "FLOOR",
    "Box",
    "Bracket",
    "Capsule",
    "Clearance",
    "ConvexHull",
    "HalfSpace",
    "JointPath",
    "Links",
    "MovingArm",
    "MovingShape",
    "PlacedArm",
    "PosePath",
    "Scene",
    "Shape",
    "Sphere",
    "Witness",
    "certified_minimum",
    "circle_points",
    "clearance",
    "clearance_gradient",
    "densify",
    "distances",
    "facing",
    "links_of",
    "load_scene",
    "point_distances",
    "signed_distance",
    "window_frame",
]
