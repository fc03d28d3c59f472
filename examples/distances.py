"""Measure distances in a scene: which bodies are nearest, where, and how the distance changes."""

from pathlib import Path

import numpy as np

from dualarm_repro.scene import clearance, clearance_gradient, load_scene

scene = load_scene(Path(__file__).parents[1] / "data/scenes/example_cell.yaml")
q = np.concatenate([np.radians([20, 10, 0, 0, 30, 0]), np.radians([-45, -20, 0, -120, 0, 100, 0])])

found, gradient = clearance_gradient(scene, q)
k = found.nearest
print(f"{len(found.names)} pairs of bodies; nearest are {' and '.join(found.names[k])}")
print(f"  {found.minimum:.4f} m, from {found.point_a[k].round(3)} to {found.point_b[k].round(3)}")

away = gradient[k] / np.linalg.norm(gradient[k])
print(f"  steepest way apart: {np.linalg.norm(gradient[k]):.5f} m/rad by the gradient")
h = 1e-6
change = clearance(scene, [q - h * away, q + h * away]).distance[:, k]
print(f"  the same by a small step either way: {(change[1] - change[0]) / (2 * h):.5f} m/rad")
