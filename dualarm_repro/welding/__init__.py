"""Where to put a job: a workpiece held by two carriers and welded by a third robot."""

from .assembly import Tools, Workpiece, assemble, base_poses
from .branches import Status
from .cell import ROBOTS, WELDER, Cell
from .genetic import Evolution, GeneticSettings, evolve
from .grid_search import Optimum, grid_optimum
from .landscape import EXTREMES, Survey, extreme_position, survey
from .manipulability import closed_form
from .motion import flange_poses, held_poses, joint_margin, torch_tips
from .objective import Measures, Objective, inverse_volumes
from .peers import OPTIMISERS
from .placement import Jobs, Placement
from .posture import POSTURES, flat_rotations
from .seam import Seam, saddle_seam
from .separation import Separation
from .tooling import GRASPS, TORCH_AXES, Torch
from .watched import Trace, watch

__all__ = [
    "EXTREMES",
    "GRASPS",
    "OPTIMISERS",
    "POSTURES",
    "ROBOTS",
    "TORCH_AXES",
    "WELDER",
    "Cell",
    "Evolution",
    "GeneticSettings",
    "Jobs",
    "Measures",
    "Objective",
    "Optimum",
    "Placement",
    "Seam",
    "Separation",
    "Status",
    "Survey",
    "Tools",
    "Torch",
    "Trace",
    "Workpiece",
    "assemble",
    "base_poses",
    "closed_form",
    "evolve",
    "extreme_position",
    "flange_poses",
    "flat_rotations",
    "grid_optimum",
    "held_poses",
    "inverse_volumes",
    "joint_margin",
    "saddle_seam",
    "survey",
    "torch_tips",
    "watch",
]
