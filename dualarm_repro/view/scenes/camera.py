"""A camera that sees all of the action, and nothing but it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

#: Angle of view from top to bottom [rad], width over height of the picture, and share of it used.
FIELD, ASPECT, FILLED = np.deg2rad(32.0), 16.0 / 9.0, 0.9


@dataclass(frozen=True, eq=False)
class Camera:
    """A perspective camera with z up.

    Attributes
    ----------
    eye, target : ndarray (3,)
        [m]
    """

    eye: np.ndarray
    target: np.ndarray

    @property
    def axes(self) -> np.ndarray:
        """Rows right, up and forward (3, 3)."""
        forward = self.target - self.eye
        forward = forward / np.linalg.norm(forward)
        right = np.cross(forward, [0.0, 0.0, 1.0])
        right /= np.linalg.norm(right)
        return np.array([right, np.cross(right, forward), forward])

    def project(self, points: np.ndarray) -> np.ndarray:
        """Points (..., 3) to x and y in -1 ... 1 within the picture, and the depth [m]."""
        x, y, depth = np.moveaxis((points - self.eye) @ self.axes.T, -1, 0)
        scale = 1.0 / (np.tan(0.5 * FIELD) * np.maximum(depth, 1e-9))
        return np.stack([x * scale / ASPECT, y * scale, depth], axis=-1)


def framed(direction: np.ndarray, points: np.ndarray) -> Camera:
    """The camera that looks along ``-direction`` and fills the picture with the points (N, 3)."""
    unit = direction / np.linalg.norm(direction)
    if np.hypot(*unit[:2]) < 1e-3:  # from straight above or below there is no "up"
        unit = np.array([1e-3, 0.0, unit[2]]) / np.hypot(1e-3, unit[2])
    low, high = points.min(axis=0), points.max(axis=0)
    target, far = 0.5 * (low + high), 2.0 * float(np.linalg.norm(high - low)) + 1e-3
    for _ in range(40):
        camera = Camera(target + far * unit, target)
        seen = camera.project(points)
        x, y, depth = seen[:, 0], seen[:, 1], seen[:, 2]
        centre = [0.5 * (x.min() + x.max()), 0.5 * (y.min() + y.max())]
        half = np.tan(0.5 * FIELD) * float(np.median(depth))
        right, up, _ = camera.axes
        target = target + 0.7 * half * (ASPECT * centre[0] * right + centre[1] * up)
        spread = max(float(np.ptp(x)), float(np.ptp(y))) / (2.0 * FILLED)
        far *= spread**0.7
    return Camera(target + far * unit, target)
