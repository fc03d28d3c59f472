"""Where to put a job: a workpiece held by two carriers and welded by a third robot."""

from .assembly import Tools, Workpiece, assemble, base_poses
from .branches import Status
from .cell import ROBOTS, WELDER, Cell
from .genetic import Evolution, Settings, evolve
from .grid_search import Optimum, grid_optimum
from .manipulability import closed_form
from .objective import Measures, Objective, inverse_volumes
from .placement import Jobs, Placement
from .posture import POSTURES, flat_rotations
from .seam import Seam, saddle_seam
from .separation import Separation
from .tooling import Torch

__all__ = [
    "POSTURES",
    "ROBOTS",
    "WELDER",
    "Cell",
    "Evolution",
    "Jobs",
    "Measures",
    "Objective",
    "Optimum",
    "Placement",
    "Seam",
    "Separation",
    "Settings",
    "Status",
    "Tools",
    "Torch",
    "Workpiece",
    "assemble",
    "base_poses",
    "closed_form",
    "evolve",
    "flat_rotations",
    "grid_optimum",
    "inverse_volumes",
    "saddle_seam",
]
