"""Distances of points to boxes and spheres, and the potentials of them, with numpy alone."""

import numpy as np


class Boxes:
    """Boxes with one orientation: middles (B, 3), half sides (B, 3), axes as columns (3, 3)."""

    def __init__(self, middles, halves, axes):
        self.middles, self.halves, self.axes = map(np.asarray, (middles, halves, axes))

    @classmethod
    def window(cls, centre, normal, opening, bar):
        """Four bars of square section around an opening that is passed along a level normal."""
        n = np.asarray(normal, dtype=float)
        n = n / np.linalg.norm(n)
        up = np.array([0.0, 0.0, 1.0])
        axes = np.stack([np.cross(up, n), up, n], axis=1)
        width, height = opening
        shift = np.array([[0.0, 1.0], [0.0, -1.0], [-1.0, 0.0], [1.0, 0.0]])
        shift = shift * 0.5 * np.array([width + bar, height + bar])
        lying, standing = (width + 2 * bar, bar, bar), (bar, height, bar)
        halves = 0.5 * np.array([lying, lying, standing, standing])
        return cls(np.asarray(centre) + shift @ axes[:, :2].T, halves, axes)

    def distances(self, points):
        """Signed distances (K, B) of points (K, 3), and their directions of growth (K, B, 3)."""
        local = (points[:, np.newaxis] - self.middles) @ self.axes
        excess = np.abs(local) - self.halves
        outside = np.maximum(excess, 0.0)
        length = np.linalg.norm(outside, axis=2)
        inside = excess.max(axis=2)
        way = np.where(
            (length > 0.0)[..., np.newaxis],
            np.sign(local) * outside / np.where(length > 0.0, length, 1.0)[..., np.newaxis],
            np.sign(local) * (excess == inside[..., np.newaxis]),
        )
        return np.where(length > 0.0, length, inside), way @ self.axes.T


def to_points(points, others):
    """Distances (K, M) of points (K, 3) to others (M, 3), and their directions of growth."""
    gap = points[:, np.newaxis] - others
    length = np.linalg.norm(gap, axis=2)
    return length, gap / length[..., np.newaxis]


def inverse_distance(d, gain, reach, contact=1e-3):
    """k/2 (1/d - 1/d_0)^2 within the reach d_0 and its slope; below contact along its tangent."""
    near = np.clip(d, contact, reach)
    slope = -gain * (1.0 / near - 1.0 / reach) / near**2
    energy = 0.5 * gain * (1.0 / near - 1.0 / reach) ** 2
    return energy + slope * np.minimum(d - contact, 0.0), slope
