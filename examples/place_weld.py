"""Place a workpiece of two pipes so that three arms weld its seam with most manipulability."""

import numpy as np

from dualarm_repro.arms import load_arm
from dualarm_repro.welding import (
    GeneticSettings,
    Objective,
    Placement,
    Tools,
    Torch,
    Workpiece,
    assemble,
    evolve,
    grid_optimum,
)

arms = [load_arm("kr16-2")] * 3  # two carriers and a welder
bases = np.tile(np.eye(4), (3, 1, 1))
bases[:, :3, 3] = [[1.1, -0.9, 0.0], [-1.1, -0.9, 0.0], [0.0, 1.1, 0.0]]
torch = Torch(length=0.35, crank=0.0, radius=0.02, exempt=0.10)
workpiece = Workpiece(0.09, 0.05, length=0.6, branch_length=0.15, seam_points=12)
cell = assemble(
    arms, bases, workpiece, "bisector", Tools("axial", 0.15, 0.06, torch, "along_bisector"),
    floor=0.0, threshold=1e-3,
)  # fmt: skip
fitness = Placement(cell, Objective())
box = np.array([[-0.4, 0.4], [-0.6, 0.6], [0.3, 1.3]])

grid = grid_optimum(fitness, box, spacing=0.2, starts=2, tolerance=1e-3)
print(
    f"grid, refined: {grid.fitness:.4f} at {grid.position.round(3)}, {grid.evaluations} positions"
)
settings, rng = GeneticSettings(population=24, generations=12), np.random.default_rng(5)
found = evolve(fitness, box, settings, rng)
print(f"genetic algorithm: {found.fitness:.4f} at {found.best.round(3)}")
drawn = fitness(np.random.default_rng(6).uniform(*box.T, (500, 3)))
print(f"of 500 random positions {(drawn > 0).mean():.0%} are feasible, the best {drawn.max():.4f}")
